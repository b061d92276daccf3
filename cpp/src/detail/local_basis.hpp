#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

namespace dmp::detail {

/// The B-splines that are not zero at a time: of degree p and of the three degrees below, by Cox-de Boor's
/// recurrence (de Boor 1978, chapter X), which passes through the lower degrees on its way.
struct LocalBasis {
  std::array<std::array<double, 6>, 4> values{};  // [d]: degree p - d, p - d + 1 of them

  LocalBasis(const double* knots, Eigen::Index interval, int degree, double time) {
    std::array<double, 6> row{1.0};
    std::array<double, 6> left{};
    std::array<double, 6> right{};
    keep(row, degree, 0);
    for (int j = 1; j <= degree; ++j) {
      left[j] = time - knots[interval + 1 - j];
      right[j] = knots[interval + j] - time;
      double saved = 0.0;
      for (int r = 0; r < j; ++r) {
        const double term = row[r] / (right[r + 1] + left[j - r]);
        row[r] = saved + right[r + 1] * term;
        saved = left[j - r] * term;
      }
      row[j] = saved;
      keep(row, degree, j);
    }
  }

 private:
  void keep(const std::array<double, 6>& row, int degree, int reached) {
    if (degree - reached < 4) values[degree - reached] = row;
  }
};

/// The interval of the knots that holds a time; outside them the first or the last.
inline Eigen::Index interval_of(const std::vector<double>& knots, int degree, double time) noexcept {
  const auto first = knots.begin() + degree;
  const auto last = knots.end() - degree - 1;
  const auto above = std::upper_bound(first, last, time);
  return std::clamp<Eigen::Index>(above - knots.begin() - 1, degree,
                                  static_cast<Eigen::Index>(knots.size()) - degree - 2);
}

}  // namespace dmp::detail
