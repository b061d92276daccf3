#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/inverse_kinematics.hpp>
#include <dmp/path_tracking.hpp>

#include <cmath>

#include "arms.hpp"

using dmp::Arm;
using dmp::FollowOptions;
using dmp::IkOptions;
using dmp::IkStatus;
using dmp::InverseKinematics;
using dmp::JointTrajectory;
using dmp::Poses;
using dmp::RowMatrix;

namespace {

Arm seven_joints() { return Arm::from_urdf(arms::seven_joints()); }
Arm two_link() { return Arm::from_urdf(arms::two_link()); }

Eigen::VectorXd seconds(Eigen::Index count, double duration) {
  return Eigen::VectorXd::LinSpaced(count, 0.0, duration);
}

// The tip's path while the joints swing smoothly between two random postures: joints exist for every pose of
// it.
Poses feasible_path(const Arm& arm, std::mt19937& random, Eigen::Index count) {
  const Eigen::VectorXd a = arms::random_joints(arm, random), b = arms::random_joints(arm, random);
  RowMatrix q(count, a.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const double s =
        0.5 - 0.5 * std::cos(3.14159265 * static_cast<double>(k) / static_cast<double>(count - 1));
    q.row(k) = (0.95 * (a + s * 0.5 * (b - a)) + 0.05 * 0.5 * (arm.lower() + arm.upper())).transpose();
  }
  return arm.forward_kinematics(q);
}

// The joints themselves, smoothly through four random postures, each 80 % of the way to a random one further.
RowMatrix far_swing(const Arm& arm, std::mt19937& random, Eigen::Index count) {
  const Eigen::VectorXd middle = 0.5 * (arm.lower() + arm.upper());
  RowMatrix through(4, arm.joint_count());
  for (Eigen::Index w = 0; w < 4; ++w) {
    const Eigen::VectorXd q = middle + 0.85 * (arms::random_joints(arm, random) - middle);
    through.row(w) = q.transpose();
    if (w > 0) through.row(w) = 0.2 * through.row(w - 1) + 0.8 * q.transpose();
  }
  RowMatrix joints(count, arm.joint_count());
  for (Eigen::Index k = 0; k < count; ++k) {
    const double at = 3.0 * static_cast<double>(k) / static_cast<double>(count - 1);
    const Eigen::Index w = std::min<Eigen::Index>(static_cast<Eigen::Index>(at), 2);
    const double s = at - static_cast<double>(w), rise = s * s * (3.0 - 2.0 * s);
    joints.row(k) = through.row(w) + rise * (through.row(w + 1) - through.row(w));
  }
  return joints;
}

double largest_error(const Arm& arm, const JointTrajectory& joints, const Poses& poses) {
  const Poses tips = arm.forward_kinematics(joints.position);
  double worst = 0.0;
  for (std::size_t k = 0; k < poses.size(); ++k)
    worst = std::max(worst, (tips[k] - poses[k]).cwiseAbs().maxCoeff());
  return worst;
}

bool within_limits(const Arm& arm, const JointTrajectory& joints) {
  for (Eigen::Index k = 0; k < joints.position.rows(); ++k)
    if (!arms::within_limits(arm, joints.position.row(k).transpose())) return false;
  return true;
}

double largest_step(const RowMatrix& q) {
  return (q.bottomRows(q.rows() - 1) - q.topRows(q.rows() - 1)).cwiseAbs().maxCoeff();
}

// The two-link arm's tip on a circle around its base, from angle `from` to `to`.
Poses arc(double radius, double from, double to, Eigen::Index count) {
  const Arm arm = two_link();
  const double elbow = std::acos(radius * radius / 2.0 - 1.0);
  RowMatrix q(count, 2);
  for (Eigen::Index k = 0; k < count; ++k)
    q.row(k) << from + (to - from) * static_cast<double>(k) / static_cast<double>(count - 1) - 0.5 * elbow,
        elbow;
  return arm.forward_kinematics(q);
}

}  // namespace

TEST_CASE("Paths that joints can follow are followed whole, to the last digits, within limits and steps") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm);
  std::mt19937 random(1);
  for (int i = 0; i < 10; ++i) {
    const Poses poses = feasible_path(arm, random, 300);
    const JointTrajectory joints = ik.follow(seconds(300, 3.0), poses);
    CAPTURE(i);
    CAPTURE(joints.report.summary());
    REQUIRE(joints.report.complete());
    REQUIRE(joints.report.missed.empty());
    REQUIRE(largest_error(arm, joints, poses) < 1e-9);
    REQUIRE(within_limits(arm, joints));
    REQUIRE(joints.report.max_step == doctest::Approx(largest_step(joints.position)));
    REQUIRE(joints.report.max_step <= 0.2);
  }
}

