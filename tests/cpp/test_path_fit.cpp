#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/path_fit.hpp>
#include <dmp/so3.hpp>
#include <dmp/time_scaling.hpp>

#include <cmath>
#include <random>

#include "arms.hpp"

using dmp::Arm;
using dmp::JointTrajectory;
using dmp::PathFit;
using dmp::PathFitOptions;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;

struct Path {
  Eigen::VectorXd times;
  dmp::RowMatrix joints;
  dmp::Poses poses;
};

// Joints that swing smoothly, with a ripple of the null space or of noise on top that is faster than the arm.
Path swing(const Arm& arm, double ripple, int seed = 1, double duration = 2.0) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Path path;
  path.times = Eigen::VectorXd::LinSpaced(401, 0.0, duration);
  path.joints.resize(401, arm.joint_count());
  for (Eigen::Index j = 0; j < arm.joint_count(); ++j) {
    const double a = 0.4 * unit(random), b = 0.3 * unit(random), c = ripple * unit(random),
                 at = 3.0 * unit(random);
    for (Eigen::Index k = 0; k < 401; ++k) {
      const double t = path.times[k] / duration;
      path.joints(k, j) = 0.5 * (arm.lower()[j] + arm.upper()[j]) + 0.3 + a * std::sin(2.0 * pi * t + at) +
                          b * std::sin(4.0 * pi * t) + c * std::sin(100.0 * pi * t);
    }
  }
  path.poses = arm.forward_kinematics(path.joints);
  return path;
}

void check_within(const Arm& arm, const Path& path, const PathFit& fit, const PathFitOptions& options) {
  const dmp::Poses reached = arm.forward_kinematics(fit.joints.position);
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Eigen::Matrix4d wanted = fit.base_change * path.poses[k] * fit.tool_change;
    REQUIRE((reached[k] - wanted).topRightCorner<3, 1>().norm() <= options.position_tolerance + 1e-12);
    const Eigen::Matrix3d turn = wanted.topLeftCorner<3, 3>() * reached[k].topLeftCorner<3, 3>().transpose();
    REQUIRE(dmp::so3::log(turn).norm() <= options.angle_tolerance + 1e-9);
  }
  for (Eigen::Index k = 0; k < fit.joints.position.rows(); ++k) {
    const Eigen::VectorXd q = fit.joints.position.row(k);
    REQUIRE((q.array() >= arm.lower().array()).all());
    REQUIRE((q.array() <= arm.upper().array()).all());
  }
}

}  // namespace

TEST_CASE("A ripple below the tolerance is smoothed out, and what is returned is within every limit") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  for (int seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Path path = swing(arm, 6e-4, seed);
    const PathFitOptions options;
    const PathFit fit = dmp::fit_path(arm, path.times, path.poses, path.joints, options);
    const JointTrajectory start = JointTrajectory::through(path.times, path.joints);
    const double before = dmp::duration_factor(start, arm.velocity_limit(), arm.acceleration_limit());
    const double after = dmp::duration_factor(fit.joints, arm.velocity_limit(), arm.acceleration_limit());
    CHECK(fit.start_factor == Approx(before).epsilon(0.05));
    CHECK(fit.duration_factor == Approx(after).epsilon(0.02));
    CHECK(fit.improved);
    CHECK(after < 0.8 * before);
    check_within(arm, path, fit, options);
    CHECK(fit.position_max <= options.position_tolerance);
    CHECK(fit.angle_max <= options.angle_tolerance);
    CHECK(fit.limit_margin >= 0.0);
    const PathFit again = dmp::fit_path(arm, path.times, path.poses, path.joints, options);
    CHECK(again.joints.position == fit.joints.position);
  }
}

