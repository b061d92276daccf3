#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include <dmp/so3.hpp>

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// The rotation vector of R in SO(3): axis times angle in [0, pi] rad. Accurate for every angle: the sine of
/// it carries small angles, the cosine large ones; at pi the axis comes from the symmetric part (by
/// quaternion).
inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& r) {
  const Eigen::Vector3d w = 0.5 * Eigen::Vector3d(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  const double sine = w.norm(), cosine = 0.5 * (r.trace() - 1.0);
  if (cosine < -0.99) {
    const Eigen::Quaterniond q(r);
    const Eigen::Vector3d v = q.w() < 0.0 ? Eigen::Vector3d(-q.vec()) : Eigen::Vector3d(q.vec());
    return 2.0 * std::atan2(v.norm(), std::abs(q.w())) * v.normalized();
  }
  return sine > 1e-9 ? Eigen::Vector3d(std::atan2(sine, cosine) / sine * w) : w;
}

/// From the actual pose to the target: position [m] in rows 0-2, rotation vector [rad] in rows 3-5, base
/// frame.
inline Vector6 pose_error(const Frame& target, const Frame& actual) {
  Vector6 error;
  error.head<3>() = target.position - actual.position;
  error.tail<3>() = so3::log(Eigen::Matrix3d(target.rotation * actual.rotation.transpose()));
  return error;
}

}  // namespace dmp::detail
