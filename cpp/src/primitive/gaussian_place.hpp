#pragma once

#include <dmp/basis.hpp>

#include <algorithm>
#include <cmath>

#include "geometry/exponential.hpp"

namespace dmp {

// exp of less would be denormal, which costs a hundred times more than a normal number.
inline constexpr double kSmallestExponent = -700.0;

// exp(-o k^2) of the next kernel and exp(2 o r) stay within what a double holds.
inline constexpr double kLargestOverlap = 300.0;
// x of less counts as zero, so that nothing it is multiplied with turns denormal.
inline constexpr double kLeastPhase = -400.0;

/// Among the kernels equal in time: the nearest one, and how many lie within reach on either side.
struct GaussianBasis::Place {
  int middle;
  int below;
  int above;
};

inline GaussianBasis::Place GaussianBasis::place(double s) const noexcept {
  const double u = s * (count_ - 1);
  // 0 for what is not a number, too: this is called in control loops.
  const int middle = u > 0.0 ? static_cast<int>(std::fmin(u + 0.5, count_ - 1.0)) : 0;
  return {middle, std::min(reach_, middle), std::min(reach_, count_ - 1 - middle)};
}

/// What belongs to two phases near one kernel, side by side.
struct GaussianBasis::PhasePair {
  Eigen::Array2d ratio;  ///< exp(2 o r): how fast the kernels fall off
  Eigen::Array2d x;      ///< exp(-alpha_x s)
};

/// Around the nearest kernel, at the offset r from it, exp(-o (r - k)^2) = exp(-o r^2) exp(2 o r)^k exp(-o
/// k^2): the first factor is common to all, the last stands in a table.
inline GaussianBasis::PhasePair GaussianBasis::pair(double s, double next, int middle) const noexcept {
  const double scale = 2.0 * overlap_;
  const double spacings = count_ - 1.0;
  Eigen::Array4d exponent(scale * (s * spacings - middle), scale * (next * spacings - middle), -alpha_x_ * s,
                          -alpha_x_ * next);
  exponent = exponent.max(kSmallestExponent).min(-kSmallestExponent);
  const Eigen::Array4d result = detail::exponential<4>(exponent);
  return {result.head<2>(),
          {-alpha_x_ * s > kLeastPhase ? result[2] : 0.0, -alpha_x_ * next > kLeastPhase ? result[3] : 0.0}};
}

}  // namespace dmp
