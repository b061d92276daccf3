#pragma once

#include <dmp/error.hpp>
#include <dmp/so3.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <string>

#include "primitive/rollout.hpp"

namespace dmp::detail {

inline void require_finite(const Eigen::Ref<const Eigen::VectorXd>& value, Eigen::Index size,
                           const std::string& name) {
  if (value.size() != size)
    throw InvalidArgument(name + ": " + std::to_string(value.size()) + " numbers, expected " +
                          std::to_string(size) + ".");
  for (Eigen::Index d = 0; d < size; ++d)
    if (!std::isfinite(value[d]))
      throw InvalidArgument(indexed(name, d) + ": " + number(value[d]) + ", expected a finite number.");
}

inline void require_weights(const RowMatrix& weights, Eigen::Index rows, Eigen::Index columns) {
  if (weights.rows() != rows || weights.cols() != columns)
    throw InvalidArgument("weights: " + std::to_string(weights.rows()) + " x " +
                          std::to_string(weights.cols()) + ", expected " + std::to_string(rows) + " x " +
                          std::to_string(columns) + ".");
}

inline void require_pose(const Eigen::Matrix4d& pose, const std::string& name) {
  if (!pose.allFinite()) throw InvalidArgument(name + ": not finite, expected [R p; 0 1].");
  if ((pose.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-9)
    throw InvalidArgument(name + ": its last row is not 0 0 0 1. Check the layout: [R p; 0 1].");
  so3::require_rotation(pose.topLeftCorner<3, 3>(), name);
}

/// The nearest rotation; one that is exact but for rounding keeps its bits.
inline Eigen::Matrix3d exact(const Eigen::Matrix3d& r) {
  const double defect = (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return defect < 1e-9 ? r : so3::nearest_rotation(r);
}

/// True for a rotation to 1e-6; for the control loop, which may not throw.
inline bool is_rotation(const Eigen::Matrix3d& r) noexcept {
  return r.allFinite() && (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-6 &&
         r.determinant() > 0.0;
}

}  // namespace dmp::detail
