#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include <dmp/so3.hpp>

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// From the actual pose to the target: position [m] in rows 0-2, rotation vector [rad] in rows 3-5, base
/// frame.
inline Vector6 pose_error(const Frame& target, const Frame& actual) {
  Vector6 error;
  error.head<3>() = target.position - actual.position;
  error.tail<3>() = so3::log(Eigen::Matrix3d(target.rotation * actual.rotation.transpose()));
  return error;
}

}  // namespace dmp::detail
