#include <dmp/error.hpp>
#include <dmp/time_scaling.hpp>

#include <cmath>

#include "detail/spline_extremes.hpp"
#include "detail/text.hpp"

namespace dmp {

double duration_factor(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit,
                       const Eigen::VectorXd& acceleration_limit) {
  detail::check_limit(velocity_limit, joints.position.cols(), "velocity_limit");
  detail::check_limit(acceleration_limit, joints.position.cols(), "acceleration_limit");
  if (joints.time.size() == 0) return 0.0;
  return std::sqrt(detail::squared_factors(joints, velocity_limit, acceleration_limit).maxCoeff());
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