TEST_CASE("The answer is the same to the last bit every time") {
  const Arm arm = seven_joints();
  std::mt19937 random(2);
  const Poses poses = feasible_path(arm, random, 100);
  InverseKinematics ik(arm);
  const RowMatrix first = ik.follow(seconds(100, 1.0), poses).position;
  CHECK(ik.follow(seconds(100, 1.0), poses).position == first);
  CHECK(InverseKinematics(arm).follow(seconds(100, 1.0), poses).position == first);
}

TEST_CASE("A given start is where the path begins") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm);
  std::mt19937 random(3);
  const Eigen::VectorXd q = 0.5 * arms::random_joints(arm, random) + 0.25 * (arm.lower() + arm.upper());
  RowMatrix way(50, 7);
  for (Eigen::Index k = 0; k < 50; ++k)
    way.row(k) = (q.array() + 0.004 * static_cast<double>(k)).matrix().transpose();
  FollowOptions options;
  options.start = q;
  const JointTrajectory joints = ik.follow(seconds(50, 1.0), arm.forward_kinematics(way), options);
  CHECK(joints.report.complete());
  CHECK((joints.position.row(0).transpose() - q).norm() < 1e-9);
}

TEST_CASE("Which elbow can finish is found out before the path begins") {
  // With the elbow at +1.86 rad the shoulder goes from -1.83 to 1.57 rad, with the elbow at -1.86 rad it
  // would have to go from 0.03 to 3.43 rad, beyond its limit of 2 rad: only the first can finish, both can
  // begin.
  const Poses poses = arc(1.2, -0.9, 2.5, 200);
  const JointTrajectory joints = InverseKinematics(two_link()).follow(seconds(200, 2.0), poses);
  CAPTURE(joints.report.summary());
  CHECK(joints.report.complete());
  CHECK(joints.position(0, 1) == doctest::Approx(std::acos(1.2 * 1.2 / 2.0 - 1.0)));
}

TEST_CASE("Where the path leaves the reach the closest joints stand in, and the report says where and why") {
  const Arm arm = two_link();
  RowMatrix q(101, 2);
  for (Eigen::Index k = 0; k <= 100; ++k) q.row(k) << -0.6 + 0.01 * static_cast<double>(k), 0.4;
  Poses poses = arm.forward_kinematics(q);
  for (std::size_t k = 40; k < 60; ++k) poses[k].topRightCorner<3, 1>() *= 1.1;
  FollowOptions options;
  options.max_step = 0.6;
  const JointTrajectory joints = InverseKinematics(arm).follow(seconds(101, 1.0), poses, options);
  const dmp::PathReport& report = joints.report;
  CHECK(report.solved == 81);
  REQUIRE(report.missed.size() == 1);
  CHECK(report.missed[0] == std::make_pair(Eigen::Index{40}, Eigen::Index{59}));
  CHECK(report.status[50] == IkStatus::out_of_reach);
  CHECK(report.position_error[50] ==
        doctest::Approx(0.1 * poses[40].topRightCorner<3, 1>().norm() / 1.1).epsilon(0.2));
  CHECK(report.summary().find("40-59 (out_of_reach)") != std::string::npos);
}

TEST_CASE("Limits that stop a path are named as the reason") {
  const Arm arm = two_link();
  RowMatrix q(101, 2);
  for (Eigen::Index k = 0; k <= 100; ++k)
    q.row(k) << 1.5 + 0.01 * static_cast<double>(k), 0.0;  // beyond 2 rad
  const JointTrajectory joints = InverseKinematics(arm).follow(seconds(101, 1.0), arm.forward_kinematics(q));
  CHECK(joints.report.status[100] == IkStatus::limit_blocked);
  CHECK(joints.position.col(0).maxCoeff() <= 2.0);
  CHECK(joints.report.solved >= 50);
}

TEST_CASE("Steps never exceed their bound, and a path that asks for more says so") {
  const Arm arm = two_link();
  RowMatrix q(40, 2);
  for (Eigen::Index k = 0; k < 40; ++k)
    q.row(k) << (k < 20 ? -0.5 : 0.5), 0.8;  // a leap of 1 rad in the middle
  FollowOptions options;
  options.max_step = 0.1;
  const JointTrajectory joints =
      InverseKinematics(arm).follow(seconds(40, 1.0), arm.forward_kinematics(q), options);
  CHECK(largest_step(joints.position) <= 0.1 + 1e-12);
  CHECK_FALSE(joints.report.complete());
  CHECK(joints.report.status[static_cast<std::size_t>(joints.report.missed[0].first)] ==
        IkStatus::step_limited);
}

