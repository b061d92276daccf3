#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "spline/knots.hpp"

namespace dmp::detail {

/// The B-splines through samples at given times (not-a-knot ends; de Boor 1978, chapter XIII): the matrix of
/// their values at the samples, factorised once for all values that are sampled at these times.
class Collocation {
 public:
  /// times (T) s, strictly increasing, T >= 2; the degree is 5, or T - 1 for fewer samples.
  explicit Collocation(const Eigen::VectorXd& times);

  const Knots& knots() const noexcept { return knots_; }
  /// values (T x d) at the samples become the coefficients.
  void solve(RowMatrix& values) const;

 private:
  static constexpr int kDegree = 5;
  static constexpr int kWidth = 2 * kDegree + 1;

  void fill(const Eigen::VectorXd& times);
  void factorise();
  double& element(Eigen::Index row, Eigen::Index column) {
    return band_[static_cast<std::size_t>(row * kWidth + column - row + kDegree)];
  }
  template <int Columns>
  void substitute(double* values, Eigen::Index columns) const noexcept;

  Knots knots_;
  std::vector<double> band_;  // L below the diagonal, 1 / U(i, i) on it, U above it
  struct Extent {
    int first;  // column of the row's first element, and of its last
    int last;
  };
  std::vector<Extent> extent_;
};

}  // namespace dmp::detail
