#pragma once

#include <dmp/spline.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "spline/knots.hpp"

namespace dmp::detail {

/// The B-splines through samples at given times (de Boor 1978, chapter XIII): the matrix of their values at
/// the samples, and of their derivatives at ends that have a condition, factorised once for all values that
/// are sampled at these times.
class Collocation {
 public:
  /// times (T) s, strictly increasing, T >= 2; the degree is 5, or T - 1 for fewer samples.
  Collocation(const Eigen::VectorXd& times, const std::array<EndCondition, 2>& ends);

  const Eigen::VectorXd& times() const noexcept { return times_; }
  const Knots& knots() const noexcept { return knots_; }
  /// Whether the matrix serves these ends, too: the two conditions differ by the values alone.
  bool serves(const std::array<EndCondition, 2>& ends) const noexcept;
  /// values (T x d) at the samples, with the rows of with_end_conditions, become the coefficients.
  void solve(RowMatrix& values) const;

 private:
  static constexpr int kDegree = 5;
  static constexpr int kWidth = 2 * kDegree + 1;

  void fill();
  void add_sample(double time);
  void add_condition(int order, bool at_begin);
  void factorise();
  double& element(Eigen::Index row, Eigen::Index column) {
    return band_[static_cast<std::size_t>(row * kWidth + column - row + kDegree)];
  }
  template <int Columns>
  void substitute(double* values, Eigen::Index columns) const noexcept;

  Eigen::VectorXd times_;
  std::array<bool, 2> conditioned_;
  Knots knots_;
  std::vector<double> band_;  // L below the diagonal, 1 / U(i, i) on it, U above it
  struct Extent {
    int first;  // column of the row's first element, and of its last
    int last;
  };
  std::vector<Extent> extent_;
};

}  // namespace dmp::detail
