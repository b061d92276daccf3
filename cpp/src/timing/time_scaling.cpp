#include <dmp/error.hpp>
#include <dmp/time_scaling.hpp>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "robot/arm_dynamics.hpp"
#include "timing/spline_extremes.hpp"

namespace dmp {

double duration_factor(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit,
                       const Eigen::VectorXd& acceleration_limit) {
  detail::check_limit(velocity_limit, joints.position.cols(), "velocity_limit");
  detail::check_limit(acceleration_limit, joints.position.cols(), "acceleration_limit");
  if (joints.time.size() == 0) return 0.0;
  return std::sqrt(detail::squared_factors(joints, velocity_limit, acceleration_limit).maxCoeff());
}

double duration_factor(const Arm& arm, const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit,
                       const Eigen::VectorXd& acceleration_limit, const Eigen::VectorXd& effort_limit,
                       const Eigen::Vector3d& gravity) {
  if (joints.position.cols() != arm.joint_count())
    throw InvalidArgument("joints: " + std::to_string(joints.position.cols()) + " columns, expected " +
                          std::to_string(arm.joint_count()) + ", one for each joint of the arm.");
  if (!gravity.allFinite()) throw InvalidArgument("gravity: not finite.");
  detail::check_limit(effort_limit, arm.joint_count(), "effort_limit");
  const double factor = duration_factor(joints, velocity_limit, acceleration_limit);
  if (joints.time.size() == 0) return factor;
  detail::ArmDynamics dynamics(arm.model(), gravity);
  const RowMatrix holding = detail::holding_efforts(dynamics, joints.position, effort_limit, "effort_limit");
  const double square = detail::squared_effort_factors(dynamics, joints, holding, effort_limit).maxCoeff();
  return std::max(factor, std::sqrt(square));
}

JointTrajectory stretched(const JointTrajectory& joints, double factor) {
  if (!(factor > 0.0) || !std::isfinite(factor))
    throw InvalidArgument("factor: " + detail::number(factor) + ", expected > 0 and finite.");
  JointTrajectory result = joints;
  if (joints.time.size() > 0) result.time = joints.time[0] + factor * (joints.time.array() - joints.time[0]);
  result.velocity /= factor;
  result.acceleration = result.acceleration / factor / factor;
  result.report.velocity_ratio /= factor;
  if (!result.time.allFinite() || !result.velocity.allFinite() || !result.acceleration.allFinite())
    throw InvalidArgument("factor: " + detail::number(factor) + ", with which times or velocities overflow.");
  return result;
}

}  // namespace dmp