TEST_CASE("On the way through a singularity joints go on as they came, they do not bounce off") {
  RowMatrix q(200, 2);  // the elbow stretches and bends to the other side
  for (Eigen::Index k = 0; k < 200; ++k) {
    const double s = static_cast<double>(k) / 199.0;
    q.row(k) << 0.3 + 0.9 * s, 0.8 * std::cos(3.14159265 * s);
  }
  IkOptions place;
  place.weight << 1, 1, 1, 0, 0, 0;
  FollowOptions from;
  from.start = q.row(0).transpose();
  InverseKinematics ik(two_link(), place);
  const Poses poses = two_link().forward_kinematics(q);
  const JointTrajectory joints = ik.follow(seconds(200, 4.0), poses, from);
  CHECK(joints.report.complete());
  CHECK((joints.position - q).cwiseAbs().maxCoeff() < 1e-4);  // the elbow is lost to first order, stretched
  const double gentle = JointTrajectory::through(joints.time, q).acceleration.cwiseAbs().maxCoeff();
  CHECK(ik.follow(joints.time, poses).acceleration.cwiseAbs().maxCoeff() < 2.0 * gentle);
}

// Seven joints come from anywhere to anywhere in the end: a search that forgot the steps would go on for
// long.
TEST_CASE("A sparse path with poses further apart than the steps allow is given up, and says why") {
  const Arm arm = seven_joints();
  std::mt19937 random(13);
  const Poses poses = arm.forward_kinematics(far_swing(arm, random, 61));
  InverseKinematics ik(arm);
  FollowOptions options;
  options.max_step = 0.4;
  CHECK(ik.follow(seconds(61, 8.0), poses, options).report.complete());
  options.max_step = 0.02;
  const JointTrajectory joints = ik.follow(seconds(61, 8.0), poses, options);
  CHECK(largest_step(joints.position) <= 0.02 + 1e-12);
  REQUIRE_FALSE(joints.report.complete());
  for (const IkStatus status : joints.report.status)
    CHECK((status == IkStatus::ok || status == IkStatus::step_limited));
}

TEST_CASE("The timing plays no part unless respect_velocity asks for it") {
  const Arm arm = two_link();
  RowMatrix q(50, 2);
  for (Eigen::Index k = 0; k < 50; ++k) q.row(k) << 0.02 * static_cast<double>(k), 0.7;
  const Poses poses = arm.forward_kinematics(q);
  const Eigen::VectorXd hasty = seconds(50, 0.1);  // 10 rad/s; the limit is 3
  FollowOptions options;
  const JointTrajectory free = InverseKinematics(arm).follow(hasty, poses, options);
  CHECK(free.report.complete());
  CHECK(free.report.velocity_ratio == doctest::Approx(9.8 / 3.0));
  options.respect_velocity = true;
  const JointTrajectory held = InverseKinematics(arm).follow(hasty, poses, options);
  CHECK(held.report.velocity_ratio <= 1.0 + 1e-9);
  CHECK_FALSE(held.report.complete());
}

TEST_CASE("Joints along a smooth path are smooth: the spline's accelerations carry no noise of the solver") {
  const Arm arm = seven_joints();
  const Eigen::Index count = 2001;
  RowMatrix q(count, 7);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(count - 1);
    q.row(k) = (0.25 * (arm.lower() + arm.upper()).array() + 0.3 * s * s * (3.0 - 2.0 * s)).transpose();
  }
  const JointTrajectory joints =
      InverseKinematics(arm).follow(seconds(count, 2.0), arm.forward_kinematics(q));
  REQUIRE(joints.report.complete());
  const RowMatrix& a = joints.acceleration;
  CHECK((a.middleRows(1, count - 3) - a.middleRows(2, count - 3)).cwiseAbs().maxCoeff() < 0.05);
}

TEST_CASE("One pose is a path") {
  const Arm arm = seven_joints();
  const Eigen::VectorXd q = 0.5 * (arm.lower() + arm.upper());
  const JointTrajectory joints = InverseKinematics(arm).follow(seconds(1, 0.0), {arm.forward_kinematics(q)});
  CHECK(joints.report.complete());
  CHECK(joints.velocity.isZero());
}

