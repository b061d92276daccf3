#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/file.hpp>
#include <dmp/pose_dmp.hpp>

#include <string>
#include <variant>
#include <vector>

#include "motions.hpp"

using namespace dmp;
using namespace motions;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Scalings that multiply the forcing term: where their ratio says nothing, and models under another scaling.

namespace {

const Scaling kMultiplying[] = {Scaling::per_axis, Scaling::per_axis_relative, Scaling::rotation_dilation};

DmpOptions with(Scaling scaling, bool guarded = true) {
  DmpOptions options = stated();
  options.regression = Regression::ridge;
  options.scaling = scaling;
  options.scaling_guard = guarded;
  return options;
}

/// A letter o of 0.2 m: its end lies 4 mm beside its start.
Demonstration loop() {
  const VectorXd t = grid(400, 2.0);
  RowMatrix y(400, 2);
  for (int k = 0; k < 400; ++k) {
    const double s = minimum_jerk(t[k] / 2.0);
    y.row(k) << .1 * std::sin(2 * M_PI * s) + .004 * s, .1 * std::cos(2 * M_PI * s) + .001 * s;
  }
  return {t, y};
}

}  // namespace

TEST_CASE("a loop led 10 cm aside stays in the box of its size, under every scaling, and a note says why") {
  for (const Scaling scaling : kMultiplying) {
    const Dmp model = Dmp::fit(loop(), with(scaling));
    CHECK(model.options().scaling_guard);
    const VectorXd goal = model.goal() + Eigen::Vector2d(.1, 0);
    const RowMatrix moved = model.rollout(goal, {}, .005).position;
    CHECK(moved.cwiseAbs().maxCoeff() < .21);
    CHECK((moved.row(moved.rows() - 1).transpose() - goal).norm() < 1e-4);
    const std::vector<std::string> notes = model.scaling_notes(goal);
    REQUIRE(notes.size() == (scaling == Scaling::rotation_dilation ? 1 : 2));
    CHECK(notes[0].find("too little for " + std::string(scaling == Scaling::per_axis ? "per_axis," : "")) !=
          std::string::npos);
    CHECK(model.rollout(goal, {}, .005).position ==
          Dmp::fit(loop(), with(scaling)).rollout(goal, {}, .005).position);
    const Dmp plain = Dmp::fit(loop(), with(scaling, false));
    CHECK(plain.scaling_notes(goal).empty());
    CHECK(plain.rollout(goal, {}, .005).position.cwiseAbs().maxCoeff() > .5);
  }
}

TEST_CASE("a goal up to 4 times as far is scaled as ever, to the last bit; beyond, the way advances on") {
  const Demonstration demonstration = reach(300, 2.0);
  for (const Scaling scaling : kMultiplying) {
    const Dmp guarded = Dmp::fit(demonstration, with(scaling));
    const Dmp plain = Dmp::fit(demonstration, with(scaling, false));
    const auto led = [&](const Dmp& model, double times) {
      return model.rollout(VectorXd(times * model.goal()), {}, .01).position;
    };
    for (const double times : {-2.0, .1, 1.0, 2.0, 3.9}) {
      CHECK(largest(led(guarded, times), led(plain, times)) < 1e-12);
      CHECK(guarded.scaling_notes(times * guarded.goal()).empty());
    }
    CHECK(largest(led(guarded, 3.999), led(guarded, 4.001)) < 2e-3);
    CHECK(largest(led(guarded, 8.0), 8.0 * led(plain, 1.0)) <
          .05);  // straight: as the demonstration advances
    CHECK(guarded.scaling_notes(8.0 * guarded.goal()).size() ==
          (scaling == Scaling::rotation_dilation ? 1 : 3));
    CHECK(guarded.scaling_notes(8.0 * guarded.goal())[0].find("more than 4 times") != std::string::npos);
  }
}

TEST_CASE("the guard counts from the range: an axis that ends a quarter of it away is scaled") {
  const VectorXd t = grid(300, 1.0);
  const auto there = [&](double end) {
    return Demonstration(t, RowMatrix((M_PI * t).array().sin() + end * t.array()));
  };
  for (const bool enough : {false, true}) {
    const Dmp model = Dmp::fit(there(enough ? .4 : .2), with(Scaling::per_axis_relative));
    CHECK(model.scaling_notes(model.goal()).empty() == enough);
  }
  const Dmp still = Dmp::fit(Demonstration(t, RowMatrix::Zero(300, 1)), with(Scaling::per_axis));
  CHECK(still.scaling_notes(still.goal()).empty());
  CHECK(still.rollout(VectorXd(VectorXd::Ones(1))).position.allFinite());
}