TEST_CASE(
    "A joint that turns about a fixed axis cannot do better than a constant speed: the optimum is known") {
  // One joint, 0.6 rad to and fro within 1 s, orientation free: the tip may be 5 mm away on a circle of 1 m.
  const Arm arm = Arm::from_urdf(arms::two_link()).with_limits({});
  Path path;
  path.times = Eigen::VectorXd::LinSpaced(501, 0.0, 1.0);
  path.joints = dmp::RowMatrix::Zero(501, 2);
  for (Eigen::Index k = 0; k < 501; ++k) path.joints(k, 0) = 0.3 * std::sin(2.0 * pi * path.times[k]);
  path.poses = arm.forward_kinematics(path.joints);
  PathFitOptions options;
  options.position_tolerance = 0.05;
  options.weight.tail<3>().setZero();
  options.velocity = Eigen::Vector2d(1.0, 1.0);
  options.acceleration = Eigen::Vector2d(1e4, 1e4);
  const PathFit fit = dmp::fit_path(arm, path.times, path.poses, path.joints, options);
  // From peak to peak 2 x (0.3 x 2 m - 2 x 0.05 m) of way at 2 m from the base in half a second, at least.
  CHECK(fit.start_factor == Approx(0.6 * pi).epsilon(0.01));
  CHECK(fit.duration_factor < 0.8 * fit.start_factor);
  check_within(arm, path, fit, [&] {
    PathFitOptions loose = options;
    loose.angle_tolerance = 10.0;
    return loose;
  }());
}

TEST_CASE("A motion that is fast enough is left alone") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  const Path path = swing(arm, 0.0, 2, 60.0);
  const PathFit fit = dmp::fit_path(arm, path.times, path.poses, path.joints);
  CHECK_FALSE(fit.improved);
  CHECK(fit.joints.position == path.joints);
  CHECK(fit.iterations == 0);
  CHECK(fit.base_change.isIdentity(1e-12));
}

TEST_CASE("What is refused is not returned") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  const Path path = swing(arm, 6e-4);
  PathFitOptions options;
  int asked = 0;
  options.accept = [&](const JointTrajectory&) { return ++asked, false; };
  const PathFit fit = dmp::fit_path(arm, path.times, path.poses, path.joints, options);
  CHECK(asked > 0);
  CHECK_FALSE(fit.improved);
  CHECK(fit.joints.position == path.joints);
  CHECK(fit.duration_factor == fit.start_factor);
}

TEST_CASE("A path that may be moved is at least as fast, and says where it was moved to") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  const Path path = swing(arm, 6e-4, 3);
  PathFitOptions options;
  options.free_placement = true;
  const PathFit fit = dmp::fit_path(arm, path.times, path.poses, path.joints, options);
  CHECK(fit.improved);
  CHECK_FALSE(fit.base_change.isIdentity(1e-6));
  CHECK(fit.base_change(2, 0) == 0.0);  // turned about z alone
  CHECK(fit.base_change(2, 2) == 1.0);
  check_within(arm, path, fit, options);
}

TEST_CASE("Effort limits are looked at where they are given") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  const Path path = swing(arm, 6e-4);
  PathFitOptions options;
  options.effort = Eigen::VectorXd::Constant(7, 1e6);
  const PathFit fit = dmp::fit_path(arm, path.times, path.poses, path.joints, options);
  CHECK(fit.improved);
  check_within(arm, path, fit, options);
}

TEST_CASE("Arguments that are none are refused by name") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  const Path path = swing(arm, 0.0);
  const auto refused = [&](const PathFitOptions& options, const char* text) {
    CHECK_THROWS_WITH_AS(dmp::fit_path(arm, path.times, path.poses, path.joints, options),
                         doctest::Contains(text), dmp::InvalidArgument);
  };
  PathFitOptions options;
  options.position_tolerance = 0.0;
  refused(options, "position_tolerance");
  options = {};
  options.angle_tolerance = -1.0;
  refused(options, "angle_tolerance");
  options = {};
  options.velocity = Eigen::VectorXd::Ones(3);
  refused(options, "velocity: 3, expected 7");
  options = {};
  options.iterations = 0;
  refused(options, "iterations");
  options = {};
  options.spline_coefficients = 3;
  refused(options, "spline_coefficients: 3");
  options = {};
  options.slowdown = Eigen::VectorXd::Ones(3);
  refused(options, "slowdown");
  CHECK_THROWS_WITH_AS(dmp::fit_path(arm, path.times, {}, path.joints), doctest::Contains("poses: 0"),
                       dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(dmp::fit_path(arm, path.times, path.poses, path.joints.leftCols(3)),
                       doctest::Contains("start: columns: 3, expected 7"), dmp::InvalidArgument);
}
