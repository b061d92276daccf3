#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/file.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/pose_gripper_dmp.hpp>

#include <vector>

#include "motions.hpp"

using namespace dmp;
using namespace motions;
using Eigen::Vector3d;
using Eigen::VectorXd;

// New starts and goals: the motion goes to them as the demonstration advances.

namespace {

const double kDegree = M_PI / 180;

/// How far a path goes back against the way from its start to its goal.
double backwards(const RowMatrix& path, const VectorXd& goal) {
  const VectorXd way = (goal - path.row(0).transpose()).normalized();
  double furthest = 0.0;
  double back = 0.0;
  for (Eigen::Index k = 0; k < path.rows(); ++k) {
    const double along = (path.row(k) - path.row(0)).dot(way);
    furthest = std::max(furthest, along);
    back = std::max(back, furthest - along);
  }
  return back;
}

/// A reach of 0.4 m along x that rests a fifth of its time at either end.
Demonstration reach_with_rests() {
  const VectorXd t = grid(501, 2.5);
  RowMatrix y = RowMatrix::Zero(501, 3);
  for (int k = 0; k < 501; ++k)
    y(k, 0) = .4 * minimum_jerk(std::min(1.0, std::max(0.0, (t[k] / 2.5 - .2) / .6)));
  return {t, y};
}

double peak(const RowMatrix& values) { return values.rowwise().norm().maxCoeff(); }

DmpOptions with(Scaling scaling) {
  DmpOptions options;
  options.scaling = scaling;
  return options;
}

}  // namespace

TEST_CASE(
    "a nearer, a farther and a sideways goal: never back, at rest at the start, at the goal in the end") {
  const Dmp model = Dmp::fit(reach_with_rests(), with(Scaling::advance));
  CHECK(model.options().scaling == Scaling::advance);
  const double demonstrated = peak(model.rollout().acceleration);
  for (const Vector3d& goal : {Vector3d(.35, 0, 0), Vector3d(.2, 0, 0), Vector3d(.1, 0, 0),
                               Vector3d(.8, 0, 0), Vector3d(.4, .12, 0), Vector3d(.4, 0, -.12)}) {
    const Trajectory motion = model.rollout(VectorXd(goal));
    const Eigen::Index last = motion.position.rows() - 1;
    CHECK(backwards(motion.position, goal) < 1e-4);
    CHECK(motion.acceleration.row(0).norm() < .15 * demonstrated);
    CHECK((motion.position.row(last).transpose() - goal).norm() < 1e-5);
    CHECK(peak(motion.acceleration) < 1.2 * demonstrated * std::max(1.0, goal[0] / .4));
  }
  // What the spring alone does instead.
  const Trajectory jump =
      Dmp::fit(reach_with_rests(), with(Scaling::none)).rollout(VectorXd(Vector3d(.2, 0, 0)));
  CHECK(backwards(jump.position, Vector3d(.2, 0, 0)) > .05);
  CHECK(jump.acceleration.row(0).norm() > 2 * demonstrated);
}

TEST_CASE("a straight reach to a goal along its way is the demonstration, scaled") {
  const Demonstration demonstration = reach(400, 2.0);
  const Dmp model = Dmp::fit(demonstration, with(Scaling::advance));
  for (const double share : {.25, .5, 2.0}) {
    const RowMatrix scaled = share * demonstration.position();
    const RowMatrix led = model.rollout_at(demonstration.time(), VectorXd(share * model.goal())).position;
    CHECK(largest(led, scaled) < .03 * model.goal().norm());
  }
}

TEST_CASE("at the demonstrated start and goal nothing is added") {
  for (const Demonstration& demonstration : {reach(400, 2.0), helix(400, 3.0, .1, .2, 2.0)}) {
    const Dmp model = Dmp::fit(demonstration, with(Scaling::advance));
    const Dmp plain = Dmp::fit(demonstration, with(Scaling::none));
    CHECK((model.parameters().weights - plain.parameters().weights).norm() <
          1e-6 * plain.parameters().weights.norm());
    CHECK(model.rollout(model.goal()).position == model.rollout().position);
    CHECK(largest(model.rollout().position, plain.rollout().position) < 1e-10);
  }
}

TEST_CASE("the motion is linear in its goal, so no goal is badly conditioned") {
  const Dmp loop = Dmp::fit(helix(400, 3.0, .1, .02, 3.0), with(Scaling::advance));  // ends beside its start
  const Vector3d aside(.3, -.2, .1);
  const RowMatrix own = loop.rollout({}, {}, .01).position;
  const RowMatrix led = loop.rollout(VectorXd(loop.goal() + aside), {}, .01).position;
  const RowMatrix further = loop.rollout(VectorXd(loop.goal() + 3 * aside), {}, .01).position;
  CHECK(largest(further - own, 3 * (led - own)) < 1e-9);
  CHECK(peak(led - own) < 1.001 * aside.norm());
}

TEST_CASE("a run whose goal is set before the first step is the rollout; one set on the way makes no jump") {
  const Dmp model = Dmp::fit(reach_with_rests(), with(Scaling::advance));
  const VectorXd goal = Vector3d(.25, .1, 0);
  const Trajectory rollout = model.rollout(goal, {}, 1e-2);
  Run run(model);
  CHECK(run.set_goal(goal) == Status::running);
  for (Eigen::Index k = 1; k < rollout.position.rows(); ++k) {
    run.step(1e-2);
    CHECK((run.position() - rollout.position.row(k).transpose()).norm() < 1e-12);
  }
  Run changed(model);
  for (int k = 0; k < 1000; ++k) changed.step(1e-3);
  const VectorXd before = changed.acceleration();
  changed.set_goal(goal);
  changed.step(1e-6);
  CHECK((changed.acceleration() - before).norm() < 1e-2);
  for (int k = 0; k < 2000; ++k) changed.step(1e-3);
  CHECK((changed.position() - goal).norm() < 2e-4);
}

