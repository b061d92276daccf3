// Every number that can be given to dmp::kinematics, replaced by every bad one; see refusals.hpp.
#include <doctest/doctest.h>
#include <dmp/ik_branches.hpp>
#include <dmp/inverse_kinematics.hpp>
#include <dmp/joint_tracker.hpp>
#include <dmp/time_optimal.hpp>
#include <dmp/time_scaling.hpp>

#include "arms.hpp"
#include "refusals.hpp"

using namespace dmp;
using namespace refusals;

namespace {

using Eigen::Matrix4d;
using Eigen::VectorXd;

const Arm& arm() {
  static const Arm shared = Arm::from_urdf(arms::two_link());
  return shared;
}
VectorXd joints() { return Eigen::Vector2d(.3, .7); }
VectorXd ones() { return VectorXd::Ones(2); }
Matrix4d reached() { return arm().forward_kinematics(joints()); }
VectorXd times() { return VectorXd::LinSpaced(6, 0.0, 1.0); }
RowMatrix way() {
  RowMatrix q(6, 2);
  for (int k = 0; k < 6; ++k) q.row(k) << .3 + .05 * k, .7 - .04 * k;
  return q;
}
Poses path() { return arm().forward_kinematics(way()); }
JointTrajectory motion() { return JointTrajectory::through(times(), way()); }

/// Joints of a motion may be of any size of number, but none may be NaN.
VectorXd numbers_of(const JointTrajectory& found) {
  VectorXd all(found.time.size() + found.position.size() + found.velocity.size());
  all << found.time, found.position.reshaped(), found.velocity.reshaped();
  return all;
}

IkOptions quick() {
  IkOptions options;
  options.iteration_limit = 50;
  options.diagnose = false;
  return options;
}

template <class Options, class Member, class Value, class Use>
void check_option(const char* name, const Options& defaults, Member member, Argument<Value> argument,
                  const Use& use) {
  check(
      name,
      [&](const Value& value) {
        Options options = defaults;
        options.*member = value;
        return use(options);
      },
      argument);
}

/// Nothing is thrown: a pose or seed that is none is named by the status, and the joints are within the
/// limits.
template <class T, class Solve>
void check_solving(const Argument<T>& argument, const Solve& solve) {
  for (const auto& bad_value : bad(argument)) {
    CAPTURE(argument.name);
    CAPTURE(bad_value.name);
    const IkResult found = solve(bad_value.value);
    if (bad_value.never) CHECK(found.status == IkStatus::invalid_input);
    if (found.status == IkStatus::invalid_input) continue;
    CHECK(arms::within_limits(arm(), found.joints));
    CHECK(no_nan(found.position_error + found.angle_error));
  }
}

}  // namespace

TEST_CASE("what is asked of an arm") {
  check(
      "forward_kinematics", [](const VectorXd& q) { return arm().forward_kinematics(q); },
      argument("q", joints()));
  check(
      "forward_kinematics of many", [](const RowMatrix& q) { return arm().forward_kinematics(q); },
      any_size("q", way()));
  check("jacobian", [](const VectorXd& q) { return arm().jacobian(q); }, argument("q", joints()));
  check("manipulability", [](const VectorXd& q) { return arm().manipulability(q); }, argument("q", joints()));
  check(
      "with_limits",
      [](const VectorXd& lower, const VectorXd& upper, const VectorXd& velocity, const VectorXd& effort) {
        return arm().with_limits({lower, upper, velocity, effort}).lower();
      },
      or_infinite("lower", VectorXd(-ones())), or_infinite("upper", ones()), or_infinite("velocity", ones()),
      or_infinite("effort", ones()));
}

TEST_CASE("single poses") {
  check_solving(argument("pose", reached()),
                [](const Matrix4d& pose) { return InverseKinematics(arm(), quick()).solve(pose); });
  check_solving(argument("seed", joints()), [](const VectorXd& seed) {
    return InverseKinematics(arm(), quick()).solve(reached(), seed);
  });
  const auto solved = [](const IkOptions& options) {
    return InverseKinematics(arm(), options).solve(reached(), ones()).joints;
  };
  check_option("position_tolerance", quick(), &IkOptions::position_tolerance, or_infinite("value", 1e-6),
               solved);
  check_option("angle_tolerance", quick(), &IkOptions::angle_tolerance, or_infinite("value", 1e-6), solved);
  check_option("angle_weight", quick(), &IkOptions::angle_weight, argument("value", .1), solved);
  check_option("max_step", quick(), &IkOptions::max_step, or_infinite("value", 1.0), solved);
  check_option("weight", quick(), &IkOptions::weight, argument("value", IkOptions().weight), solved);
  for (const int limit : {0, -1, INT_MIN}) {
    IkOptions options;
    options.iteration_limit = limit;
    CHECK_THROWS_AS(InverseKinematics(arm(), options), InvalidArgument);
  }
}

