#include "kinematics/fit_spline.hpp"

#include <algorithm>

#include "kinematics/bordered_band.hpp"

namespace dmp::detail {

using Eigen::Index;

SplineRow::SplineRow(double u) {
  const double v = 1.0 - u;
  value = {v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
           (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0};
  slope = {-v * v / 2.0, (3.0 * u * u - 4.0 * u) / 2.0, (4.0 * v - 3.0 * v * v) / 2.0, u * u / 2.0};
  curve = {v, 3.0 * u - 2.0, 3.0 * v - 2.0, u};
}

Eigen::RowVectorXd spline_at(const RowMatrix& coefficients, double spacing, double t) {
  const Index first = std::clamp<Index>(static_cast<Index>(t / spacing), 0, coefficients.rows() - 4);
  const SplineRow row(std::min(t / spacing - static_cast<double>(first), 1.0));
  Eigen::RowVectorXd q = Eigen::RowVectorXd::Zero(coefficients.cols());
  for (Index i = 0; i < 4; ++i) q += row.value[static_cast<std::size_t>(i)] * coefficients.row(first + i);
  return q;
}

RowMatrix nearest_spline(const RowMatrix& joints) {
  const Index count = (joints.rows() - 1) / 3 + 3;
  RowMatrix result(count, joints.cols());
  BorderedBand system(count, 3, 0);
  Eigen::VectorXd column, none;
  for (Index j = 0; j < joints.cols(); ++j) {
    system.set_zero();
    for (Index k = 0; k < joints.rows(); ++k) {
      const Index first = std::min(k / 3, count - 4);
      const SplineRow row(static_cast<double>(k - 3 * first) / 3.0);
      for (std::size_t a = 0; a < 4; ++a) {
        system.right[first + static_cast<Index>(a)] += row.value[a] * joints(k, j);
        for (std::size_t c = a; c < 4; ++c)
          system.band(first + static_cast<Index>(a), static_cast<Index>(c - a)) +=
              row.value[a] * row.value[c];
      }
    }
    system.solve(1e-12, column, none);
    result.col(j) = column;
  }
  return result;
}

}  // namespace dmp::detail
