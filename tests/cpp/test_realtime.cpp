// The methods that a control loop may call make no allocation.
#include <doctest/doctest.h>
#include <dmp/pose_dmp.hpp>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "allocations.hpp"
#include "motions.hpp"

using namespace dmp;
using namespace motions;

namespace {

DmpOptions options_of(Scaling scaling, OrientationForm form) {
  DmpOptions options;
  options.scaling = scaling;
  options.orientation_form = form;
  options.phase_stop = 10.0;
  return options;
}

}  // namespace

TEST_CASE("the counter counts" * doctest::skip(!COUNTS_MALLOC)) {
  std::vector<double> kept;
  CHECK(allocations_in([&] { kept.resize(1000); }) == 1);
  CHECK(allocations_in([&] { kept[999] = 1.0; }) == 0);
  CHECK(kept[999] == 1.0);
}

TEST_CASE("a run of positions and orientations takes no memory in the loop, whatever happens on the way") {
  const PoseDemonstration demonstration = pose(300, 2.0);
  for (const Scaling scaling : {Scaling::none, Scaling::per_axis_relative, Scaling::rotation_dilation})
    for (const OrientationForm form : {OrientationForm::ude, OrientationForm::log_linear}) {
      PoseRun run(PoseDmp::fit(demonstration, options_of(scaling, form)));
      Eigen::Matrix4d goal = run.goal();
      goal(0, 3) += .1;
      const Eigen::Matrix4d start = run.pose();
      const Eigen::Matrix<double, 6, 1> twist = run.twist();
      double sum = 0.0;
      const long count = allocations_in([&] {
        for (int i = 0; i < 3000; ++i) {
          run.step(1e-3);
          if (i == 500) run.set_goal(goal);
          if (i == 700) run.set_duration(3.0);
          if (i == 900) run.pause();
          if (i == 1000) run.resume();
          if (i == 1100) run.set_tracking_error(.1);
          if (i == 1500) run.start_from(start, twist);
          if (i == 2500) run.reset();
          sum += run.pose()(0, 3) + run.twist()[0] + run.acceleration()[5] + run.time() + run.phase() +
                 run.duration();
        }
      });
      CHECK(count == 0);
      CHECK(std::isfinite(sum));
    }
}

TEST_CASE("runs of positions in any number of dimensions and of orientations take none either") {
  Run run(Dmp::fit(helix(300, 2.0, .1, .2, 2)));
  const Eigen::VectorXd goal = run.goal() * 1.1;
  OrientationRun turn(OrientationDmp::fit(rotation(300, 2.0, 3.0)));
  const Eigen::Matrix3d there = turn.goal() * so3::exp({.1, 0, 0});
  CHECK(allocations_in([&] {
          for (int i = 0; i < 2500; ++i) {
            if (i == 300) run.set_goal(goal);
            if (i == 300) turn.set_goal(there);
            run.step(1e-3);
            turn.step(1e-3);
          }
          run.reset();
          turn.reset();
        }) == 0);
}

namespace {

bool denormal(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  return values.unaryExpr([](double v) { return std::fpclassify(v) == FP_SUBNORMAL ? 1.0 : 0.0; }).any();
}

}  // namespace

TEST_CASE("a run that is kept going for ever comes to rest, and nothing decays into denormal numbers") {
  for (const bool force_after_end : {false, true})
    for (const OrientationForm form : {OrientationForm::ude, OrientationForm::log_linear}) {
      DmpOptions options;
      options.orientation_form = form;
      options.force_after_end = force_after_end;
      options.tempo_filter = 0.05;
      PoseRun run(PoseDmp::fit(pose(200, 1.0), options));
      run.step(1e-3);
      Eigen::Matrix4d goal = run.goal();
      goal(0, 3) += .1;
      run.set_goal(goal);
      run.set_duration(0.7);
      bool found = false;
      for (int i = 0; i < 300; ++i) {  // 1500 durations
        run.step(3.5);
        found = found || denormal(run.pose()) || denormal(run.twist()) || denormal(run.acceleration());
      }
      CHECK_FALSE(found);
      CHECK(run.twist().norm() < 1e-12);
      CHECK((run.pose() - goal).norm() < 1e-12);
    }
}

TEST_CASE("these are the methods that a control loop may call") {
  std::set<std::string> found;
  for (const char* header :
       {"dmp.hpp", "joint_tracker.hpp", "mailbox.hpp", "orientation_dmp.hpp", "pose_dmp.hpp"}) {
    std::ifstream file(std::filesystem::path(DMP_INCLUDE_FOLDER) / "dmp" / header);
    std::stringstream text;
    text << file.rdbuf();
    const std::string source = text.str();
    const std::regex method(
        "(\\w+)\\([^()]*(?:\\([^()]*\\)[^()]*)*\\)\\s*(?:const\\s+)?noexcept\\s+DMP_REALTIME");
    for (std::sregex_iterator it(source.begin(), source.end(), method), end; it != end; ++it)
      found.insert((*it)[1]);
  }
  const std::set<std::string> expected{"acceleration",
                                       "angle_error",
                                       "angular_acceleration",
                                       "angular_velocity",
                                       "duration",
                                       "goal",
                                       "joints",
                                       "pause",
                                       "paused",
                                       "phase",
                                       "pose",
                                       "position",
                                       "position_error",
                                       "post",
                                       "quaternion",
                                       "reset",
                                       "resume",
                                       "rotation",
                                       "set_duration",
                                       "set_goal",
                                       "set_joints",
                                       "set_tracking_error",
                                       "start_from",
                                       "status",
                                       "step",
                                       "take",
                                       "time",
                                       "track",
                                       "twist",
                                       "velocity"};
  CHECK(found == expected);
}
