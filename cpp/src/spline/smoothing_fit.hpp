#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "spline/knots.hpp"

namespace dmp::detail {

/// The coefficients of a quintic smoothing spline: minimises |y - B c|^2 + lambda int (third derivative)^2,
/// lambda by generalised cross-validation. All matrices are bands of half width 5, so the cost grows with the
/// samples only.
class SmoothingFit {
 public:
  /// times (T) s, strictly increasing, T >= 10.
  explicit SmoothingFit(const Eigen::VectorXd& times);

  const Knots& knots() const noexcept { return knots_; }
  /// values (T x d) -> coefficients (basis functions x d), with the lambda that suits all columns best.
  RowMatrix solve(const RowMatrix& values);
  /// Degrees of freedom that the last solution leaves to the noise: T - trace of the smoother.
  double freedom() const noexcept { return freedom_; }

 private:
  static constexpr int kDegree = 5;
  using Band =
      Eigen::Matrix<double, Eigen::Dynamic, kDegree + 1, Eigen::RowMajor>;  // (i, k): element (i + k, i)
  using Local = std::array<double, kDegree + 1>;

  void add_samples(const Eigen::VectorXd& times);
  void add_roughness();
  /// The third derivatives of the six B-splines of an interval at a time.
  Local third_derivatives(Eigen::Index interval, double time) const;
  /// Generalised cross-validation at lambda; leaves the solution and its freedom behind.
  double score(double lambda, const RowMatrix& projected, const RowMatrix& values);
  RowMatrix evaluated(const RowMatrix& coefficients) const;

  Eigen::Index samples_;
  Knots knots_;
  std::vector<Eigen::Index> interval_;  // of each sample
  std::vector<Local> row_;              // B-splines at each sample
  Band gram_;
  Band roughness_;
  RowMatrix coefficients_;
  double freedom_ = 1.0;
};

}  // namespace dmp::detail
