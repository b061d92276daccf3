#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/joint_tracker.hpp>

#include <Eigen/Geometry>
#include <cmath>

#include "allocations.hpp"
#include "arms.hpp"

using dmp::Arm;
using dmp::IkStatus;
using dmp::JointTracker;

namespace {

constexpr double dt = 0.01;  // s

Arm seven_joints() { return Arm::from_urdf(arms::seven_joints()); }
Eigen::VectorXd home() { return (Eigen::VectorXd(7) << 0.3, 0.5, -0.4, -1.4, 0.3, 1.2, 0.2).finished(); }

// The tip at `from` on a circle of 0.1 m, swinging by 0.4 rad, in 1000 poses.
dmp::Poses circle(const Arm& arm, const Eigen::VectorXd& from) {
  const Eigen::Matrix4d first = arm.forward_kinematics(from);
  dmp::Poses poses(1000, first);
  for (int k = 0; k < 1000; ++k) {
    const double angle = 2.0 * 3.14159265358979 * k / 999.0;
    auto& pose = poses[static_cast<std::size_t>(k)];
    pose.topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(0.4 * std::sin(angle), Eigen::Vector3d::UnitX()) * first.topLeftCorner<3, 3>();
    pose.topRightCorner<3, 1>() += 0.1 * Eigen::Vector3d(std::cos(angle) - 1.0, std::sin(angle), 0.0);
  }
  return poses;
}

bool holds_limits(const Arm& arm, const Eigen::VectorXd& before, const Eigen::VectorXd& now) {
  const Eigen::VectorXd step = (now - before).cwiseAbs();
  return arms::within_limits(arm, now) && (arm.velocity_limit() * dt - step).minCoeff() >= -1e-15;
}

}  // namespace

TEST_CASE("A smooth path is met at every pose to 1e-6 m within the limits of position and speed") {
  const Arm arm = seven_joints();
  JointTracker tracker(arm, home());
  for (const Eigen::Matrix4d& pose : circle(arm, home())) {
    const Eigen::VectorXd before = tracker.joints();
    REQUIRE(tracker.track(pose, dt) == IkStatus::ok);
    REQUIRE(holds_limits(arm, before, tracker.joints()));
    REQUIRE((arm.forward_kinematics(tracker.joints()) - pose).topRightCorner<3, 1>().norm() < 1e-6);
    REQUIRE(tracker.position_error() < 1e-6);
    REQUIRE(tracker.angle_error() < 1e-6);
    REQUIRE((tracker.velocity() * dt - (tracker.joints() - before)).norm() < 1e-12);
  }
}

TEST_CASE("Through a singularity the joints go on as they came, they do not bounce off") {
  const Arm arm = Arm::from_urdf(arms::two_link());
  const auto posture = [](double s) {  // the elbow stretches and bends to the other side
    return Eigen::VectorXd(Eigen::Vector2d(0.3 + 0.9 * s, 0.8 * std::cos(3.14159265 * s)));
  };
  dmp::TrackOptions place;
  place.weight << 1, 1, 1, 0, 0, 0;
  JointTracker tracker(arm, posture(0.0), place);
  for (int k = 1; k <= 200; ++k) {
    const Eigen::VectorXd q = posture(k / 200.0);
    REQUIRE(tracker.track(arm.forward_kinematics(q), dt) == IkStatus::ok);
    REQUIRE((tracker.joints() - q).cwiseAbs().maxCoeff() < 1e-4);  // lost to first order where stretched
  }
}

TEST_CASE("The loop takes no memory, whether poses are met or not" * doctest::skip(!COUNTS_MALLOC)) {
  const Arm arm = seven_joints();
  JointTracker tracker(arm, home());
  dmp::Poses poses = circle(arm, home());
  for (std::size_t k = 500; k < 600; ++k) poses[k](0, 3) += 2.0;  // out of reach
  poses[700].topLeftCorner<3, 3>() *= 1.0 + 1e-5;                 // made rigid again
  poses[800](1, 3) = std::nan("");                                // refused
  const Eigen::VectorXd start = home();
  double sum = 0.0;
  CHECK(allocations_in([&] {
          for (const Eigen::Matrix4d& pose : poses) {
            tracker.track(pose, dt);
            sum += tracker.joints()[0] + tracker.velocity()[1] + tracker.position_error() +
                   tracker.angle_error();
          }
          tracker.set_joints(start);
        }) == 0);
  CHECK(std::isfinite(sum));
}

