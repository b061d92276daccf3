#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/ik_branches.hpp>
#include <dmp/inverse_kinematics.hpp>
#include <dmp/joint_tracker.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <thread>

#include "arms.hpp"

using arms::within_limits;
using dmp::Arm;
using dmp::IkResult;
using dmp::IkStatus;
using dmp::InverseKinematics;

namespace {

Arm two_link() { return Arm::from_urdf(arms::two_link()); }
Arm seven_joints() { return Arm::from_urdf(arms::seven_joints()); }

struct Errors {
  double position, angle;
};

// Measured with the arm's forward kinematics (KDL), independently of what a result says of itself.
Errors errors(const Arm& arm, const Eigen::VectorXd& q, const Eigen::Matrix4d& pose) {
  const Eigen::Matrix4d tip = arm.forward_kinematics(q);
  const Eigen::Matrix3d between = pose.topLeftCorner<3, 3>() * tip.topLeftCorner<3, 3>().transpose();
  const Eigen::Quaterniond turn(between);
  return {(pose - tip).topRightCorner<3, 1>().norm(),
          2.0 * std::atan2(turn.vec().norm(), std::abs(turn.w()))};
}

}  // namespace

TEST_CASE("Every reachable pose of a seven-joint arm is met within the limits from any seed") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm);
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
    const IkResult found = ik.solve(pose, arms::random_joints(arm, random));
    CAPTURE(k);
    REQUIRE(found.ok());
    REQUIRE(within_limits(arm, found.joints));
    const Errors error = errors(arm, found.joints, pose);
    REQUIRE(error.position <= 1e-6);
    REQUIRE(error.angle <= 1.1e-6);
    REQUIRE(found.position_error == doctest::Approx(error.position));
  }
}

TEST_CASE("The two-link arm finds the elbow of the closed form, on the side of the seed") {
  const Arm arm = two_link();
  InverseKinematics ik(arm);
  const Eigen::Vector2d q(0.3, 1.2);
  const Eigen::Matrix4d pose = arm.forward_kinematics(Eigen::VectorXd(q));
  CHECK((ik.solve(pose, Eigen::Vector2d(0.0, 0.5)).joints - q).norm() < 1e-5);
}

TEST_CASE("Joints that already meet the pose are returned as they are") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm);
  std::mt19937 random(2);
  const Eigen::VectorXd q = arms::random_joints(arm, random);
  const IkResult found = ik.solve(arm.forward_kinematics(q), q);
  CHECK(found.joints == q);
  CHECK(found.iterations <= 1);
}

TEST_CASE("The same question gets the same answer to the last bit, whatever was asked before") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm), other(arm);
  std::mt19937 random(3);
  const Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
  const Eigen::VectorXd first = ik.solve(pose).joints;
  other.solve(arm.forward_kinematics(arms::random_joints(arm, random)));
  CHECK(other.solve(pose).joints == first);
  InverseKinematics copy = other;
  CHECK(copy.solve(pose).joints == first);
}

TEST_CASE("A pose beyond the arm's length is out of reach, and the arm points at it") {
  const Arm arm = two_link();
  InverseKinematics ik(arm);
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.topRightCorner<3, 1>() = 3.0 * Eigen::Vector3d(std::cos(0.5), std::sin(0.5), 0.0);
  const IkResult found = ik.solve(pose);
  CHECK(found.status == IkStatus::out_of_reach);
  CHECK(found.position_error == doctest::Approx(1.0).epsilon(1e-6));
  CHECK((found.joints - Eigen::Vector2d(0.5, 0.0)).norm() < 1e-3);
}

TEST_CASE("A pose that only the limits forbid is limit_blocked, and the joints that block it are named") {
  const Arm blocked =
      two_link().with_limits({Eigen::Vector2d(-2.0, -2.0), Eigen::Vector2d(0.2, 2.0), {}, {}});
  InverseKinematics ik(blocked);
  // Reached by (0.5, 0.0) only: stretched, and turned further than joint 0 may go.
  const IkResult found = ik.solve(two_link().forward_kinematics(Eigen::VectorXd(Eigen::Vector2d(0.5, 0.0))));
  CHECK(found.status == IkStatus::limit_blocked);
  CHECK(found.blocked == std::vector<Eigen::Index>{0});
  CHECK(found.joints[0] == 0.2);
  CHECK(found.limit_margin == 0.0);
}

