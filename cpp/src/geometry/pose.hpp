#pragma once

#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

namespace dmp::detail {

/// The rotation nearest to r, for one that so3::is_rotation accepts (Newton's iteration for the polar factor,
/// Higham 1986, "Computing the polar decomposition"; it converges quadratically, from 1e-3 to rounding in
/// three steps). A rotation that is exact but for rounding keeps its bits.
inline Eigen::Matrix3d projected(const Eigen::Matrix3d& r) noexcept {
  constexpr double kRounding = 1e-12;
  Eigen::Matrix3d nearest = r;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Matrix3d excess = nearest.transpose() * nearest - Eigen::Matrix3d::Identity();
    if (excess.cwiseAbs().maxCoeff() < kRounding) break;
    nearest = nearest * (Eigen::Matrix3d::Identity() - 0.5 * excess);
  }
  return nearest;
}

/// The unit quaternion of the rotation nearest to r.
inline Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& r) noexcept {
  return Eigen::Quaterniond(projected(r)).normalized();
}

inline bool ends_in_0001(const Eigen::Matrix4d& pose) noexcept {
  return ((pose.row(3) - Eigen::RowVector4d::Unit(3)).array().abs() <= 1e-9).all();
}

/// Whether `pose` is [R p; 0 1]: finite, R a rotation as so3::is_rotation has it, the last row 0 0 0 1.
inline bool is_pose(const Eigen::Matrix4d& pose) noexcept {
  return pose.allFinite() && ends_in_0001(pose) && so3::is_rotation(pose.topLeftCorner<3, 3>());
}

/// Throws InvalidArgument, naming `name`, unless is_pose.
inline void require_pose(const Eigen::Matrix4d& pose, const std::string& name) {
  if (!pose.allFinite()) throw InvalidArgument(name + ": not finite, expected [R p; 0 1].");
  if (!ends_in_0001(pose))
    throw InvalidArgument(name + ": its last row is not 0 0 0 1. Check the layout: [R p; 0 1].");
  so3::require_rotation(pose.topLeftCorner<3, 3>(), name);
}

}  // namespace dmp::detail
