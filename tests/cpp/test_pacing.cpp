#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/pacing.hpp>
#include <dmp/time_scaling.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "arms.hpp"

using dmp::JointTrajectory;
using dmp::Paced;
using dmp::PacingLimits;
using doctest::Approx;

namespace {

const double infinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

double duration(const Eigen::VectorXd& time) { return time[time.size() - 1] - time[0]; }

PacingLimits limits_of(const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration) {
  PacingLimits limits;
  limits.velocity = velocity;
  limits.acceleration = acceleration;
  return limits;
}

// Sums of sines of random size and frequency: fast in some places only, as a person's motion is.
JointTrajectory random_motion(int seed, Eigen::Index joints, Eigen::Index samples = 800) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  dmp::RowMatrix positions(samples, joints);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(samples, 2.0, 5.0);
  for (Eigen::Index i = 0; i < joints; ++i) {
    const double a = unit(random), b = unit(random), c = 0.3 * unit(random),
                 at = 2.5 + 2.0 * std::abs(unit(random));
    for (Eigen::Index k = 0; k < samples; ++k) {
      const double t = times[k], burst = std::exp(-40.0 * (t - at) * (t - at));
      positions(k, i) = a * std::sin(t) + 0.4 * b * std::sin(2.3 * t) + c * burst * std::sin(25.0 * t);
    }
  }
  return JointTrajectory::through(times, positions);
}

// Still, then `way` in a smooth step of 0.2 s around t = 1, then still: 2 s in all.
JointTrajectory one_burst(double way) {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(2001, 0.0, 2.0);
  dmp::RowMatrix positions(2001, 1);
  for (Eigen::Index k = 0; k < 2001; ++k) {
    const double s = std::min(std::max((times[k] - 0.9) / 0.2, 0.0), 1.0);
    positions(k, 0) = way * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  }
  return JointTrajectory::through(times, positions);
}

// Two links of 0.5 m and 2 kg in the vertical plane.
std::string two_heavy_links() {
  const std::string mass =
      R"(<inertial><origin xyz="0.25 0 0"/><mass value="2"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial>)";
  const auto joint = [](const std::string& name, const std::string& parent, const std::string& child,
                        double x) {
    return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent + "\"/><child link=\"" +
           child + "\"/><origin xyz=\"" + std::to_string(x) +
           " 0 0\"/><axis xyz=\"0 1 0\"/><limit lower=\"-3\" upper=\"3\" velocity=\"9\" "
           "effort=\"99\"/></joint>";
  };
  return "<robot name=\"p\"><link name=\"a\"/><link name=\"b\">" + mass + "</link><link name=\"c\">" + mass +
         "</link>" + joint("one", "a", "b", 0.0) + joint("two", "b", "c", 0.5) + "</robot>";
}

double steepest(const dmp::Pace& pace, const Eigen::VectorXd& original) {
  double most = 0.0;
  for (Eigen::Index k = 1; k < original.size(); ++k)
    most = std::max(
        most, std::abs(std::log(pace.slowdown[k] / pace.slowdown[k - 1])) / (original[k] - original[k - 1]));
  return most;
}

}  // namespace

TEST_CASE("What is within the limits keeps its time to the last bit") {
  const JointTrajectory joints = random_motion(1, 3);
  const Eigen::Vector3d wide(1e3, 1e3, 1e3);
  const Paced same = dmp::paced(joints, limits_of(wide, 1e4 * wide));
  CHECK(same.joints.time == joints.time);
  CHECK(same.joints.velocity == joints.velocity);
  CHECK(same.pace.slowdown == Eigen::VectorXd::Ones(joints.time.size()));
  CHECK(same.pace.rate.isZero(0.0));
}

TEST_CASE("Limits, tempo rate and the person's time as a lower bound hold for random motions") {
  const Eigen::Vector4d speed(0.7, 1.1, 2.0, 0.9), acceleration(5.0, 9.0, 4.0, 3.0);
  for (int seed = 0; seed < 20; ++seed) {
    const JointTrajectory joints = random_motion(seed, 4);
    PacingLimits limits = limits_of(speed, acceleration);
    limits.tempo_rate = seed % 2 ? 1.0 : 5.0;
    const Paced found = dmp::paced(joints, limits);
    CAPTURE(seed);
    REQUIRE(dmp::duration_factor(found.joints, speed, acceleration) <= 1.0 + 1e-9);
    REQUIRE(found.joints.position == joints.position);
    REQUIRE(found.joints.time == found.pace.time);
    REQUIRE(found.pace.time[0] == joints.time[0]);
    REQUIRE(found.pace.slowdown.minCoeff() >= 1.0);
    REQUIRE(steepest(found.pace, joints.time) <= limits.tempo_rate * (1.0 + 1e-9));
    REQUIRE(found.pace.rate.cwiseAbs().maxCoeff() <= limits.tempo_rate * (1.0 + 1e-9));
    const double uniform = duration(joints.time) * dmp::duration_factor(joints, speed, acceleration);
    REQUIRE(duration(found.pace.time) <= uniform * (1.0 + 1e-9));
  }
}