TEST_CASE("A step that is too short is step_limited and stays within the step") {
  const Arm arm = seven_joints();
  dmp::IkOptions options;
  options.max_step = 0.05;
  InverseKinematics ik(arm, options);
  const Eigen::VectorXd seed = ik.middle();
  const IkResult near = ik.solve(arm.forward_kinematics(Eigen::VectorXd(seed.array() + 0.01)), seed);
  CHECK(near.ok());
  const IkResult far = ik.solve(arm.forward_kinematics(Eigen::VectorXd(seed.array() + 0.4)), seed);
  CHECK(far.status == IkStatus::step_limited);
  CHECK((far.joints - seed).cwiseAbs().maxCoeff() <= 0.05 + 1e-15);
}

TEST_CASE("Too small a budget says so") {
  dmp::IkOptions options;
  options.iteration_limit = 2;
  InverseKinematics ik(seven_joints(), options);
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(7, -0.9);
  const IkResult found = ik.solve(ik.arm().forward_kinematics(q));
  CHECK(found.status == IkStatus::budget);
  CHECK(found.iterations <= 2);
}

TEST_CASE("Out of reach, no random joints come closer than the answer") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm);
  std::mt19937 random(5);
  for (int k = 0; k < 20; ++k) {
    Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
    pose.topRightCorner<3, 1>() += Eigen::Vector3d(0.9, 0.0, 0.6);
    const IkResult found = ik.solve(pose);
    REQUIRE(within_limits(arm, found.joints));
    for (int i = 0; i < 2000; ++i) {
      const Errors error = errors(arm, arms::random_joints(arm, random), pose);
      REQUIRE(found.position_error + 0.1 * found.angle_error <= error.position + 0.1 * error.angle + 1e-9);
    }
  }
}

TEST_CASE("Position only: the tip is where it should be, however it is turned") {
  const Arm arm = seven_joints();
  dmp::IkOptions options;
  options.weight << 1, 1, 1, 0, 0, 0;
  InverseKinematics ik(arm, options);
  std::mt19937 random(11);
  for (int k = 0; k < 300; ++k) {
    Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
    pose.topLeftCorner<3, 3>() = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    const IkResult found = ik.solve(pose);
    REQUIRE(found.ok());
    REQUIRE(errors(arm, found.joints, pose).position <= 1e-6);
    REQUIRE(found.angle_error == 0.0);
  }
}

TEST_CASE("A free tool axis points where it should and spins as it likes") {
  const Arm arm = seven_joints();
  std::mt19937 random(12);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    dmp::IkOptions options;
    options.weight[3 + axis] = 0.0;
    InverseKinematics ik(arm, options);
    int nearer = 0;
    for (int k = 0; k < 200; ++k) {
      Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
      pose.topLeftCorner<3, 3>() *= Eigen::AngleAxisd(2.5, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
      const IkResult found = ik.solve(pose, arms::random_joints(arm, random));
      const Eigen::Matrix4d tip = arm.forward_kinematics(found.joints);
      REQUIRE(found.ok());
      REQUIRE((tip - pose).topRightCorner<3, 1>().norm() <= 1e-6);
      REQUIRE((tip.col(axis) - pose.col(axis)).norm() <= 1.1e-6);
      nearer += errors(arm, found.joints, pose).angle > 0.1 ? 1 : 0;
    }
    CHECK(nearer > 100);  // the spin is truly left alone
  }
}

TEST_CASE("A free direction of the position leaves the tip on a line") {
  const Arm arm = seven_joints();
  dmp::IkOptions options;
  options.weight << 1, 1, 0, 1, 1, 1;  // anywhere along the tool's z
  InverseKinematics ik(arm, options);
  std::mt19937 random(13);
  for (int k = 0; k < 100; ++k) {
    Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
    const Eigen::Vector3d along = pose.topLeftCorner<3, 1>().cross(pose.block<3, 1>(0, 1));
    pose.topRightCorner<3, 1>() += 3.0 * along;  // beyond reach but for the line
    const IkResult found = ik.solve(pose);
    REQUIRE(found.ok());
    const Eigen::Vector3d way = (arm.forward_kinematics(found.joints) - pose).topRightCorner<3, 1>();
    REQUIRE(way.cross(along).norm() <= 1.1e-6);
  }
}

