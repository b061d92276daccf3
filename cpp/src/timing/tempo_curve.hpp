#pragma once

#include <Eigen/Core>

namespace dmp::detail {

/// The logarithm of a slowdown over time: l(t) >= 0, a uniform cubic B-spline whose slope is bounded.
///
/// The value lies between its four coefficients and the slope between their three differences over the
/// spacing, so what holds for the coefficients holds for the curve.
class TempoCurve {
 public:
  /// 0 from time `begin` to `end` [s]; `rate` [1/s] bounds the slope.
  TempoCurve(double begin, double end, double rate);

  double value(double t) const;
  double slope(double t) const;
  /// The integral of exp(l) from a to b, by Simpson's rule.
  double time_between(double a, double b) const;

  /// Asks for at least `least` near t: takes effect with settle().
  void raise(double t, double least);
  /// Takes the smallest coefficients that are as large as asked for and hold the slope.
  void settle();

 private:
  struct Place {
    Eigen::Index first;
    double u;
  };
  Place place(double t) const;

  double begin_, spacing_, most_step_;
  Eigen::VectorXd coefficients_;
};

}  // namespace dmp::detail