TEST_CASE("takes with other ends are learned together under a guarded scaling") {
  std::vector<Demonstration> takes;
  for (const double end : {.008, .012}) {
    const VectorXd t = grid(300, 2.0);
    RowMatrix y(300, 2);
    for (int k = 0; k < 300; ++k) {
      const double s = minimum_jerk(t[k] / 2.0);
      y.row(k) << .1 * std::sin(2 * M_PI * s) + end * s, (1 + 10 * end) * s;
    }
    takes.emplace_back(t, y);
  }
  for (const Scaling scaling : kMultiplying) {
    const Dmp model = Dmp::fit(takes, with(scaling));
    for (const Demonstration& take : takes) {
      const VectorXd goal = take.position().row(299);
      CHECK(largest(model.rollout_at(take.time(), goal).position, take.position()) < 5e-3);
    }
  }
}

TEST_CASE("a model under another scaling does what a fit with it does") {
  const Demonstration demonstration = helix(400, 2.0, .1, .2, 1.3);
  const VectorXd goal = demonstration.position().row(399).transpose() + Vector3d(.05, -.02, .1);
  const Dmp none = Dmp::fit(demonstration, with(Scaling::none));
  const Dmp advance = Dmp::fit(demonstration, with(Scaling::advance));
  for (const Scaling scaling : {Scaling::none, Scaling::advance, Scaling::per_axis,
                                Scaling::per_axis_relative, Scaling::rotation_dilation}) {
    const Dmp wanted = Dmp::fit(demonstration, with(scaling));
    for (const Dmp& from : {none, advance, Dmp::fit(demonstration, with(Scaling::per_axis))}) {
      const Dmp changed = from.with_scaling(scaling);
      CHECK(changed.options() == wanted.options());
      CHECK(largest(changed.rollout({}, {}, .01).position, wanted.rollout({}, {}, .01).position) < 1e-9);
      CHECK(largest(changed.rollout(goal, {}, .01).position, wanted.rollout(goal, {}, .01).position) < 1e-5);
    }
  }
  CHECK(none.with_scaling(Scaling::automatic).options().scaling == Scaling::advance);
}

TEST_CASE("poses and rotations change their scaling, too; the turning form bears advance and none alone") {
  const PoseDemonstration demonstration = pose_with_goal_apart(300, 2.0);
  const PoseDmp none = PoseDmp::fit(demonstration, with(Scaling::none));
  const PoseDmp advance = PoseDmp::fit(demonstration, with(Scaling::advance));
  Eigen::Matrix4d goal = demonstration.pose().back();
  goal(0, 3) += .1;
  const auto last = [&](const PoseDmp& model) { return model.rollout(goal, {}, .01).pose[100]; };
  CHECK((last(none.with_scaling(Scaling::advance)) - last(advance)).norm() < 1e-5);
  CHECK((last(advance.with_scaling(Scaling::none)) - last(none)).norm() < 1e-12);
  Rotations r;
  for (int k = 0; k < 300; ++k) r.push_back(so3::exp(4.0 * minimum_jerk(k / 299.0) * Vector3d(0, .6, .8)));
  const OrientationDmp turning = OrientationDmp::fit(OrientationDemonstration(grid(300, 1.0), r));
  REQUIRE(turning.options().orientation_form == OrientationForm::turning);
  CHECK_THROWS_WITH_AS(turning.with_scaling(Scaling::per_axis), doctest::Contains("options.scaling"),
                       InvalidArgument);
  const OrientationDmp plain = turning.with_scaling(Scaling::none);
  const OrientationDmp again = plain.with_scaling(Scaling::automatic);
  const Eigen::Matrix3d aside = so3::exp({.5, 0, 0}) * turning.goal();
  CHECK(largest(again.rollout(aside, {}, .01).angular_velocity,
                turning.rollout(aside, {}, .01).angular_velocity) < 1e-3);
}

