// A product of spaces moves as its parts do, and offers all that they offer.
#include <doctest/doctest.h>
#include <dmp/average.hpp>
#include <dmp/batch.hpp>
#include <dmp/error.hpp>
#include <dmp/file.hpp>
#include <dmp/fit_report.hpp>
#include <dmp/pose_gripper_dmp.hpp>
#include <dmp/spread.hpp>

#include <cmath>

#include "allocations.hpp"
#include "motions.hpp"

using namespace dmp;
using namespace motions;

namespace {

RowMatrix opening(const Eigen::VectorXd& times) {
  RowMatrix width(times.size(), 1);
  width.col(0) = 0.04 * (1.0 + (3.0 * times.array()).cos());
  return width;
}

PoseGripperDemonstration demonstration(int count = 200, double duration = 2.0) {
  const PoseDemonstration tool = pose(count, duration, 1.3);
  return {tool, Demonstration(tool.time(), opening(tool.time()))};
}

DmpOptions few() {
  DmpOptions options;
  options.basis_count = 30;
  options.derivatives = Derivatives::interpolate;
  return options;
}

PoseGripperDmp::Point other_goal(const PoseGripperDmp& model) {
  PoseGripperDmp::Point goal = model.goal();
  goal.first.topRightCorner<3, 1>() += Eigen::Vector3d(.1, -.05, .02);
  goal.first.topLeftCorner<3, 3>() *= so3::exp({.2, -.1, .1});
  goal.second[0] += 0.02;
  return goal;
}

}  // namespace

TEST_CASE("a pose with a gripper moves as the pose and the gripper do alone, under every scaling and form") {
  for (const Scaling scaling : {Scaling::none, Scaling::per_axis_relative, Scaling::rotation_dilation})
    for (const OrientationForm form :
         {OrientationForm::ude, OrientationForm::log_linear, OrientationForm::turning}) {
      if (form == OrientationForm::turning && scaling != Scaling::none) continue;  // refused
      DmpOptions options = few();
      options.scaling = scaling;
      options.orientation_form = form;
      const PoseGripperDemonstration both = demonstration();
      const PoseGripperDmp model = PoseGripperDmp::fit(both, options);
      const PoseDmp tool = PoseDmp::fit(both.first(), options);
      const Dmp gripper = Dmp::fit(both.second(), options);
      const auto goal = other_goal(model);
      const PoseGripperTrajectory motion = model.rollout(goal, 1.5);
      const PoseTrajectory expected = tool.rollout(goal.first, 1.5);
      for (std::size_t k = 0; k < expected.pose.size(); ++k)
        REQUIRE((motion.first.pose[k] - expected.pose[k]).norm() < 1e-10);
      CHECK(largest(motion.second.position, gripper.rollout(goal.second, 1.5).position) < 1e-10);
    }
}

TEST_CASE("a run of a pose with a gripper takes new goals, tempi and starts on the way, without memory") {
  const PoseGripperDmp model = PoseGripperDmp::fit(demonstration(), few());
  PoseGripperRun run(model);
  const auto goal = other_goal(model);
  const PoseGripperDmp::Point start = model.start();
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(7);
  CHECK(allocations_in([&] {
          for (int i = 0; i < 6000; ++i) {
            run.step(1e-3);
            if (i == 300) run.set_goal(goal);
            if (i == 500) run.set_duration(1.0);
            if (i == 700) run.start_from(start, rest);
            if (i == 900) run.reset();
          }
        }) == 0);
  CHECK((run.pose() - goal.first).norm() < 1e-9);
  CHECK(std::abs(run.gripper()[0] - goal.second[0]) < 1e-9);
}

TEST_CASE("a run refuses a goal whose parts do not fit, and nothing changes") {
  const PoseGripperDmp model = PoseGripperDmp::fit(demonstration(), few());
  PoseGripperRun run(model);
  PoseGripperDmp::Point bad = model.goal();
  bad.second = Eigen::VectorXd::Zero(2);
  CHECK(run.set_goal(bad) == Status::invalid_input);
  bad = model.goal();
  bad.first(0, 0) += 0.1;
  CHECK(run.set_goal(bad) == Status::invalid_input);
  CHECK(run.start_from(model.start(), Eigen::VectorXd::Zero(6)) == Status::invalid_input);
  CHECK(run.goal().second == model.goal().second);
  CHECK_THROWS_AS(model.rollout(bad), InvalidArgument);
}

TEST_CASE("a model file keeps a pose with a gripper to the last bit") {
  const PoseGripperDmp model = PoseGripperDmp::fit(demonstration(), few());
  const std::string text = to_json(model);
  const PoseGripperDmp again = std::get<PoseGripperDmp>(from_json(text));
  CHECK(to_json(again) == text);
  CHECK(again.parameters().weights == model.parameters().weights);
  CHECK(again.start() == model.start());
}

TEST_CASE("a pose with a gripper that turns far turns along with its pose, in a file, too") {
  const PoseDemonstration tool = pose(400, 2.0, 1.3);
  Poses poses = tool.pose();
  for (std::size_t k = 0; k < poses.size(); ++k)
    poses[k].topLeftCorner<3, 3>() = so3::exp({0, 0, 7.0 * minimum_jerk(static_cast<double>(k) / 399.0)});
  const PoseGripperDemonstration both{PoseDemonstration(tool.time(), poses),
                                      Demonstration(tool.time(), opening(tool.time()))};
  const PoseGripperDmp model = PoseGripperDmp::fit(both, few());
  CHECK(model.options().orientation_form == OrientationForm::turning);
  CHECK(model.parameters().reference == PoseDmp::fit(both.first(), few()).parameters().reference);
  const PoseGripperDmp again = std::get<PoseGripperDmp>(from_json(to_json(model)));
  CHECK(again.parameters().reference == model.parameters().reference);
  CHECK(again.rollout().first.pose == model.rollout().first.pose);
  CHECK(assess(model, {both}).rmse.maxCoeff() < 1e-3);
}

TEST_CASE("reports, averages, spreads and batches are there for a product, too") {
  const std::vector<PoseGripperDemonstration> both{demonstration(), demonstration(150, 1.6)};
  const FitReport report = assess(PoseGripperDmp::fit(both[0]), {both[0]});
  CHECK(report.rmse.size() == 7);
  CHECK(report.rmse.maxCoeff() < 1e-3);
  const auto models = fit_each(both, few());
  CHECK(average(models).duration() == doctest::Approx(1.8));
  const auto spreads = spread(both, 11);
  CHECK(spreads.mean.first.size() == 11);
  CHECK(spreads.covariance[5].rows() == 7);
  const auto motions = rollout_each(models[0], {other_goal(models[0])}, {}, 21);
  const auto alone = models[0].rollout(other_goal(models[0]), 2.0, 0.1);
  CHECK(motions[0].first.pose.back() == alone.first.pose.back());
  CHECK(motions[0].second.position == alone.second.position);
}

TEST_CASE("parts that were recorded at other times are refused") {
  const PoseDemonstration tool = pose(50, 1.0);
  const Eigen::VectorXd later = 1.1 * tool.time();
  CHECK_THROWS_AS(PoseGripperDemonstration(tool, Demonstration(later, opening(later))), InvalidArgument);
}
