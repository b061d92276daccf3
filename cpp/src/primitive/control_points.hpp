#pragma once

#include <Eigen/Core>
#include <array>

#include "spline/knots.hpp"

namespace dmp::detail {

/// The four cubic B-splines that are not zero at a phase, or a derivative of theirs.
struct SplineRow {
  Eigen::Index first;  ///< of them
  std::array<double, 4> value;
};

/// Cubic B-splines on clamped even knots over the phase, 0 to 1.
class ControlPoints {
 public:
  explicit ControlPoints(Eigen::Index count);

  Eigen::Index count() const noexcept { return knots_.count(); }
  /// derivative: 0, 1 or 2. Phases beyond the ends count as these.
  SplineRow at(double phase, int derivative = 0) const noexcept;

 private:
  Knots knots_;
};

/// A row (d x n) for each axis at once: out[a] = sum_k row[k] w[k d + a].
inline Eigen::VectorXd value_of(const SplineRow& row, const Eigen::VectorXd& weights, Eigen::Index axes) {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(axes);
  for (Eigen::Index k = 0; k < 4; ++k)
    value += row.value[static_cast<std::size_t>(k)] * weights.segment((row.first + k) * axes, axes);
  return value;
}

/// (d x n) times a matrix of n rows.
inline Eigen::MatrixXd rows_of(const SplineRow& row, const Eigen::MatrixXd& matrix, Eigen::Index axes) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(axes, matrix.cols());
  for (Eigen::Index k = 0; k < 4; ++k)
    rows += row.value[static_cast<std::size_t>(k)] * matrix.middleRows((row.first + k) * axes, axes);
  return rows;
}

}  // namespace dmp::detail
