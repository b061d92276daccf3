// Eight threads that share an arm answer what one thread answers, bit for bit. KDL's chains are not safe to
// share: this is what shows a solver that does.
#include <doctest/doctest.h>
#include <dmp/inverse_kinematics.hpp>
#include <dmp/joint_tracker.hpp>
#include <dmp/time_optimal.hpp>
#include <dmp/time_scaling.hpp>

#include "arms.hpp"
#include "threads.hpp"

using namespace dmp;
using threads::all_same;

namespace {

const Arm& arm() {
  static const Arm shared = Arm::from_urdf(arms::seven_joints());
  return shared;
}

/// Joints on a smooth way within the limits, (T x n).
RowMatrix joints_on_a_way(Eigen::Index count) {
  RowMatrix q(count, arm().joint_count());
  const Eigen::VectorXd middle = InverseKinematics(arm()).middle();
  for (Eigen::Index k = 0; k < count; ++k)
    q.row(k) =
        middle.transpose().array() + .4 * std::sin(3.0 * static_cast<double>(k) / static_cast<double>(count));
  return q;
}

}  // namespace

TEST_CASE("threads share an arm for forward kinematics and Jacobians") {
  const RowMatrix q = joints_on_a_way(50);
  const Poses poses = arm().forward_kinematics(q);
  const Eigen::MatrixXd jacobian = arm().jacobian(q.row(7));
  CHECK(all_same(
      100, [&] { return arm().forward_kinematics(q) == poses && arm().jacobian(q.row(7)) == jacobian; }));
}

TEST_CASE("threads share an arm for solving and following, each with a solver of its own") {
  const Poses poses = arm().forward_kinematics(joints_on_a_way(20));
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(20, 0.0, 2.0);
  FollowOptions options;
  options.thorough = false;
  options.anchors = 2;
  options.starts = 4;
  const RowMatrix solved = InverseKinematics(arm()).solve_many(poses).joints;
  const RowMatrix followed = InverseKinematics(arm()).follow(times, poses, options).position;
  CHECK(all_same(2, [&] { return InverseKinematics(arm()).solve_many(poses).joints == solved; }));
  CHECK(all_same(
      1, [&] { return InverseKinematics(arm()).follow(times, poses, options).position == followed; }));
}

TEST_CASE("threads share an arm for tracking and timing") {
  const RowMatrix q = joints_on_a_way(40);
  const Poses poses = arm().forward_kinematics(q);
  const auto tracked = [&] {
    JointTracker tracker(arm(), q.row(0));
    for (const Eigen::Matrix4d& pose : poses) tracker.track(pose, 0.05);
    return Eigen::VectorXd(tracker.joints());
  };
  const JointTrajectory motion = JointTrajectory::through(Eigen::VectorXd::LinSpaced(40, 0.0, 2.0), q);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(7);
  const auto timed = [&] { return time_optimal(arm(), motion, {ones, 2 * ones, 100 * ones}).time; };
  const Eigen::VectorXd end = tracked();
  const Eigen::VectorXd times = timed();
  CHECK(all_same(5, [&] { return tracked() == end; }));
  CHECK(all_same(2, [&] { return timed() == times; }));
}
