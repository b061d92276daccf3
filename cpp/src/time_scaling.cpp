#include <dmp/error.hpp>
#include <dmp/time_scaling.hpp>

#include <algorithm>
#include <cmath>

#include "detail/text.hpp"

namespace dmp {
namespace {

void check_limit(const Eigen::VectorXd& limit, Eigen::Index count, const std::string& name) {
  if (limit.size() != count)
    throw InvalidArgument(name + ": " + std::to_string(limit.size()) + " values, expected " +
                          std::to_string(count) + ", one for each joint.");
  for (Eigen::Index i = 0; i < count; ++i)
    if (!(limit[i] > 0.0))
      throw InvalidArgument(name + "[" + std::to_string(i) + "]: " + std::to_string(limit[i]) +
                            ", expected > 0.");
}

// The largest speed of joint i between the samples k and k + 1, where its acceleration passes through zero:
// the speed is a parabola there, v0 + a0 s + (a1 - a0) s^2 / (2 h). 0 if the extreme lies at a sample.
double speed_between(const JointTrajectory& joints, Eigen::Index k, Eigen::Index i) {
  const double a0 = joints.acceleration(k, i), a1 = joints.acceleration(k + 1, i);
  if (a0 * a1 >= 0.0) return 0.0;
  const double h = joints.time[k + 1] - joints.time[k];
  return std::abs(joints.velocity(k, i) - 0.5 * a0 * a0 * h / (a1 - a0));
}

}  // namespace

double duration_factor(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit,
                       const Eigen::VectorXd& acceleration_limit) {
  check_limit(velocity_limit, joints.position.cols(), "velocity_limit");
  check_limit(acceleration_limit, joints.position.cols(), "acceleration_limit");
  double factor = 0.0;
  for (Eigen::Index k = 0; k < joints.time.size(); ++k)
    for (Eigen::Index i = 0; i < joints.position.cols(); ++i) {
      const double between = k + 1 < joints.time.size() ? speed_between(joints, k, i) : 0.0;
      const double speed = std::max(std::abs(joints.velocity(k, i)), between);
      factor = std::max({factor, speed / velocity_limit[i],
                         std::sqrt(std::abs(joints.acceleration(k, i)) / acceleration_limit[i])});
    }
  return factor;
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
