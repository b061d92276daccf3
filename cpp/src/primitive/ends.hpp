#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// Where a motion starts and where it goes, the axes of all its parts side by side.
template <class Space>
struct Ends {
  typename Space::Point start;
  typename Space::Point goal;
  Eigen::VectorXd z;             ///< (d) tau times the velocity at the start
  Eigen::VectorXd displacement;  ///< (d) goal - start; of rotations Log(Rg R0^T) on its branch
  Eigen::VectorXd amplitude;     ///< (d) range covered, axis by axis
  RowMatrix reference;           ///< of the rotation that turns along; else empty
};

/// The forcing term, or the drive that is made of it, at the start, the middle and the end of a step.
struct Nodes {
  const double* start;
  const double* middle;
  const double* end;
  Nodes from(Eigen::Index axis) const noexcept { return {start + axis, middle + axis, end + axis}; }
};

}  // namespace dmp::detail
