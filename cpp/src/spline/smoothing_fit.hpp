#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "spline/band_cholesky.hpp"
#include "spline/knots.hpp"

namespace dmp::detail {

/// The normal equations of a quintic smoothing spline on one set of knots: it minimises
/// sum w_k |y_k - B_k c|^2 + lambda int (third derivative)^2. All matrices are bands of half width 5, so the
/// cost grows with the samples only.
class SmoothingKnots {
 public:
  /// A knot at every `every`-th sample.
  SmoothingKnots(const Eigen::VectorXd& times, const Eigen::VectorXd& weights, Eigen::Index every);

  const std::shared_ptr<const Knots>& knots() const noexcept { return knots_; }
  /// B^T W y.
  RowMatrix projected(const RowMatrix& values) const;
  /// y^T W y - 2 c^T B^T W y + c^T B^T W B c, summed over the columns.
  double residual(const RowMatrix& coefficients, const RowMatrix& projected, double squares) const;

  struct Factor {
    BandCholesky cholesky;
    double freedom;  // trace of the smoother: the degrees of freedom of the fit
  };
  /// At a lambda; kept for other values at the same times, unless that takes too much memory. Valid until the
  /// next call.
  const Factor& factor(double lambda);

 private:
  static constexpr int kDegree = 5;
  using Local = std::array<double, kDegree + 1>;

  void add_samples(const Eigen::VectorXd& times);
  void add_roughness();
  using Differences = std::array<Local, 3>;
  Differences third_differences(Eigen::Index interval) const;

  Eigen::VectorXd weights_;
  std::shared_ptr<const Knots> knots_;
  std::vector<Eigen::Index> interval_;  // of each sample
  std::vector<Local> row_;              // B-splines at each sample
  Band gram_;
  Band roughness_;
  std::map<double, Factor> factors_;
};

/// What smoothing splines at the same times share: knots as many as each stiffness needs, factors.
class SmoothingGrid {
 public:
  /// times (T) s, strictly increasing, T >= 10; weights (T): 1 for a sample that was measured, 0 for one that
  /// was not.
  SmoothingGrid(const Eigen::VectorXd& times, const Eigen::VectorXd& weights);

  const Eigen::VectorXd& times() const noexcept { return times_; }
  const Eigen::VectorXd& weights() const noexcept { return weights_; }
  double measured() const noexcept { return measured_; }  ///< how many
  double step() const noexcept { return step_; }          ///< s, mean time between two measured samples
  /// The lambda at which half the power of a vibration at the Nyquist frequency is left.
  double unit() const noexcept { return unit_; }
  /// Valid until the next call.
  SmoothingKnots& knots_for(double lambda);
  Eigen::Index level_for(double lambda) const;

 private:
  Eigen::VectorXd times_;
  Eigen::VectorXd weights_;
  double measured_;
  double step_;
  double unit_;
  std::map<Eigen::Index, SmoothingKnots> levels_;  // by samples per knot
};

/// Smoothing splines of one table of values, at any stiffness.
class SmoothingFit {
 public:
  /// values (T x d) at the times of the grid, which must outlive this.
  SmoothingFit(SmoothingGrid& grid, const RowMatrix& values);

  struct Point {
    double lambda;
    double freedom;   ///< of the fit, of as many as samples were measured
    double residual;  ///< sum of squares over the measured samples and all columns
  };
  Point at(double lambda);
  /// The variance per column that the residual estimates: RSS / (n - freedom).
  double variance(const Point& point) const { return point.residual / (grid_.measured() - point.freedom); }
  /// The lambda of the least score of generalised cross-validation (Craven and Wahba 1979).
  Point best();
  /// The lambda whose fit has `share` of the degrees of freedom of the samples.
  Point with_freedom(double share);
  /// The lambda at which half the power of a vibration of this frequency (Hz) is left, and the inverse.
  double lambda_of(double frequency) const;
  double frequency_of(double lambda) const;

  struct Curve {
    std::shared_ptr<const Knots> knots;
    RowMatrix coefficients;
  };
  Curve curve(double lambda);
  const SmoothingGrid& grid() const noexcept { return grid_; }

 private:
  const std::vector<Point>& scan();
  double score(const Point& point) const;
  const RowMatrix& projected(double lambda);

  SmoothingGrid& grid_;
  RowMatrix values_;  // less their mean, for the digits of the residual
  Eigen::RowVectorXd mean_;
  double squares_;
  std::map<Eigen::Index, RowMatrix> projected_;
  std::vector<Point> scanned_;
};

}  // namespace dmp::detail
