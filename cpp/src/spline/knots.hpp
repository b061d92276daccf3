#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace dmp::detail {

/// The knots of a spline, increasing, degree + 1 of them at either end, with what every evaluation divides
/// by.
class Knots {
 public:
  Knots(std::vector<double> at, int degree) : at_(std::move(at)), degree_(degree) {
    for (int width = 1; width <= degree; ++width) {
      std::vector<double>& inverse = inverse_[static_cast<std::size_t>(width - 1)];
      inverse.resize(at_.size() - static_cast<std::size_t>(width));
      for (std::size_t i = 0; i < inverse.size(); ++i)
        inverse[i] = 1.0 / (at_[i + static_cast<std::size_t>(width)] - at_[i]);
    }
  }

  int degree() const noexcept { return degree_; }
  /// How many B-splines there are on them.
  Eigen::Index count() const noexcept { return static_cast<Eigen::Index>(at_.size()) - degree_ - 1; }
  double operator[](Eigen::Index i) const noexcept { return at_[static_cast<std::size_t>(i)]; }
  const double* data() const noexcept { return at_.data(); }
  /// 1 / (knot[i + width] - knot[i]) for all i, width 1 to the degree; infinite where they coincide.
  const double* inverse_spans(int width) const noexcept {
    return inverse_[static_cast<std::size_t>(width - 1)].data();
  }
  double inverse_span(int width, Eigen::Index i) const noexcept { return inverse_spans(width)[i]; }

  /// The interval that holds a time, outside them the first or the last. `near` is where to look first: times
  /// that increase find theirs there or next to it.
  Eigen::Index interval(double time, Eigen::Index near = 0) const noexcept {
    const Eigen::Index first = degree_;
    const Eigen::Index last = count() - 1;
    Eigen::Index at = std::clamp(near, first, last);
    for (int tries = 0; tries < 3; ++tries, ++at)
      if ((at == first || time >= at_[static_cast<std::size_t>(at)]) &&
          (at == last || time < at_[static_cast<std::size_t>(at + 1)]))
        return at;
      else if (at == last)
        break;
    const auto above = std::upper_bound(at_.begin() + first, at_.end() - degree_ - 1, time);
    return std::clamp<Eigen::Index>(above - at_.begin() - 1, first, last);
  }

 private:
  std::vector<double> at_;
  int degree_;
  std::array<std::vector<double>, 5> inverse_;  // by width - 1
};

}  // namespace dmp::detail