TEST_CASE("What counts more is met better where not all can be had") {
  const Arm arm = two_link();
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topRightCorner<3, 1>() = Eigen::Vector3d(1.0, 1.2, 0.0);  // reached only with the tool turned
  dmp::IkOptions options;
  options.weight << 1, 1, 1, 100, 100, 100;
  const IkResult upright = InverseKinematics(arm, options).solve(pose);
  options.weight << 100, 100, 100, 1, 1, 1;
  const IkResult there = InverseKinematics(arm, options).solve(pose);
  CHECK(upright.angle_error < 1e-3);
  CHECK(there.position_error < 1e-3);
  CHECK(upright.position_error > 0.1);
  CHECK(there.angle_error > 0.1);
}

TEST_CASE("Weights that are none are refused by name") {
  for (const int bad : {0, 1, 2, 3}) {
    dmp::IkOptions options;
    if (bad == 0) options.weight[2] = -1.0;
    if (bad == 1) options.weight[4] = std::nan("");
    if (bad == 2) options.weight.setZero();
    if (bad == 3) options.weight[3] = options.weight[4] = 0.0;
    CHECK_THROWS_WITH_AS(InverseKinematics(two_link(), options), doctest::Contains("options.weight"),
                         dmp::InvalidArgument);
  }
  dmp::IkOptions options;
  options.backend = dmp::IkBackend::kdl_lma;
  options.weight[5] = 0.0;
  CHECK_THROWS_WITH_AS(InverseKinematics(two_link(), options), doctest::Contains("bounded_lm"),
                       dmp::InvalidArgument);
}

TEST_CASE("A stretched elbow that shall bend is singular under a short step") {
  const Arm arm = two_link();
  dmp::IkOptions options;
  options.weight << 1, 1, 1, 0, 0, 0;
  options.max_step = 0.05;
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose(0, 3) = 1.95;  // inwards along the stretched arm: elbow 0.45 rad, and no direction to set out
  CHECK(InverseKinematics(arm, options).solve(pose, Eigen::Vector2d::Zero()).status == IkStatus::singular);
  pose.topRightCorner<3, 1>() << 2.0 * std::cos(0.3), 2.0 * std::sin(0.3), 0.0;  // sideways it sets out well
  CHECK(InverseKinematics(arm, options).solve(pose, Eigen::Vector2d::Zero()).status ==
        IkStatus::step_limited);
}

TEST_CASE("Poses and seeds that are none are invalid_input and never throw") {
  const Arm arm = two_link();
  InverseKinematics ik(arm);
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  CHECK(ik.solve(Eigen::Matrix4d::Constant(std::nan(""))).status == IkStatus::invalid_input);
  CHECK(ik.solve(pose, Eigen::VectorXd::Zero(3)).status == IkStatus::invalid_input);
  CHECK(ik.solve(pose, Eigen::Vector2d(0.0, std::nan(""))).status == IkStatus::invalid_input);
  pose(2, 2) = -1.0;  // a reflection
  CHECK(ik.solve(pose).status == IkStatus::invalid_input);
  CHECK(ik.solve(pose).joints.size() == 2);
}

TEST_CASE("Of several windings the one nearest to the seed is returned") {
  const std::string wide = R"(<limit lower="-6.2" upper="6.2" velocity="3" effort="50"/>)";
  const std::string z = R"(<axis xyz="0 0 1"/>)", one = R"(<origin xyz="1 0 0"/>)";
  const Arm arm = Arm::from_urdf(
      arms::urdf({{"", z, "revolute", wide}, {one, z, "continuous", ""}, {one, "", "fixed", ""}}));
  InverseKinematics ik(arm);
  const Eigen::Vector2d q(5.0, 13.0);
  const IkResult found =
      ik.solve(arm.forward_kinematics(Eigen::VectorXd(q)), Eigen::VectorXd(q.array() + 0.2));
  CHECK(found.ok());
  CHECK((found.joints - q).norm() < 1e-4);
  CHECK(std::abs(ik.solve(arm.forward_kinematics(Eigen::VectorXd(q)), Eigen::Vector2d(-1.0, 0.7)).joints[0]) <
        6.2);
}