TEST_CASE("The clock is the integral of the slowdown, and the rate its logarithmic derivative") {
  const JointTrajectory joints = random_motion(3, 2);
  const dmp::Pace pace =
      dmp::paced(joints, limits_of(Eigen::Vector2d(0.8, 0.9), Eigen::Vector2d(4.0, 6.0))).pace;
  for (Eigen::Index k = 1; k + 1 < joints.time.size(); ++k) {
    const double two_steps = joints.time[k + 1] - joints.time[k - 1];
    REQUIRE((pace.time[k + 1] - pace.time[k - 1]) / two_steps == Approx(pace.slowdown[k]).epsilon(2e-3));
    const double rate = std::log(pace.slowdown[k + 1] / pace.slowdown[k - 1]) / two_steps;
    REQUIRE(std::abs(rate - pace.rate[k]) < 0.05);
  }
}

TEST_CASE("A burst is slowed down where it is: far from it the person's tempo stays") {
  const JointTrajectory joints = one_burst(1.0);  // at most 1.875 / 0.2 = 9.375 rad/s
  const Paced found = dmp::paced(joints, limits_of(one(3.125), one(1e6)));
  CHECK(found.pace.slowdown.maxCoeff() == Approx(3.0).epsilon(0.02));
  CHECK(found.pace.slowdown[1000] == Approx(3.0).epsilon(0.02));
  // ln 3 / (ln 2 / 0.2 s) = 0.317 s on both sides of the burst.
  for (Eigen::Index k = 0; k < 500; ++k) REQUIRE(found.pace.slowdown[k] == 1.0);
  // Exactly where it is needed it would take 2.57 s; the smooth curve costs a little more.
  CHECK(duration(found.pace.time) > 2.55);
  CHECK(duration(found.pace.time) < 2.65);
  CHECK(dmp::paced(joints, limits_of(one(3.125), one(1e6))).pace.time == found.pace.time);
}

TEST_CASE("A motion whose speed is constant is slowed down evenly") {
  dmp::RowMatrix positions(200, 1);
  positions.col(0) = Eigen::VectorXd::LinSpaced(200, 0.0, 4.0);
  const JointTrajectory line = JointTrajectory::through(Eigen::VectorXd::LinSpaced(200, 0.0, 1.0), positions);
  const Paced found = dmp::paced(line, limits_of(one(2.0), one(infinity)));
  CHECK(duration(found.pace.time) == Approx(2.0).epsilon(1e-9));
}

TEST_CASE("Jerk, effort and the tool's speed are held where they are stated") {
  const dmp::Arm arm = dmp::Arm::from_urdf(arms::two_link());
  JointTrajectory joints = random_motion(5, 2);
  PacingLimits limits = limits_of(Eigen::Vector2d(50.0, 50.0), Eigen::Vector2d(500.0, 500.0));
  const double free = duration(joints.time);
  REQUIRE(duration(dmp::paced(arm, joints, limits).pace.time) == free);

  limits.tool_speed = 0.8;
  Paced found = dmp::paced(arm, joints, limits);
  const dmp::Poses poses = arm.forward_kinematics(found.joints.position);
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const double way = (poses[k].topRightCorner<3, 1>() - poses[k - 1].topRightCorner<3, 1>()).norm();
    const auto i = static_cast<Eigen::Index>(k);
    REQUIRE(way / (found.joints.time[i] - found.joints.time[i - 1]) <= 0.8 * (1.0 + 1e-9));
  }
  CHECK(duration(found.pace.time) > free);
  CHECK(dmp::largest_demand(arm, joints, limits).limit == dmp::PacedLimit::tool_speed);
  CHECK(dmp::largest_demand(arm, joints, limits).joint == -1);

  limits.tool_speed = infinity;
  limits.jerk = Eigen::Vector2d(300.0, 300.0);
  found = dmp::paced(arm, joints, limits);
  for (Eigen::Index k = 1; k < found.joints.time.size(); ++k) {
    const double step = found.joints.time[k] - found.joints.time[k - 1];
    const double change =
        (found.joints.acceleration.row(k) - found.joints.acceleration.row(k - 1)).cwiseAbs().maxCoeff();
    REQUIRE(change / step <= 300.0 * (1.0 + 1e-6));
  }
  CHECK(duration(found.pace.time) > free);
  CHECK(dmp::largest_demand(arm, joints, limits).limit == dmp::PacedLimit::jerk);
}