TEST_CASE("many poses: one that is none is named by its status, the others are solved") {
  for (const auto& bad_value : bad(argument("poses", path()))) {
    CAPTURE(bad_value.name);
    const IkBatch found = InverseKinematics(arm(), quick()).solve_many(bad_value.value, joints());
    CHECK(found.joints.rows() == static_cast<Eigen::Index>(bad_value.value.size()));
    CHECK(found.joints.allFinite());
    for (std::size_t k = 0; k < found.status.size(); ++k)
      if (bad_value.never && found.status.size() == 6 && k == 3)
        CHECK(found.status[k] == IkStatus::invalid_input);
  }
}

TEST_CASE("branches of one pose") {
  check(
      "IkBranches",
      [](const Matrix4d& pose, const VectorXd& seed, double apart, int tries) {
        IkBranches branches(arm(), pose, seed, quick(), {apart, std::min(tries, 3)});
        const auto found = branches.next();
        return found ? found->joints : VectorXd();
      },
      argument("pose", reached()), argument("seed", joints()), or_infinite("apart", .3),
      argument("tries", 3));
}

TEST_CASE("paths") {
  const auto followed = [](const VectorXd& t, const Poses& p, const FollowOptions& options) {
    return numbers_of(InverseKinematics(arm(), quick()).follow(t, p, options));
  };
  FollowOptions one;
  one.thorough = false;
  one.anchors = 1;
  one.starts = 1;
  check(
      "follow", [&](const VectorXd& t, const Poses& p) { return followed(t, p, one); },
      argument("times", times()), argument("poses", path()));
  const auto with = [&](const FollowOptions& options) { return followed(times(), path(), options); };
  check(
      "start",
      [&](const VectorXd& start) {
        FollowOptions options = one;
        options.start = start;
        return with(options);
      },
      argument("start", joints()));
  check_option("max_step", one, &FollowOptions::max_step, or_infinite("value", .2), with);
  check_option("position_tolerance", one, &FollowOptions::position_tolerance, or_infinite("value", 1e-5),
               with);
  check_option("angle_tolerance", one, &FollowOptions::angle_tolerance, or_infinite("value", 1e-5), with);
  for (int FollowOptions::* member : {&FollowOptions::anchors, &FollowOptions::starts})
    for (const int value : {0, -1, INT_MIN}) {
      FollowOptions options = one;
      options.*member = value;
      CHECK_THROWS_AS(with(options), InvalidArgument);
    }
}

TEST_CASE("timing of joints") {
  check(
      "through",
      [](const VectorXd& t, const RowMatrix& q) { return numbers_of(JointTrajectory::through(t, q)); },
      argument("times", times()), argument("positions", way()));
  check(
      "duration_factor", [](const VectorXd& v, const VectorXd& a) { return duration_factor(motion(), v, a); },
      or_infinite("velocity_limit", ones()), or_infinite("acceleration_limit", ones()));
  check(
      "stretched", [](double factor) { return numbers_of(stretched(motion(), factor)); },
      argument("factor", 2.0));
  check(
      "time_optimal",
      [](const VectorXd& v, const VectorXd& a) { return numbers_of(time_optimal(motion(), {v, a, {}})); },
      or_infinite("velocity", ones()), argument("acceleration", ones()));
  check(
      "time_optimal of an arm",
      [](const VectorXd& effort, const Eigen::Vector3d& gravity) {
        return numbers_of(time_optimal(arm(), motion(), {ones(), ones(), effort}, gravity));
      },
      or_infinite("effort", VectorXd(50 * ones())), argument("gravity", Eigen::Vector3d(0, 0, -9.81)));
}

TEST_CASE("a tracker is as it was after a refusal") {
  JointTracker tracker(arm(), joints());
  const Matrix4d pose = path()[1];
  tracker.track(pose, .01);
  const auto check_call = [&](const auto& argument, const auto& call) {
    for (const auto& bad_value : bad(argument)) {
      CAPTURE(argument.name);
      CAPTURE(bad_value.name);
      JointTracker trial(tracker), untouched(tracker);
      const IkStatus status = call(trial, bad_value.value);
      if (bad_value.never) CHECK(status == IkStatus::invalid_input);
      if (status == IkStatus::invalid_input) {
        CHECK(trial.joints() == tracker.joints());
        CHECK(trial.velocity() == tracker.velocity());
        trial.track(pose, .01);
        untouched.track(pose, .01);
        CHECK(trial.joints() == untouched.joints());
      }
      CHECK(trial.joints().allFinite());
      CHECK(trial.velocity().allFinite());
    }
  };
  check_call(argument("pose", pose), [](JointTracker& t, const Matrix4d& to) { return t.track(to, .01); });
  check_call(argument("dt", .01), [&](JointTracker& t, double dt) { return t.track(pose, dt); });
  check_call(argument("q", joints()), [](JointTracker& t, const VectorXd& q) { return t.set_joints(q); });
  check(
      "JointTracker", [](const VectorXd& start) { return JointTracker(arm(), start).joints(); },
      argument("start", joints()));
  const auto tracked = [&](const TrackOptions& options) {
    return JointTracker(arm(), joints(), options).joints();
  };
  check_option("angle_weight", TrackOptions(), &TrackOptions::angle_weight, argument("value", .1), tracked);
  check_option("limit_pull", TrackOptions(), &TrackOptions::limit_pull, argument("value", 1.0), tracked);
}
