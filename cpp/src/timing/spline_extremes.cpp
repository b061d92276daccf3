#include "timing/spline_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <dmp/error.hpp>

namespace dmp::detail {
namespace {

// The largest speed of joint i between the samples k and k + 1, where its acceleration passes through zero:
// the speed is a parabola there, v0 + a0 s + (a1 - a0) s^2 / (2 h). 0 if the extreme lies at a sample.
double speed_between(const JointTrajectory& joints, Eigen::Index k, Eigen::Index i) {
  const double a0 = joints.acceleration(k, i), a1 = joints.acceleration(k + 1, i);
  if (a0 * a1 >= 0.0) return 0.0;
  const double h = joints.time[k + 1] - joints.time[k];
  return std::abs(joints.velocity(k, i) - 0.5 * a0 * a0 * h / (a1 - a0));
}

}  // namespace

void check_limit(const Eigen::VectorXd& limit, Eigen::Index count, const std::string& name) {
  if (limit.size() != count)
    throw InvalidArgument(name + ": " + std::to_string(limit.size()) + " values, expected " +
                          std::to_string(count) + ", one for each joint.");
  for (Eigen::Index i = 0; i < count; ++i)
    if (!(limit[i] > 0.0))
      throw InvalidArgument(name + "[" + std::to_string(i) + "]: " + std::to_string(limit[i]) +
                            ", expected > 0.");
}

Eigen::VectorXd squared_factors(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit,
                                const Eigen::VectorXd& acceleration_limit) {
  const Eigen::Index last = joints.time.size() - 1;
  Eigen::VectorXd square = Eigen::VectorXd::Zero(last + 1);
  for (Eigen::Index k = 0; k <= last; ++k)
    for (Eigen::Index i = 0; i < joints.position.cols(); ++i) {
      const double between = k < last ? speed_between(joints, k, i) : 0.0;
      const double speed = std::max(std::abs(joints.velocity(k, i)), between) / velocity_limit[i];
      square[k] =
          std::max({square[k], speed * speed, std::abs(joints.acceleration(k, i)) / acceleration_limit[i]});
    }
  return square;
}

double largest_step_ratio(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit) {
  double ratio = 0.0;
  for (Eigen::Index k = 1; k < joints.time.size(); ++k) {
    const Eigen::VectorXd step = (joints.position.row(k) - joints.position.row(k - 1)).cwiseAbs();
    ratio = std::max(ratio,
                     step.cwiseQuotient(velocity_limit).maxCoeff() / (joints.time[k] - joints.time[k - 1]));
  }
  return ratio;
}

}  // namespace dmp::detail