TEST_CASE("Effort is held at the samples, and named with its joint") {
  const dmp::Arm arm = dmp::Arm::from_urdf(two_heavy_links());
  const JointTrajectory joints = random_motion(6, 2);
  PacingLimits limits = limits_of(Eigen::Vector2d(50.0, 50.0), Eigen::Vector2d(500.0, 500.0));
  const Eigen::VectorXd still =
      arm.gravity_effort(joints.position).cwiseAbs().colwise().maxCoeff().transpose();
  limits.effort = (1.5 * still.array() + 1.0).matrix();
  const Paced found = dmp::paced(arm, joints, limits);
  for (Eigen::Index k = 0; k < found.joints.time.size(); ++k) {
    const Eigen::VectorXd effort = arm.inverse_dynamics(
        found.joints.position.row(k), found.joints.velocity.row(k), found.joints.acceleration.row(k));
    REQUIRE((effort.cwiseAbs().array() <= limits.effort->array() * (1.0 + 1e-6)).all());
  }
  CHECK(duration(found.pace.time) > duration(joints.time));
  const dmp::Demand most = dmp::largest_demand(arm, joints, limits);
  CHECK(most.limit == dmp::PacedLimit::effort);
  CHECK(most.factor == Approx(dmp::duration_factor(arm, joints, limits.velocity, limits.acceleration,
                                                   *limits.effort, arm.gravity())));
  limits.effort = Eigen::Vector2d(0.01, 0.01);
  CHECK_THROWS_AS(dmp::paced(arm, joints, limits), dmp::InvalidArgument);
}

TEST_CASE("What asks most is named: joint, limit and time") {
  dmp::RowMatrix positions(101, 2);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(101, 0.0, 1.0);
  positions.col(0) = 0.1 * times;
  positions.col(1) = times.array().pow(3);  // 3 rad/s and 6 rad/s^2 at the end
  const JointTrajectory joints = JointTrajectory::through(times, positions);
  const dmp::Demand by_speed =
      dmp::largest_demand(joints, limits_of(Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(20.0, 20.0)));
  CHECK(by_speed.factor == Approx(3.0));
  CHECK(by_speed.limit == dmp::PacedLimit::velocity);
  CHECK(by_speed.joint == 1);
  CHECK(by_speed.time == 1.0);
  const dmp::Demand by_acceleration =
      dmp::largest_demand(joints, limits_of(Eigen::Vector2d(9.0, 9.0), Eigen::Vector2d(2.0, 1.5)));
  CHECK(by_acceleration.factor == Approx(2.0));
  CHECK(by_acceleration.limit == dmp::PacedLimit::acceleration);
  const dmp::RowMatrix still = dmp::RowMatrix::Ones(3, 1);
  const JointTrajectory rest = JointTrajectory::through(Eigen::Vector3d(0.0, 1.0, 2.0), still);
  CHECK(dmp::largest_demand(rest, limits_of(one(1.0), one(1.0))).joint == -1);
}

TEST_CASE("Poses on another clock move with the tempo") {
  dmp::PoseTrajectory motion;
  motion.time = Eigen::Vector2d(0.0, 1.0);
  motion.pose = {Eigen::Matrix4d::Identity(), Eigen::Matrix4d::Identity()};
  motion.twist = dmp::RowMatrix::Constant(2, 6, 3.0);
  motion.acceleration = dmp::RowMatrix::Constant(2, 6, 8.0);
  const dmp::Pace pace{Eigen::Vector2d(0.0, 2.0), Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(0.0, 0.5)};
  const dmp::PoseTrajectory slow = dmp::retimed(motion, pace);
  CHECK(slow.time == pace.time);
  CHECK(slow.twist(0, 0) == 3.0);
  CHECK(slow.twist(1, 5) == 1.5);
  CHECK(slow.acceleration(0, 0) == 8.0);
  CHECK(slow.acceleration(1, 5) == Approx((8.0 - 1.5) / 4.0));
  CHECK_THROWS_AS(dmp::retimed(motion, dmp::Pace{}), dmp::InvalidArgument);
}

TEST_CASE("Limits that are none are refused by name") {
  const JointTrajectory joints = random_motion(1, 2);
  PacingLimits limits = limits_of(Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(1.0, 1.0));
  limits.velocity = one(1.0);
  CHECK_THROWS_WITH_AS(dmp::paced(joints, limits), doctest::Contains("velocity: 1 values, expected 2"),
                       dmp::InvalidArgument);
  limits.velocity = Eigen::Vector2d(1.0, -1.0);
  CHECK_THROWS_WITH_AS(dmp::paced(joints, limits), doctest::Contains("velocity[1]"), dmp::InvalidArgument);
  limits.velocity = Eigen::Vector2d(1.0, 1.0);
  limits.effort = Eigen::Vector2d(1.0, 1.0);
  CHECK_THROWS_WITH_AS(dmp::paced(joints, limits), doctest::Contains("effort: needs an arm"),
                       dmp::InvalidArgument);
  limits.effort.reset();
  limits.tool_speed = 1.0;
  CHECK_THROWS_WITH_AS(dmp::paced(joints, limits), doctest::Contains("tool_speed: needs an arm"),
                       dmp::InvalidArgument);
  limits.tool_speed = 0.0;
  CHECK_THROWS_AS(dmp::paced(joints, limits), dmp::InvalidArgument);
  limits.tool_speed = infinity;
  limits.tempo_rate = 0.0;
  CHECK_THROWS_WITH_AS(dmp::paced(joints, limits), doctest::Contains("tempo_rate"), dmp::InvalidArgument);
}
