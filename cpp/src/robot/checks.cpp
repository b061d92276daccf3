#include "robot/checks.hpp"

#include <cmath>
#include <dmp/error.hpp>

#include "geometry/pose.hpp"

namespace dmp::detail {

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

void check_times(const Eigen::VectorXd& times) {
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    if (!std::isfinite(times[k])) throw InvalidArgument("times[" + std::to_string(k) + "]: " + "not finite.");
    if (k > 0 && !(times[k] > times[k - 1]))
      throw InvalidArgument("times[" + std::to_string(k) + "]: " + std::to_string(times[k]) +
                            " does not come after " + std::to_string(times[k - 1]) +
                            "; expected seconds that increase.");
  }
}

void check_joints(const Eigen::VectorXd& q, Eigen::Index count, const std::string& name) {
  if (q.size() != count)
    throw InvalidArgument(name + ": " + std::to_string(q.size()) + " values, expected " +
                          std::to_string(count) + ", one for each joint.");
  for (Eigen::Index i = 0; i < count; ++i)
    if (!std::isfinite(q[i])) throw InvalidArgument(name + "[" + std::to_string(i) + "]: not finite.");
}

Eigen::VectorXd brought_within_limits(const Eigen::VectorXd& q, const Arm& arm, const std::string& name) {
  check_joints(q, arm.joint_count(), name);
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (q[i] < arm.lower()[i] - limit_tolerance || q[i] > arm.upper()[i] + limit_tolerance)
      throw InvalidArgument(name + "[" + std::to_string(i) + "]: joint '" +
                            arm.joint_names()[static_cast<std::size_t>(i)] + "' at " + std::to_string(q[i]) +
                            ", expected within the limits " + std::to_string(arm.lower()[i]) + " to " +
                            std::to_string(arm.upper()[i]) + " (to 0.001).");
  return q.cwiseMax(arm.lower()).cwiseMin(arm.upper());
}

Frame rigid_frame(const Eigen::Matrix4d& pose) {
  return {projected(pose.topLeftCorner<3, 3>()), pose.topRightCorner<3, 1>()};
}

}  // namespace dmp::detail
