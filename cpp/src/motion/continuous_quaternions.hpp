#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dmp::detail {

/// (T x 4) w, x, y, z; neighbours on one hemisphere.
inline RowMatrix continuous_quaternions(const Rotations& rotations) {
  RowMatrix table(static_cast<Eigen::Index>(rotations.size()), 4);
  for (Eigen::Index k = 0; k < table.rows(); ++k) {
    const Eigen::Quaterniond q(rotations[static_cast<std::size_t>(k)]);
    table.row(k) << q.w(), q.x(), q.y(), q.z();
    if (k > 0 && table.row(k).dot(table.row(k - 1)) < 0.0) table.row(k) *= -1.0;
  }
  return table;
}

}  // namespace dmp::detail
