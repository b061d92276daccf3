#include <dmp/error.hpp>
#include <dmp/tip_motion.hpp>

#include <string>

namespace dmp {
namespace {

constexpr double difference = 1e-6;  // s; joints move by about as many radians

}  // namespace

PoseTrajectory tip_motion(const Arm& arm, const JointTrajectory& joints) {
  const Eigen::Index count = joints.time.size();
  if (joints.position.cols() != arm.joint_count())
    throw InvalidArgument("joints: " + std::to_string(joints.position.cols()) + " columns, expected " +
                          std::to_string(arm.joint_count()) + ", one for each joint of the arm.");
  PoseTrajectory motion{joints.time, arm.forward_kinematics(joints.position), RowMatrix(count, 6),
                        RowMatrix(count, 6)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXd q = joints.position.row(k), v = joints.velocity.row(k),
                          a = joints.acceleration.row(k);
    const Eigen::MatrixXd rate =
        (arm.jacobian(q + difference * v) - arm.jacobian(q - difference * v)) / (2.0 * difference);
    const Eigen::MatrixXd jacobian = arm.jacobian(q);
    motion.twist.row(k) = (jacobian * v).transpose();
    motion.acceleration.row(k) = (jacobian * a + rate * v).transpose();
  }
  return motion;
}

}  // namespace dmp