TEST_CASE("The same calls give the same joints to the last bit, from a copy too") {
  const Arm arm = seven_joints();
  JointTracker one(arm, home()), other(arm, home());
  const dmp::Poses poses = circle(arm, home());
  for (std::size_t k = 0; k < 400; ++k) one.track(poses[k], dt), other.track(poses[k], dt);
  JointTracker copy = one;
  for (std::size_t k = 400; k < 1000; ++k)
    one.track(poses[k], dt), copy.track(poses[k], dt), other.track(poses[k], dt);
  CHECK(one.joints() == other.joints());
  CHECK(one.joints() == copy.joints());
}

TEST_CASE("A pose too far for the time is approached as fast as the joints may go, until it is met") {
  const Arm arm = seven_joints();
  JointTracker tracker(arm, home());
  const Eigen::VectorXd goal = home().array() + 0.2;
  const Eigen::Matrix4d pose = arm.forward_kinematics(goal);
  CHECK(tracker.track(pose, dt) == IkStatus::step_limited);
  CHECK(tracker.velocity().cwiseQuotient(arm.velocity_limit()).cwiseAbs().maxCoeff() ==
        doctest::Approx(1.0).epsilon(1e-9));
  IkStatus last = IkStatus::step_limited;
  for (int k = 0; k < 200 && last != IkStatus::ok; ++k) {
    const Eigen::VectorXd before = tracker.joints();
    last = tracker.track(pose, dt);
    REQUIRE(holds_limits(arm, before, tracker.joints()));
  }
  CHECK(last == IkStatus::ok);
}

TEST_CASE("Beyond reach the arm comes to rest as close as it can, and says why") {
  const Arm arm = Arm::from_urdf(arms::two_link());
  JointTracker tracker(arm, Eigen::Vector2d(0.3, 0.8));
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.topRightCorner<3, 1>() = 3.0 * Eigen::Vector3d(std::cos(0.5), std::sin(0.5), 0.0);
  IkStatus status = IkStatus::ok;
  for (int k = 0; k < 500; ++k) status = tracker.track(pose, dt);
  CHECK((status == IkStatus::out_of_reach || status == IkStatus::singular));
  CHECK(tracker.position_error() == doctest::Approx(1.0).epsilon(1e-4));
}

TEST_CASE("A joint that stands at its limit blocks, and does not pass it") {
  const Arm arm = Arm::from_urdf(arms::two_link())
                      .with_limits({Eigen::Vector2d(-2.0, -2.0), Eigen::Vector2d(0.2, 2.0), {}, {}});
  JointTracker tracker(arm, Eigen::Vector2d(0.1, 0.7));
  const Arm free = Arm::from_urdf(arms::two_link());
  const Eigen::Matrix4d pose = free.forward_kinematics(Eigen::VectorXd(Eigen::Vector2d(0.5, 0.7)));
  IkStatus status = IkStatus::ok;
  for (int k = 0; k < 100; ++k) {
    status = tracker.track(pose, dt);
    REQUIRE(tracker.joints()[0] <= 0.2);
  }
  CHECK(status == IkStatus::limit_blocked);
}

TEST_CASE("A free tool axis spends no joint motion on the spin about it") {
  const Arm arm = seven_joints();
  dmp::TrackOptions options;
  options.weight << 1, 1, 1, 1, 1, 0;
  JointTracker tracker(arm, home(), options);
  Eigen::Matrix4d pose = arm.forward_kinematics(home());
  pose.topLeftCorner<3, 3>() *= Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  CHECK(tracker.track(pose, dt) == IkStatus::ok);
  CHECK((tracker.joints() - home()).norm() < 1e-9);
}

TEST_CASE("What is no pose, time or posture is refused and changes nothing") {
  const Arm arm = seven_joints();
  JointTracker tracker(arm, home());
  Eigen::Matrix4d pose = arm.forward_kinematics(home());
  CHECK(tracker.track(pose, 0.0) == IkStatus::invalid_input);
  CHECK(tracker.track(pose, std::nan("")) == IkStatus::invalid_input);
  CHECK(tracker.set_joints(Eigen::VectorXd::Constant(7, 9.0)) == IkStatus::invalid_input);
  CHECK(tracker.set_joints(Eigen::VectorXd::Zero(6)) == IkStatus::invalid_input);
  pose(2, 2) = std::nan("");
  CHECK(tracker.track(pose, dt) == IkStatus::invalid_input);
  CHECK(tracker.joints() == home());
  CHECK_THROWS_WITH_AS(JointTracker(arm, Eigen::VectorXd::Zero(3)), doctest::Contains("start"),
                       dmp::InvalidArgument);
  dmp::TrackOptions options;
  options.limit_pull = -1.0;
  CHECK_THROWS_WITH_AS(JointTracker(arm, home(), options), doctest::Contains("limit_pull"),
                       dmp::InvalidArgument);
}
