#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/time_optimal.hpp>
#include <dmp/time_scaling.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "arms.hpp"

using dmp::JointTrajectory;
using dmp::TimingLimits;
using doctest::Approx;

namespace {

const double infinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

double duration(const JointTrajectory& joints) {
  return joints.time[joints.time.size() - 1] - joints.time[0];
}

// Through random postures, 400 samples of a sum of sines that is at rest at both ends.
JointTrajectory random_motion(int seed, Eigen::Index joints) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  dmp::RowMatrix positions(400, joints);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(400, 2.0, 7.0);
  for (Eigen::Index i = 0; i < joints; ++i) {
    const double a = unit(random), b = unit(random), c = unit(random);
    for (Eigen::Index k = 0; k < 400; ++k) {
      const double s = 0.5 - 0.5 * std::cos(3.14159265358979 * static_cast<double>(k) / 399.0);
      positions(k, i) = a * s + 0.5 * b * std::sin(3.0 * s) + 0.3 * c * std::sin(7.0 * s);
    }
  }
  return JointTrajectory::through(times, positions);
}

JointTrajectory line(double way) {
  dmp::RowMatrix positions(500, 1);
  positions.col(0) = Eigen::VectorXd::LinSpaced(500, 0.0, way);
  return JointTrajectory::through(Eigen::VectorXd::LinSpaced(500, 0.0, 1.0), positions);
}

}  // namespace

TEST_CASE("A straight way takes the time of the trapezoid: full acceleration, full speed, full braking") {
  const double bang = duration(dmp::time_optimal(line(1.0), {one(infinity), one(4.0), {}}));
  CHECK(bang >= 1.0 - 1e-9);  // 2 sqrt(way / acceleration)
  CHECK(bang < 1.06);         // the spline cannot switch at once
  const double cruise = duration(dmp::time_optimal(line(3.0), {one(1.0), one(2.0), {}}));
  CHECK(cruise >= 3.5 - 1e-9);  // way / speed + speed / acceleration
  CHECK(cruise < 3.6);
}

TEST_CASE("The limits hold to 1e-9 everywhere on the spline, which begins and ends at rest") {
  const Eigen::Vector4d speed(0.7, 1.1, 2.0, 0.9), acceleration(5.0, 9.0, 4.0, 3.0);
  for (int seed = 0; seed < 20; ++seed) {
    const JointTrajectory joints = random_motion(seed, 4);
    const JointTrajectory fast = dmp::time_optimal(joints, {speed, acceleration, {}});
    CAPTURE(seed);
    REQUIRE(dmp::duration_factor(fast, speed, acceleration) <= 1.0 + 1e-9);
    REQUIRE(fast.position == joints.position);
    REQUIRE(fast.time[0] == joints.time[0]);
    const double uniform = duration(joints) * dmp::duration_factor(joints, speed, acceleration);
    REQUIRE(duration(fast) < uniform);
    REQUIRE(fast.velocity.row(0).isZero(0.0));
    REQUIRE(fast.velocity.bottomRows(1).isZero(0.0));
    const JointTrajectory again =
        JointTrajectory::through(fast.time, fast.position, {}, dmp::SplineEnds::at_rest);
    REQUIRE((again.velocity - fast.velocity).cwiseAbs().maxCoeff() < 1e-9);
    REQUIRE((again.acceleration - fast.acceleration).cwiseAbs().maxCoeff() < 1e-5);
  }
}

TEST_CASE("A rest on the way costs next to nothing") {
  dmp::RowMatrix positions(900, 1);
  for (Eigen::Index k = 0; k < 900; ++k) {
    const double s =
        std::min(static_cast<double>(k), std::max(299.0, static_cast<double>(k) - 300.0)) / 599.0;
    positions(k, 0) = 0.5 - 0.5 * std::cos(2.0 * 3.14159265358979 * s);  // there, a rest of 300 samples, back
  }
  const JointTrajectory joints =
      JointTrajectory::through(Eigen::VectorXd::LinSpaced(900, 0.0, 9.0), positions);
  const double found = duration(dmp::time_optimal(joints, {one(infinity), one(4.0), {}}));
  CHECK(found >= 2.0 - 1e-6);
  CHECK(found < 2.3);
}

TEST_CASE("The effort limit holds at every sample, by a pendulum's closed form") {
  // 2 kg at 0.5 m on a horizontal axis: effort = m l^2 qdd + m g l cos(q).
  const std::string text =
      "<robot name=\"pendulum\"><link name=\"a\"/><link name=\"b\"><inertial><origin xyz=\"0.5 0 0\"/>"
      "<mass value=\"2\"/><inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" "
      "izz=\"0\"/></inertial></link>"
      "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 -1 0\"/>"
      "<limit lower=\"-3\" upper=\"3\" velocity=\"9\" effort=\"20\"/></joint></robot>";
  const dmp::Arm arm = dmp::Arm::from_urdf(text);
  const JointTrajectory joints = line(1.5);
  const TimingLimits limits = {one(9.0), one(100.0), one(12.0)};
  const JointTrajectory fast = dmp::time_optimal(arm, joints, limits);
  double worst = 0.0;
  for (Eigen::Index k = 0; k < fast.time.size(); ++k)
    worst = std::max(worst, std::abs(0.5 * fast.acceleration(k, 0) + 9.81 * std::cos(fast.position(k, 0))));
  CHECK(worst <= 12.0 * (1.0 + 1e-9));
  CHECK(worst > 11.0);
  CHECK_THROWS_WITH_AS(dmp::time_optimal(arm, joints, {one(9.0), one(100.0), one(9.0)}),
                       doctest::Contains("stand still"), dmp::InvalidArgument);
  const JointTrajectory floating =
      dmp::time_optimal(arm, joints, {one(9.0), one(100.0), one(0.5)}, Eigen::Vector3d::Zero());
  CHECK(floating.acceleration.cwiseAbs().maxCoeff() <= 1.0 + 1e-9);
  CHECK(duration(floating) == Approx(2.0 * std::sqrt(1.5)).epsilon(0.03));
}

TEST_CASE("What rests stays as it is") {
  const JointTrajectory still =
      JointTrajectory::through(Eigen::VectorXd::LinSpaced(5, 0.0, 1.0), dmp::RowMatrix::Ones(5, 1));
  CHECK(dmp::time_optimal(still, {one(1.0), one(1.0), {}}).time == still.time);
}

TEST_CASE("Limits that are none are refused by name") {
  const JointTrajectory joints = line(1.0);
  CHECK_THROWS_WITH_AS(dmp::time_optimal(joints, {one(0.0), one(1.0), {}}), doctest::Contains("velocity[0]"),
                       dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(dmp::time_optimal(joints, {one(1.0), one(infinity), {}}),
                       doctest::Contains("acceleration[0]"), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(dmp::time_optimal(joints, {one(1.0), one(1.0), one(1.0)}),
                       doctest::Contains("needs an arm"), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(
      dmp::time_optimal(dmp::Arm::from_urdf(arms::two_link()), joints, {one(1.0), one(1.0), {}}),
      doctest::Contains("columns"), dmp::InvalidArgument);
}