TEST_CASE("Paths and options that are none are refused by name") {
  InverseKinematics ik(two_link());
  Poses poses(3, Eigen::Matrix4d::Identity());
  CHECK_THROWS_WITH_AS(ik.follow(seconds(0, 1.0), {}), doctest::Contains("poses"), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(ik.follow(seconds(2, 1.0), poses), doctest::Contains("times"), dmp::InvalidArgument);
  CHECK_THROWS_WITH_AS(ik.follow(Eigen::Vector3d(0, 1, 1), poses), doctest::Contains("times[2]"),
                       dmp::InvalidArgument);
  poses[1](2, 2) = -1.0;
  CHECK_THROWS_WITH_AS(ik.follow(seconds(3, 1.0), poses), doctest::Contains("poses[1]: det(R) = -1"),
                       dmp::InvalidArgument);
  poses[1](2, 2) = std::nan("");
  CHECK_THROWS_WITH_AS(ik.follow(seconds(3, 1.0), poses), doctest::Contains("poses[1]"),
                       dmp::InvalidArgument);
  poses[1] = poses[0];
  FollowOptions options;
  options.starts = 0;
  CHECK_THROWS_WITH_AS(ik.follow(seconds(3, 1.0), poses, options), doctest::Contains("starts"),
                       dmp::InvalidArgument);
  options = {};
  options.start = Eigen::Vector2d(9.0, 0.0);
  CHECK_THROWS_WITH_AS(ik.follow(seconds(3, 1.0), poses, options), doctest::Contains("start[0]"),
                       dmp::InvalidArgument);
}

TEST_CASE("Where tracking finds no way, the thorough search moves the null space in time") {
  const Arm wide = seven_joints();
  const Arm arm = wide.with_limits({0.6 * wide.lower(), 0.6 * wide.upper(), {}, {}});
  InverseKinematics ik(arm);
  std::mt19937 random(11);
  FollowOptions quick;
  quick.thorough = false;
  int complete = 0, complete_at_once = 0;
  for (int i = 0; i < 12; ++i) {
    const Poses poses = arm.forward_kinematics(far_swing(arm, random, 400));
    const JointTrajectory joints = ik.follow(seconds(400, 8.0), poses);
    complete += joints.report.complete() ? 1 : 0;
    complete_at_once += ik.follow(seconds(400, 8.0), poses, quick).report.complete() ? 1 : 0;
    CAPTURE(joints.report.summary());
    CHECK(within_limits(arm, joints));
    CHECK(largest_step(joints.position) <= 0.2 + 1e-12);
  }
  CHECK(complete == 12);
  CHECK(complete_at_once < 12);
}

TEST_CASE("The thorough search keeps a given start") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm);
  std::mt19937 random(12);
  for (int i = 0; i < 5; ++i) {
    const RowMatrix q = far_swing(arm, random, 400);
    FollowOptions options;
    options.start = q.row(0).transpose();
    const JointTrajectory joints = ik.follow(seconds(400, 8.0), arm.forward_kinematics(q), options);
    CHECK((joints.position.row(0) - q.row(0)).norm() < 1e-9);
  }
}

TEST_CASE("Where a given start finds no way, the thorough search looks for one from it, and keeps it") {
  const Arm wide = seven_joints();
  const Arm arm = wide.with_limits({0.6 * wide.lower(), 0.6 * wide.upper(), {}, {}});
  InverseKinematics ik(arm);
  std::mt19937 random(11);
  FollowOptions thorough, quick;
  quick.thorough = false;
  int complete = 0, complete_at_once = 0;
  for (int i = 0; i < 12; ++i) {
    const RowMatrix q = far_swing(arm, random, 400);
    thorough.start = quick.start = q.row(0).transpose();
    const Poses poses = arm.forward_kinematics(q);
    const JointTrajectory joints = ik.follow(seconds(400, 8.0), poses, thorough);
    CHECK((joints.position.row(0) - q.row(0)).norm() < 1e-9);
    CHECK(within_limits(arm, joints));
    complete += joints.report.complete() ? 1 : 0;
    complete_at_once += ik.follow(seconds(400, 8.0), poses, quick).report.complete() ? 1 : 0;
  }
  CHECK(complete >= complete_at_once);
  MESSAGE(complete << " of 12 complete, " << complete_at_once << " without the search");
}

TEST_CASE(
    "A start far from the first pose is brought to it as near as the steps allow, and no roadmap is made") {
  const Arm arm = two_link();
  const Eigen::VectorXd away = Eigen::Vector2d(1.5, 1.5);
  FollowOptions options;
  options.start = away;
  const Poses poses(5, arm.forward_kinematics(Eigen::VectorXd(Eigen::Vector2d(-1.5, 0.5))));
  const JointTrajectory joints = InverseKinematics(arm).follow(seconds(5, 1.0), poses, options);
  CHECK_FALSE(joints.report.complete());
  CHECK((joints.position.row(0).transpose() - away).cwiseAbs().maxCoeff() <= options.max_step + 1e-12);
}