TEST_CASE("full turns with other ends that are learned together keep their positions and rotations apart") {
  std::vector<PoseDemonstration> takes;
  for (const double far : {.8, 1.0, 1.2}) {
    Poses poses;
    for (int k = 0; k < 300; ++k) {
      const double s = minimum_jerk(k / 299.0);
      poses.push_back(pose_of(so3::exp(5.0 * far * s * Vector3d(0, .6, .8)), far * s * Vector3d(.3, .1, 0)));
    }
    takes.emplace_back(grid(300, 2.0), poses);
  }
  const PoseDmp model = PoseDmp::fit(takes, with(Scaling::advance));
  REQUIRE(model.options().orientation_form == OrientationForm::turning);
  const PoseTrajectory mean = model.rollout_at(takes[1].time());
  const Poses shown = takes[1].pose();
  double moved = 0.0;
  double turned = 0.0;
  for (std::size_t k = 0; k < mean.pose.size(); ++k) {
    const Eigen::Matrix4d& was = shown[k];
    moved = std::max(moved, (mean.pose[k] - was).topRightCorner<3, 1>().norm());
    turned = std::max(turned, so3::distance(mean.pose[k].topLeftCorner<3, 3>(), was.topLeftCorner<3, 3>()));
  }
  CHECK(moved < 1e-3);
  CHECK(turned < .03);
}

TEST_CASE(
    "files keep the guard; one that says nothing of it has none, and the source's own scaling neither") {
  const Dmp guarded = Dmp::fit(reach(100, 1.0), with(Scaling::per_axis_relative));
  const std::string text = to_json(guarded);
  CHECK(text.find("\"scaling_guard\": true") != std::string::npos);
  CHECK(text.find("\"version\": 2") != std::string::npos);
  const auto read = std::get<Dmp>(from_json(text));
  CHECK(read.options().scaling_guard);
  const VectorXd far = 6.0 * guarded.goal();
  CHECK(read.rollout(far).position == guarded.rollout(far).position);
  const Dmp plain = Dmp::fit(reach(100, 1.0), with(Scaling::per_axis_relative, false));
  CHECK(to_json(plain).find("scaling_guard") == std::string::npos);
  CHECK(to_json(plain).find("\"version\": 1") != std::string::npos);
  CHECK_FALSE(std::get<Dmp>(from_json(to_json(plain))).options().scaling_guard);
  CHECK_FALSE(DmpOptions::source().scaling_guard);
  CHECK_FALSE(Dmp::fit(reach(100, 1.0), with(Scaling::advance)).options().scaling_guard);
  CHECK(Dmp::fit(reach(100, 1.0), DmpOptions::source()).parameters().advance.size() == 0);
}

TEST_CASE(
    "a goal that moves while a guarded model runs makes no jump, across the limit of its ratio either") {
  for (const Scaling scaling : kMultiplying) {
    Run run(Dmp::fit(reach(300, 2.0), with(scaling)));
    const VectorXd goal = 6.0 * run.goal();
    double jump = 0.0;
    double most = 0.0;
    for (int i = 0; i < 20000; ++i) {
      if (i == 4000) run.set_goal(goal);
      const VectorXd before = run.acceleration();
      run.step(1e-4);
      jump = std::max(jump, (run.acceleration() - before).norm());
      most = std::max(most, run.acceleration().norm());
    }
    CHECK(jump < 5e-3 * most);
    CHECK((run.position() - goal).norm() < 1e-2 * goal.norm());
  }
}

TEST_CASE("a rollout ends at its duration, whatever the step") {
  const Dmp model = Dmp::fit(reach(100, 1.0), with(Scaling::advance));
  for (const double dt : {.3, .07, 1e-3, .5, 1.0, 3.0, 1.0 / 3.0}) {
    const Trajectory motion = model.rollout({}, {}, dt);
    const Eigen::Index last = motion.time.size() - 1;
    CHECK(motion.time[last] == 1.0);
    CHECK(last == static_cast<Eigen::Index>(std::ceil(1.0 / dt - 1e-6)));
    CHECK(motion.time[last] > motion.time[last - 1]);
    CHECK((motion.position.row(last).transpose() - model.goal()).norm() < 1e-5);
    const RowMatrix same = model.rollout_at(motion.time).position;
    CHECK(largest(motion.position, same) < 1e-12);
  }
  const Trajectory longer = model.rollout({}, 2.5, 1.0);
  CHECK(longer.time == Eigen::Vector4d(0, 1, 2, 2.5));
}