TEST_CASE("from another start the motion sets out at rest and comes to the demonstrated goal") {
  const Dmp model = Dmp::fit(reach_with_rests(), with(Scaling::advance));
  const double demonstrated = peak(model.rollout().acceleration);
  Run run(model);
  const Vector3d start(-.08, .05, .02);
  run.start_from(start, Vector3d::Zero());
  CHECK(run.acceleration().norm() < .15 * demonstrated);
  double largest_acceleration = 0.0;
  for (int k = 0; k < 2500; ++k) {
    run.step(1e-3);
    largest_acceleration = std::max(largest_acceleration, run.acceleration().norm());
  }
  CHECK(largest_acceleration < 1.4 * demonstrated);
  CHECK((run.position() - model.goal()).norm() < 1e-5);
}

TEST_CASE("takes of different ways teach the advance as well as the shape") {
  std::vector<Demonstration> takes;
  for (const double scale : {.8, 1.0, 1.2}) {
    const Demonstration one = reach(300, 2.0);
    takes.emplace_back(one.time(), RowMatrix(scale * one.position()));
  }
  const Dmp model = Dmp::fit(takes, with(Scaling::advance));
  for (const Demonstration& take : takes) {
    const VectorXd goal = take.position().row(299);
    CHECK(largest(model.rollout_at(take.time(), goal).position, take.position()) < .01 * goal.norm());
  }
}

TEST_CASE("rotations: a goal turned aside is approached without a jump, in every form") {
  const VectorXd t = grid(400, 2.0);
  for (const double whole : {90.0, 360.0}) {  // ude and turning
    Rotations r;
    for (int k = 0; k < 400; ++k)
      r.push_back(so3::exp(whole * kDegree * minimum_jerk(t[k] / 2.0) * Vector3d(0, .6, .8)));
    const OrientationDemonstration demonstration(t, r);
    for (const auto form : {OrientationForm::automatic, OrientationForm::log_linear}) {
      if (whole > 180 && form == OrientationForm::log_linear) continue;
      DmpOptions options = with(Scaling::automatic);
      options.orientation_form = form;
      const OrientationDmp model = OrientationDmp::fit(demonstration, options);
      const OrientationTrajectory own = model.rollout();
      for (const double aside : {20.0, 60.0}) {
        const Eigen::Matrix3d goal = so3::exp(aside * kDegree * Vector3d(1, 0, 0)) * model.goal();
        const OrientationTrajectory led = model.rollout(goal);
        CHECK(so3::distance(led.rotation.back(), goal) < .03 * kDegree);
        CHECK(led.angular_acceleration.row(0).norm() < .15 * peak(own.angular_acceleration));
        CHECK(peak(led.angular_velocity) < (1.0 + aside / whole) * peak(own.angular_velocity));
        CHECK(peak(led.angular_acceleration) < (1.2 + aside / whole) * peak(own.angular_acceleration));
      }
    }
  }
}

TEST_CASE("poses advance part by part; a model keeps its advance in a file, under scaling advance alone") {
  const PoseDmp model = PoseDmp::fit(pose_with_goal_apart(300, 2.0), with(Scaling::automatic));
  CHECK(model.parameters().advance.rows() == model.parameters().weights.rows());
  CHECK(model.parameters().advance.cols() == 2);
  CHECK(model.forcing_of_run().dimension() == 8);
  const Eigen::Matrix4d goal = pose_of(so3::exp(Vector3d(0, 0, .3)) * model.goal().topLeftCorner<3, 3>(),
                                       model.goal().topRightCorner<3, 1>() + Vector3d(.1, 0, 0));
  const std::string text = to_json(model);
  CHECK(text.find("\"advance\"") != std::string::npos);
  const PoseDmp read = std::get<PoseDmp>(from_json(text));
  CHECK(read.parameters().advance == model.parameters().advance);
  CHECK(read.rollout(goal).pose.back() == model.rollout(goal).pose.back());

  PoseDmpParameters parameters = model.parameters();
  parameters.options.scaling = Scaling::none;
  CHECK_THROWS_WITH_AS(PoseDmp{parameters}, doctest::Contains("advance: given"), InvalidArgument);
  parameters.advance = RowMatrix();
  CHECK(PoseDmp(parameters).options().scaling == Scaling::none);
  parameters.options.scaling = Scaling::automatic;
  CHECK(PoseDmp(parameters).options().scaling == Scaling::none);
  parameters.options.scaling = Scaling::advance;
  CHECK_THROWS_WITH_AS(PoseDmp{parameters}, doctest::Contains("advance: 0 x 0, expected"), InvalidArgument);
}

TEST_CASE("motions that stand still, begin on the way or have three samples have an advance too") {
  RowMatrix still = RowMatrix::Constant(50, 3, .2);
  const Dmp resting = Dmp::fit(Demonstration(grid(50, 1.0), still), with(Scaling::advance));
  const Trajectory led = resting.rollout(VectorXd(Vector3d(.3, .2, .2)));
  CHECK(backwards(led.position, Vector3d(.3, .2, .2)) < 1e-4);
  CHECK(led.acceleration.row(0).norm() < .2);
  const Dmp moving = Dmp::fit(helix(200, 2.0, .1, .4, .5), with(Scaling::advance));
  CHECK(moving.rollout(VectorXd(moving.goal() + Vector3d(.05, 0, 0))).position.allFinite());
  const Dmp three =
      Dmp::fit(Demonstration(grid(3, 1.0), RowMatrix(still.topRows(3))), with(Scaling::advance));
  CHECK(three.rollout(VectorXd(Vector3d(.3, .2, .2))).position.allFinite());
}
