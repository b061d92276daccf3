#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "spline/knots.hpp"

namespace dmp::detail {

/// The B-splines that are not zero at a time: of degree p and of the three degrees below, by Cox-de Boor's
/// recurrence (de Boor 1978, chapter X), which passes through the lower degrees on its way.
struct LocalBasis {
  std::array<std::array<double, 6>, 4> values;  // [d]: degree p - d, p - d + 1 of them; the rest undefined

  LocalBasis(const Knots& knots, Eigen::Index interval, double time) {
    std::array<double, 6> row;
    row[0] = 1.0;
    keep<0>(row, knots.degree());
    raise<1>(row, knots, interval, time);
  }

 private:
  /// From degree J - 1 to J and on; J is known when this is compiled so that the loop unrolls.
  template <int J>
  void raise(std::array<double, 6>& row, const Knots& knots, Eigen::Index interval, double time) {
    if (J > knots.degree()) return;
    const double* const knot = knots.data() + (interval + 1 - J);
    const double* const inverse_span = knots.inverse_spans(J) + (interval + 1 - J);
    double saved = 0.0;
    for (int r = 0; r < J; ++r) {
      const double term = row[r] * inverse_span[r];
      row[r] = saved + (knot[r + J] - time) * term;
      saved = (time - knot[r]) * term;
    }
    row[J] = saved;
    keep<J>(row, knots.degree());
    if constexpr (J < 5) raise<J + 1>(row, knots, interval, time);
  }
  template <int Reached>
  void keep(const std::array<double, 6>& row, int degree) {
    if (degree - Reached >= 4) return;
    for (int j = 0; j <= Reached; ++j) values[degree - Reached][j] = row[j];
  }
};

}  // namespace dmp::detail