TEST_CASE("Prismatic and mimic joints are solved too") {
  const Arm arm = Arm::from_urdf(arms::urdf(
      {{"", R"(<axis xyz="1 0 0"/>)", "prismatic",
        R"(<limit lower="-1" upper="1" velocity="1" effort="9"/>)"},
       {},
       {R"(<origin xyz="0.5 0 0"/>)", R"(<axis xyz="0 0 1"/>)", "revolute",
        R"(<limit lower="-4" upper="4" velocity="3" effort="50"/><mimic joint="joint2" multiplier="2" offset="0.1"/>)"},
       {R"(<origin xyz="0.5 0 0"/>)", "", "fixed", ""}}));
  InverseKinematics ik(arm);
  const Eigen::Vector2d q(0.3, -0.8);
  const IkResult found = ik.solve(arm.forward_kinematics(Eigen::VectorXd(q)));
  CHECK(found.ok());
  CHECK((found.joints - q).norm() < 1e-5);
}

TEST_CASE("KDL's own solvers answer through the same search, held to the same limits") {
  const Arm arm = seven_joints();
  for (const dmp::IkBackend backend : {dmp::IkBackend::kdl_lma, dmp::IkBackend::kdl_nr_jl}) {
    dmp::IkOptions options;
    options.backend = backend;
    InverseKinematics ik(arm, options);
    std::mt19937 random(6);
    int solved = 0;
    for (int k = 0; k < 50; ++k) {
      const Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
      const IkResult found = ik.solve(pose, arms::random_joints(arm, random));
      REQUIRE(within_limits(arm, found.joints));
      if (found.ok()) REQUIRE(errors(arm, found.joints, pose).position <= 1e-6);
      solved += found.ok() ? 1 : 0;
    }
    CHECK(solved >= 45);
  }
}

TEST_CASE("Limits so wide that they are none do not send the search to where angles have no digits left") {
  const Arm narrow = seven_joints();
  const Eigen::VectorXd wide = Eigen::VectorXd::Constant(7, 1e16);
  const Arm arm = narrow.with_limits({-wide, wide, {}, {}});
  InverseKinematics ik(arm);
  CHECK(ik.middle().isZero(0.0));
  std::mt19937 random(14);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(narrow, random));
    const IkResult found = ik.solve(pose);
    CHECK(found.ok());
    CHECK(found.joints.cwiseAbs().maxCoeff() < 100.0);
  }
}

TEST_CASE("KDL's solvers that diverge leave finite joints within the limits") {
  dmp::IkOptions options;
  options.backend = dmp::IkBackend::kdl_nr_jl;
  options.diagnose = false;
  const Arm arm = seven_joints();
  InverseKinematics ik(arm, options);
  std::mt19937 random(9);
  for (int k = 0; k < 100; ++k) {
    Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
    pose.topRightCorner<3, 1>() *= 1.5;
    const IkResult found = ik.solve(pose, arms::random_joints(arm, random));
    REQUIRE(within_limits(arm, found.joints));
    REQUIRE(std::isfinite(found.position_error));
  }
}

TEST_CASE("A tolerance below what numbers can hold is missed by next to nothing") {
  const Arm arm = seven_joints();
  std::mt19937 random(10);
  for (const dmp::IkBackend backend :
       {dmp::IkBackend::bounded_lm, dmp::IkBackend::kdl_lma, dmp::IkBackend::kdl_nr_jl}) {
    dmp::IkOptions options;
    options.backend = backend;
    options.position_tolerance = options.angle_tolerance = 1e-18;
    options.diagnose = false;
    InverseKinematics ik(arm, options);
    for (int k = 0; k < 20; ++k) {
      const IkResult found = ik.solve(arm.forward_kinematics(arms::random_joints(arm, random)));
      REQUIRE(within_limits(arm, found.joints));
      REQUIRE(found.position_error < 1e-8);
    }
  }
}

TEST_CASE("A pose at the end of the numbers is missed and nothing else") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm);
  for (const double far : {1e6, 1e150, 1e300}) {
    Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
    pose.topRightCorner<3, 1>().setConstant(far);
    const IkResult found = ik.solve(pose);
    CAPTURE(far);
    CHECK_FALSE(found.ok());
    CHECK(within_limits(arm, found.joints));
  }
}

