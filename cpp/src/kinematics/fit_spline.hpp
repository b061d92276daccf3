#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <array>

namespace dmp::detail {

/// The values of the four cubic B-splines at one place between two knots, and their derivatives by u.
struct SplineRow {
  std::array<double, 4> value, slope, curve;
  explicit SplineRow(double u);
};

/// The joints of a uniform cubic B-spline with coefficients (M x n), `t` behind its begin.
Eigen::RowVectorXd spline_at(const RowMatrix& coefficients, double spacing, double t);

/// The spline (M x n) nearest to joints (3 (M - 3) + 1 x n): three samples for each interval.
RowMatrix nearest_spline(const RowMatrix& joints);

}  // namespace dmp::detail
