#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/time_scaling.hpp>

#include <cmath>
#include <limits>
#include <random>

using dmp::JointTrajectory;
using doctest::Approx;

namespace {

const double infinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

// q = t^3 - t on uneven times: a cubic, which the spline reproduces exactly.
JointTrajectory cubic() {
  Eigen::VectorXd times(7);
  times << 0.0, 0.1, 0.35, 0.5, 0.8, 0.85, 1.0;
  dmp::RowMatrix positions = (times.array().cube() - times.array()).matrix();
  return JointTrajectory::through(times, positions);
}

JointTrajectory random_motion(int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  dmp::RowMatrix positions(12, 3);
  for (Eigen::Index i = 0; i < positions.size(); ++i) positions.data()[i] = unit(random);
  return JointTrajectory::through(Eigen::VectorXd::LinSpaced(12, 1.0, 3.0), positions);
}

// The spline itself, between samples, from the values and second derivatives at the knots.
double spline_speed(const JointTrajectory& joints, double t, Eigen::Index i) {
  Eigen::Index k = 0;
  while (k + 2 < joints.time.size() && joints.time[k + 1] <= t) ++k;
  const double h = joints.time[k + 1] - joints.time[k], s = t - joints.time[k];
  const double a0 = joints.acceleration(k, i), a1 = joints.acceleration(k + 1, i);
  return joints.velocity(k, i) + a0 * s + 0.5 * (a1 - a0) * s * s / h;
}

}  // namespace

TEST_CASE("The joint spline reproduces a cubic and its derivatives on uneven times") {
  const JointTrajectory joints = cubic();
  for (Eigen::Index k = 0; k < joints.time.size(); ++k) {
    const double t = joints.time[k];
    CHECK(joints.velocity(k, 0) == Approx(3.0 * t * t - 1.0).epsilon(1e-12));
    CHECK(std::abs(joints.acceleration(k, 0) - 6.0 * t) < 1e-11);
  }
}

TEST_CASE("The joint spline's velocity is continuous across every sample") {
  const JointTrajectory joints = random_motion(1);
  for (Eigen::Index k = 1; k < joints.time.size(); ++k)
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double h = joints.time[k] - joints.time[k - 1];
      const double mean = 0.5 * (joints.acceleration(k, i) + joints.acceleration(k - 1, i));
      CHECK(joints.velocity(k - 1, i) + h * mean == Approx(joints.velocity(k, i)).epsilon(1e-10));
    }
}

TEST_CASE("Few samples make the polynomial through them") {
  const JointTrajectory still = JointTrajectory::through(one(0.5), dmp::RowMatrix::Ones(1, 2));
  CHECK(still.velocity.isZero());
  const JointTrajectory line = JointTrajectory::through(Eigen::Vector2d(0.0, 2.0), Eigen::Vector2d(1.0, 2.0));
  CHECK(line.velocity(0, 0) == 0.5);
  CHECK(line.acceleration.isZero());
  const JointTrajectory parabola =
      JointTrajectory::through(Eigen::Vector3d(0.0, 1.0, 3.0), Eigen::Vector3d(0.0, 1.0, 9.0));
  CHECK(parabola.acceleration(1, 0) == Approx(2.0));
  CHECK(parabola.velocity(2, 0) == Approx(6.0));
}

TEST_CASE("A spline that ends at rest does so exactly; between two samples it is 3 s^2 - 2 s^3") {
  const JointTrajectory step = JointTrajectory::through(Eigen::Vector2d(0.0, 2.0), Eigen::Vector2d(1.0, 2.0),
                                                        {}, dmp::SplineEnds::at_rest);
  CHECK(step.velocity.isZero(0.0));
  CHECK(step.acceleration(0, 0) == Approx(1.5));  // 6 way / time^2
  CHECK(step.acceleration(1, 0) == Approx(-1.5));
  const JointTrajectory still =
      JointTrajectory::through(one(0.5), dmp::RowMatrix::Ones(1, 2), {}, dmp::SplineEnds::at_rest);
  CHECK(still.velocity.isZero(0.0));
}

TEST_CASE("The duration factor is the closed form where speed or acceleration binds") {
  const JointTrajectory joints = cubic();  // |qd| <= 2 at t = 1, |qdd| <= 6 at t = 1
  CHECK(dmp::duration_factor(joints, one(0.5), one(infinity)) == Approx(4.0));
  CHECK(dmp::duration_factor(joints, one(infinity), one(1.5)) == Approx(2.0));
  CHECK(dmp::duration_factor(joints, one(8.0), one(24.0)) == Approx(0.5));
}

TEST_CASE("The speed between the samples counts") {
  // q = t^3 - 0.75 t: its speed is at most 0.33 at the samples and 0.75 between the two in the middle.
  const Eigen::Vector4d times(-0.6, -0.5, 0.5, 0.6);
  const JointTrajectory joints =
      JointTrajectory::through(times, (times.array().cube() - 0.75 * times.array()).matrix());
  CHECK(joints.velocity.cwiseAbs().maxCoeff() == Approx(0.33));
  CHECK(dmp::duration_factor(joints, one(1.0), one(infinity)) == Approx(0.75));
}

