#pragma once

#include <dmp/export.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <vector>

namespace dmp {

/// What a smoothing spline took out of its samples.
struct Smoothing {
  Eigen::VectorXd
      noise;  ///< (d) standard deviation found in the data, in their unit; 0 if nothing was smoothed
  Eigen::VectorXd removed;  ///< (d) root of the mean square of sample - spline
};

/// The interpolating quintic B-spline through samples on any increasing time grid (not-a-knot ends; de Boor
/// 1978, "A Practical Guide to Splines", chapters IX and XIII): four times continuously differentiable. With
/// fewer than six samples it is the polynomial through them.
class DMP_EXPORT Spline {
 public:
  /// times (T) strictly increasing, values (T x d), T >= 2. Throws InvalidArgument for other sizes or times.
  Spline(const Eigen::VectorXd& times, const RowMatrix& values);

  /// The quintic spline that weighs closeness to the samples against the integral of its squared third
  /// derivative, by generalised cross-validation over all columns together (Craven and Wahba 1979): the noise
  /// is found in the data. With fewer than ten samples it is the interpolating one.
  static Spline smoothing(const Eigen::VectorXd& times, const RowMatrix& values, Smoothing* report = nullptr);

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

  Spline(std::vector<double> knots, RowMatrix coefficients);
  Eigen::Index interval(double time) const noexcept;
  void interpolate(const Eigen::VectorXd& times, const RowMatrix& values);
  void differentiate();

  int degree_;
  std::vector<double> knots_;
  RowMatrix
      coefficients_[3];  // of the spline and its first two derivatives, on the knots of degree, degree-1, ..
};

}  // namespace dmp