TEST_CASE("KDL's solvers are refused for joints they do not know") {
  const Arm arm = Arm::from_urdf(arms::urdf({{"", R"(<axis xyz="0 0 1"/>)", "continuous", ""}}));
  dmp::IkOptions options;
  options.backend = dmp::IkBackend::kdl_lma;
  CHECK_THROWS_WITH_AS(InverseKinematics(arm, options), doctest::Contains("bounded_lm"),
                       dmp::InvalidArgument);
}

TEST_CASE("Options out of range are refused by name") {
  dmp::IkOptions options;
  options.max_step = -1.0;
  CHECK_THROWS_WITH_AS(InverseKinematics(two_link(), options), doctest::Contains("max_step"),
                       dmp::InvalidArgument);
  options = {};
  options.iteration_limit = 0;
  CHECK_THROWS_AS(InverseKinematics(two_link(), options), dmp::InvalidArgument);
  options = {};
  options.position_tolerance = std::nan("");
  CHECK_THROWS_AS(InverseKinematics(two_link(), options), dmp::InvalidArgument);
}

TEST_CASE("solve_many answers like solve, one pose after the other") {
  const Arm arm = seven_joints();
  InverseKinematics ik(arm);
  std::mt19937 random(7);
  dmp::Poses poses;
  for (int k = 0; k < 20; ++k) poses.push_back(arm.forward_kinematics(arms::random_joints(arm, random)));
  poses[5](0, 3) += 50.0;
  const dmp::IkBatch batch = ik.solve_many(poses);
  CHECK(batch.solved == 19);
  CHECK(batch.status[5] == IkStatus::out_of_reach);
  CHECK(batch.joints.row(0).transpose() == ik.solve(poses[0]).joints);
  CHECK(batch.joints.row(6).transpose() == ik.solve(poses[6], batch.joints.row(4).transpose()).joints);
}

TEST_CASE("Solvers of one arm in several threads give the serial answers, bit for bit") {
  const Arm arm = seven_joints();
  std::mt19937 random(8);
  dmp::Poses poses;
  for (int k = 0; k < 500; ++k) poses.push_back(arm.forward_kinematics(arms::random_joints(arm, random)));
  const dmp::RowMatrix serial = InverseKinematics(arm).solve_many(poses).joints;
  std::array<bool, 3> same{};
  std::vector<std::thread> threads;
  for (bool& one : same)
    threads.emplace_back([&] { one = InverseKinematics(arm).solve_many(poses).joints == serial; });
  for (std::thread& thread : threads) thread.join();
  CHECK(same == std::array<bool, 3>{true, true, true});
}

TEST_CASE("Solvers, trackers and iterators are values: assigned and moved they answer as the original") {
  const Arm arm = seven_joints(), other_arm = two_link();
  InverseKinematics ik(arm), other(other_arm);
  std::mt19937 random(21);
  const Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
  const Eigen::VectorXd joints = ik.solve(pose).joints;
  other = ik;
  CHECK(other.solve(pose).joints == joints);
  InverseKinematics moved(std::move(other));
  CHECK(moved.solve(pose).joints == joints);
  CHECK(moved.options().position_tolerance == ik.options().position_tolerance);

  dmp::JointTracker tracker(arm, joints), second(other_arm, Eigen::Vector2d(0.1, 0.2));
  second = tracker;
  CHECK(second.joints() == joints);
  dmp::JointTracker third(std::move(second));
  CHECK(third.track(pose, 1e-3) == tracker.track(pose, 1e-3));
  CHECK(third.joints() == tracker.joints());

  dmp::IkBranches branches(arm, pose, joints),
      assigned(other_arm, other_arm.forward_kinematics(Eigen::VectorXd(Eigen::Vector2d(0.1, 0.2))),
               Eigen::Vector2d(0.1, 0.2));
  const Eigen::VectorXd first = branches.next()->joints;
  assigned = dmp::IkBranches(arm, pose, joints);
  dmp::IkBranches last(std::move(assigned));
  CHECK(last.next()->joints == first);
}