TEST_CASE(
    "After stretching by the factor the limits hold everywhere on the spline, and one of them exactly") {
  const Eigen::Vector3d speed(0.7, 1.1, 2.0), acceleration(5.0, 9.0, 4.0);
  for (int seed = 0; seed < 50; ++seed) {
    const JointTrajectory joints = random_motion(seed);
    const JointTrajectory slow = dmp::stretched(joints, dmp::duration_factor(joints, speed, acceleration));
    double worst = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      worst = std::max(worst, std::sqrt(slow.acceleration.col(i).cwiseAbs().maxCoeff() / acceleration[i]));
      for (int k = 0; k <= 20000; ++k) {
        const double t = slow.time[0] + (slow.time[11] - slow.time[0]) * k / 20000.0;
        worst = std::max(worst, std::abs(spline_speed(slow, t, i)) / speed[i]);
      }
    }
    REQUIRE(worst <= 1.0 + 1e-9);
    REQUIRE(worst >= 1.0 - 1e-6);
  }
}

TEST_CASE("Stretching keeps the path and is what the spline of the slower samples says") {
  const JointTrajectory joints = random_motion(3);
  const JointTrajectory slow = dmp::stretched(joints, 2.5);
  CHECK(slow.position == joints.position);
  CHECK(slow.time[0] == joints.time[0]);
  CHECK(slow.time[11] - slow.time[0] == Approx(5.0));
  const JointTrajectory again = JointTrajectory::through(slow.time, slow.position);
  CHECK((slow.velocity - again.velocity).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((slow.acceleration - again.acceleration).cwiseAbs().maxCoeff() < 1e-11);
}

TEST_CASE("Joints that rest need no time") {
  const JointTrajectory still =
      JointTrajectory::through(Eigen::Vector3d(0, 1, 2), dmp::RowMatrix::Ones(3, 1));
  CHECK(dmp::duration_factor(still, one(1.0), one(1.0)) == 0.0);
}

TEST_CASE("Limits and factors out of range are refused by name") {
  const JointTrajectory joints = cubic();
  CHECK_THROWS_WITH_AS(dmp::duration_factor(joints, one(0.0), one(1.0)),
                       doctest::Contains("velocity_limit[0]"), dmp::InvalidArgument);
  CHECK_THROWS_AS(dmp::duration_factor(joints, Eigen::Vector2d(1, 1), one(1.0)), dmp::InvalidArgument);
  CHECK_THROWS_AS(dmp::duration_factor(joints, one(1.0), one(std::nan(""))), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(dmp::stretched(joints, 0.0), doctest::Contains("factor"), dmp::InvalidArgument);
  CHECK_THROWS_AS(dmp::stretched(joints, infinity), dmp::InvalidArgument);
}

TEST_CASE("Samples that are no motion are refused by name") {
  CHECK_THROWS_WITH_AS(JointTrajectory::through(Eigen::Vector2d(0.0, 0.0), dmp::RowMatrix::Ones(2, 1)),
                       doctest::Contains("times[1]"), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(JointTrajectory::through(one(0.0), dmp::RowMatrix::Constant(1, 1, std::nan(""))),
                       doctest::Contains("positions[0]"), dmp::InvalidArgument);
  CHECK_THROWS_AS(JointTrajectory::through(one(0.0), dmp::RowMatrix::Ones(2, 1)), dmp::InvalidArgument);
}

TEST_CASE("The duration factor of an effort limit is a pendulum's closed form, and holds after stretching") {
  // 2 kg at 0.5 m about a vertical axis: effort = m l^2 qdd = 0.5 qdd; gravity has no part.
  const std::string text =
      "<robot name=\"p\"><link name=\"a\"/><link name=\"b\"><inertial><origin xyz=\"0.5 0 0\"/>"
      "<mass value=\"2\"/><inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" "
      "izz=\"0\"/></inertial></link>"
      "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/>"
      "<limit lower=\"-3\" upper=\"3\" velocity=\"9\" effort=\"20\"/></joint></robot>";
  const dmp::Arm arm = dmp::Arm::from_urdf(text);
  const JointTrajectory joints = cubic();  // |qdd| <= 6, an effort of 3 N m
  const auto factor = [&](double effort, const Eigen::Vector3d& gravity = {0, 0, -9.81}) {
    return dmp::duration_factor(arm, joints, one(infinity), one(infinity), one(effort), gravity);
  };
  CHECK(factor(0.75) == Approx(2.0));
  CHECK(factor(12.0) == Approx(0.5));
  CHECK(factor(infinity) == 0.0);
  CHECK(dmp::duration_factor(arm, joints, one(0.5), one(infinity), one(0.75)) == Approx(4.0));
  // With gravity across the axis, holding takes m g l |cos q| of the limit. What is left bounds the motion.
  const Eigen::Vector3d across(0.0, -9.81, 0.0);
  const JointTrajectory slow = dmp::stretched(joints, factor(12.0, across));
  double worst = 0.0;
  for (Eigen::Index k = 0; k < slow.time.size(); ++k)
    worst = std::max(worst, std::abs(0.5 * slow.acceleration(k, 0) + 9.81 * std::cos(slow.position(k, 0))));
  CHECK(worst == Approx(12.0));
  CHECK_THROWS_WITH_AS(factor(9.0, across), doctest::Contains("stand still"), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(factor(9.0, {0.0, infinity, 0.0}), doctest::Contains("gravity"), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(factor(-1.0), doctest::Contains("effort_limit[0]"), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(dmp::duration_factor(arm, random_motion(1), one(1), one(1), one(1)),
                       doctest::Contains("joints: 3 columns"), dmp::InvalidArgument);
  CHECK(dmp::duration_factor(arm, JointTrajectory{{}, dmp::RowMatrix(0, 1), {}, {}, {}}, one(1), one(1),
                             one(1)) == 0.0);
}
