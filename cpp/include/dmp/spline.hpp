#pragma once

#include <dmp/export.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <vector>

namespace dmp {

/// The interpolating quintic B-spline through samples on any increasing time grid (not-a-knot ends; de Boor
/// 1978, "A Practical Guide to Splines", chapters IX and XIII): four times continuously differentiable. With
/// fewer than six samples it is the polynomial through them.
class DMP_EXPORT Spline {
 public:
  /// times (T) strictly increasing, values (T x d), T >= 2. The caller has checked them.
  Spline(const Eigen::VectorXd& times, const RowMatrix& values);

  Eigen::Index dimension() const noexcept { return coefficients_[0].cols(); }

  /// Value, first and second derivative at each time (extrapolated by the end polynomial), each (times x d).
  struct Samples {
    RowMatrix value;
    RowMatrix first;
    RowMatrix second;
  };
  Samples sample(const Eigen::VectorXd& times) const;

 private:
  static constexpr int kDegree = 5;

  Eigen::Index interval(double time) const noexcept;
  void interpolate(const Eigen::VectorXd& times, const RowMatrix& values);
  void differentiate();

  int degree_;
  std::vector<double> knots_;
  RowMatrix
      coefficients_[3];  // of the spline and its first two derivatives, on the knots of degree, degree-1, ..
};

}  // namespace dmp
