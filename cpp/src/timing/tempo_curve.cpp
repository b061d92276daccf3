#include "timing/tempo_curve.hpp"

#include <algorithm>
#include <cmath>

namespace dmp::detail {
namespace {

constexpr double knot_spacing = 0.02;  // s; a tempo that changes within less would be a jerk of its own
constexpr double most_knots = 1e5;

}  // namespace

TempoCurve::TempoCurve(double begin, double end, double rate) : begin_(begin) {
  const double intervals = std::clamp(std::ceil((end - begin) / knot_spacing), 1.0, most_knots);
  spacing_ = (end - begin) / intervals;
  most_step_ = rate * spacing_;
  coefficients_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(intervals) + 3);
}

TempoCurve::Place TempoCurve::place(double t) const {
  const double at = std::max((t - begin_) / spacing_, 0.0);
  const Eigen::Index first = std::min(static_cast<Eigen::Index>(at), coefficients_.size() - 4);
  return {first, std::min(at - static_cast<double>(first), 1.0)};
}

double TempoCurve::value(double t) const {
  const auto [i, u] = place(t);
  const double v = 1.0 - u;
  return (v * v * v * coefficients_[i] + (3.0 * u * u * u - 6.0 * u * u + 4.0) * coefficients_[i + 1] +
          (3.0 * v * v * v - 6.0 * v * v + 4.0) * coefficients_[i + 2] + u * u * u * coefficients_[i + 3]) /
         6.0;
}

double TempoCurve::slope(double t) const {
  const auto [i, u] = place(t);
  const double v = 1.0 - u;
  return (v * v * (coefficients_[i + 1] - coefficients_[i]) +
          (1.0 + 2.0 * u * v) * (coefficients_[i + 2] - coefficients_[i + 1]) +
          u * u * (coefficients_[i + 3] - coefficients_[i + 2])) /
         (2.0 * spacing_);
}

double TempoCurve::time_between(double a, double b) const {
  return (b - a) * (std::exp(value(a)) + 4.0 * std::exp(value(0.5 * (a + b))) + std::exp(value(b))) / 6.0;
}

// The two coefficients in the middle carry most of the value; where that is not enough, the next round asks
// for more.
void TempoCurve::raise(double t, double least) {
  const Eigen::Index i = place(t).first;
  for (const Eigen::Index k : {i + 1, i + 2}) coefficients_[k] = std::max(coefficients_[k], least);
}

void TempoCurve::settle() {
  const Eigen::Index last = coefficients_.size() - 1;
  for (Eigen::Index k = 1; k <= last; ++k)
    coefficients_[k] = std::max(coefficients_[k], coefficients_[k - 1] - most_step_);
  for (Eigen::Index k = last - 1; k >= 0; --k)
    coefficients_[k] = std::max(coefficients_[k], coefficients_[k + 1] - most_step_);
}

}  // namespace dmp::detail
