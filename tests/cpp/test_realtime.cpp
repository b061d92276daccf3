// The methods that a control loop may call make no allocation.
#include <doctest/doctest.h>
#include <dmp/pose_dmp.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
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
    for (const OrientationForm form :
         {OrientationForm::ude, OrientationForm::log_linear, OrientationForm::turning}) {
      if (form == OrientationForm::turning && scaling != Scaling::none) continue;  // refused
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
  for (const Integrator integrator : {Integrator::exact, Integrator::semi_implicit_euler})
    for (const bool force_after_end : {false, true})
      for (const OrientationForm form :
           {OrientationForm::ude, OrientationForm::log_linear, OrientationForm::turning})
        for (const bool to_identity : {false, true}) {
          DmpOptions options;
          options.integrator = integrator;
          options.orientation_form = form;
          options.force_after_end = force_after_end;
          options.tempo_filter = 0.05;
          PoseRun run(PoseDmp::fit(pose(200, 1.0), options));
          run.step(1e-3);
          const Eigen::Matrix4d goal = to_identity ? Eigen::Matrix4d::Identity() : run.goal();
          CHECK(run.set_goal(goal) == Status::running);
          CHECK(run.set_duration(0.7) == Status::running);
          bool found = false;
          for (int i = 0; i < 1500; ++i) {  // 300 durations: exp(-12.5 s) is denormal after 57
            run.step(0.14);
            found = found || denormal(run.pose()) || denormal(run.twist()) || denormal(run.acceleration()) ||
                    denormal(run.quaternion().coeffs());
          }
          CHECK_FALSE(found);
          CHECK(run.twist().norm() < 1e-12);
          CHECK((run.pose() - goal).norm() < 1e-12);
        }
}

TEST_CASE(
    "seven joints, the source's kernels and Euler's rule take no memory and leave nothing denormal either") {
  const Eigen::VectorXd t = grid(200, 1.0);
  RowMatrix y(200, 7);
  for (int k = 0; k < 200; ++k)
    for (int d = 0; d < 7; ++d) y(k, d) = std::sin((1 + d) * t[k]) + d;
  for (const Kernels kernels : {Kernels::equal_in_time, Kernels::source})
    for (const Integrator integrator : {Integrator::exact, Integrator::semi_implicit_euler}) {
      DmpOptions options;
      options.kernels = kernels;
      options.integrator = integrator;
      options.force_after_end = true;
      Run run(Dmp::fit(Demonstration(t, y), options));
      const Eigen::VectorXd goal = Eigen::VectorXd::Zero(7);
      bool found = false;
      CHECK(allocations_in([&] {
              run.step(1e-3);
              run.set_goal(goal);
              for (int i = 0; i < 2000; ++i) {
                run.step(0.1);
                for (int d = 0; d < 7; ++d)
                  found = found || std::fpclassify(run.position()[d]) == FP_SUBNORMAL ||
                          std::fpclassify(run.velocity()[d]) == FP_SUBNORMAL ||
                          std::fpclassify(run.acceleration()[d]) == FP_SUBNORMAL;
              }
            }) == 0);
      CHECK_FALSE(found);
      CHECK(run.position().norm() < 1e-12);
    }
}

TEST_CASE("whoever keeps the address of an output reads the newest") {
  Run run(Dmp::fit(helix(300, 2.0, .1, .2, 2)));
  const double* const position = run.position().data();
  const double* const velocity = run.velocity().data();
  const double* const acceleration = run.acceleration().data();
  for (int i = 0; i < 3; ++i) {
    run.step(1e-3);
    CHECK(run.position().data() == position);
    CHECK(run.velocity().data() == velocity);
    CHECK(run.acceleration().data() == acceleration);
  }
}

TEST_CASE("these are the methods that a control loop may call, header by header") {
  std::map<std::string, std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(DMP_INCLUDE_FOLDER "/dmp")) {
    std::ifstream file(entry.path());
    const std::string source((std::istreambuf_iterator<char>(file)), {});
    const std::regex method(
        "(\\w+)\\([^()]*(?:\\([^()]*\\)[^()]*)*\\)\\s*(?:const\\s+)?noexcept\\s+DMP_REALTIME");
    std::multiset<std::string> names;  // an overload each
    for (std::sregex_iterator it(source.begin(), source.end(), method), end; it != end; ++it)
      names.insert((*it)[1]);
    std::string& list = found[entry.path().stem().string()];
    for (const std::string& name : names) list += (list.empty() ? "" : " ") + name;
    if (list.empty()) found.erase(entry.path().stem().string());
  }
  const std::map<std::string, std::string> expected{
      {"basis", "activations gate proportional"},
      {"dmp", "acceleration position velocity"},
      {"forcing", "evaluate evaluate"},
      {"joint_tracker", "angle_error joints limit_excess position_error set_joints track velocity"},
      {"mailbox", "post take"},
      {"obstacle", "is_obstacle nearness"},
      {"orientation_dmp", "angular_acceleration angular_velocity quaternion rotation"},
      {"phase",
       "advance advance before_end duration end ended increment past_end pause paused reset resume s "
       "set_duration "
       "set_tracking_error speed speed_rate time x"},
      {"pose_dmp", "acceleration pose position quaternion rotation twist"},
      {"pose_gripper_dmp", "acceleration gripper gripper_velocity pose twist"},
      {"safety_filter", "changed clear clearance obstacle remove room set set_tracking_error"},
      {"so3", "distance exp exp_quaternion hat left_jacobian left_jacobian_inverse lifted_log log log vee"},
      {"sequence", "current current output part set_goal state step stretch time"},
      {"stepper",
       "ahead amplitude clear_vias duration goal join move_via output pause paused phase reset resume "
       "set_amplitude set_duration set_goal set_tracking_error start_from start_from state status step step "
       "step step time via via"}};
  CHECK(found.size() == expected.size());
  for (const auto& [header, names] : expected) {
    CAPTURE(header);
    CHECK(found[header] == names);
  }
}
