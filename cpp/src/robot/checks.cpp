#include "robot/checks.hpp"

#include <Eigen/LU>
#include <cmath>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

namespace dmp::detail {
namespace {

double skewness(const Eigen::Matrix3d& r) {
  return (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

}  // namespace

void check_positive(double value, const std::string& name) {
  if (!(value > 0.0)) throw InvalidArgument(name + ": " + std::to_string(value) + ", expected > 0.");
}

void check_angle_weight(double weight) {
  if (!(weight > 0.0 && std::isfinite(weight)))
    throw InvalidArgument("options.angle_weight: " + std::to_string(weight) +
                          ", expected m per rad, finite and > 0.");
}

void check_capacity(const Arm& arm) {
  if (arm.joint_count() > joint_capacity)
    throw InvalidArgument("arm: " + std::to_string(arm.joint_count()) + " free joints, expected at most " +
                          std::to_string(joint_capacity) + "; choose a base nearer to the tip.");
}

void check_weight(const Vector6& weight) {
  for (Eigen::Index i = 0; i < 6; ++i)
    if (!(weight[i] >= 0.0) || !std::isfinite(weight[i]))
      throw InvalidArgument("options.weight[" + std::to_string(i) + "]: " + std::to_string(weight[i]) +
                            ", expected 0 (free) or more.");
  if (weight.isZero(0.0)) throw InvalidArgument("options.weight: nothing counts; expected one > 0.");
  if ((weight.tail<3>().array() == 0.0).count() == 2)
    throw InvalidArgument("options.weight: two turns are free; expected none, one or all three.");
}

void check_joints(const Eigen::VectorXd& q, Eigen::Index count, const std::string& name) {
  if (q.size() != count)
    throw InvalidArgument(name + ": " + std::to_string(q.size()) + " values, expected " +
                          std::to_string(count) + ", one for each joint.");
  for (Eigen::Index i = 0; i < count; ++i)
    if (!std::isfinite(q[i])) throw InvalidArgument(name + "[" + std::to_string(i) + "]: not finite.");
}

void check_within_limits(const Eigen::VectorXd& q, const Arm& arm, const std::string& name) {
  check_joints(q, arm.joint_count(), name);
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (q[i] < arm.lower()[i] || q[i] > arm.upper()[i])
      throw InvalidArgument(name + "[" + std::to_string(i) + "]: " + std::to_string(q[i]) +
                            ", expected within the limits " + std::to_string(arm.lower()[i]) + " to " +
                            std::to_string(arm.upper()[i]) + ".");
}

bool is_rigid(const Eigen::Matrix4d& pose) {
  const Eigen::Matrix3d r = pose.topLeftCorner<3, 3>();
  return pose.allFinite() && skewness(r) <= 1e-3 && r.determinant() > 0.0 &&
         pose.row(3) == Eigen::RowVector4d::Unit(3);
}

Frame rigid_frame(const Eigen::Matrix4d& pose) {
  Frame frame = {pose.topLeftCorner<3, 3>(), pose.topRightCorner<3, 1>()};
  if (skewness(frame.rotation) > 1e-12) frame.rotation = so3::nearest_rotation(frame.rotation);
  return frame;
}

}  // namespace dmp::detail
