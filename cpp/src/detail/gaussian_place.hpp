#pragma once

#include <dmp/basis.hpp>

#include <algorithm>
#include <cmath>

namespace dmp {

// exp of less would be denormal, which costs a hundred times more than a normal number.
inline constexpr double kSmallestExponent = -700.0;

// x of less counts as zero, so that nothing it is multiplied with turns denormal.
inline constexpr double kLeastPhase = -400.0;

/// Among the kernels equal in time: the nearest one, how many lie within reach on either side, and how fast
/// they fall off. exp(-o (r - k)^2) = exp(-o r^2) exp(2 o r)^k exp(-o k^2) for the offset r from the nearest
/// kernel: the first factor is common to all, the last stands in a table.
struct GaussianBasis::Place {
  int middle;
  int below;
  int above;
  double offset;
  double up;  ///< exp(2 o r)
};

inline GaussianBasis::Place GaussianBasis::place(double s) const noexcept {
  const double u = s * (count_ - 1);
  const int middle = static_cast<int>(std::clamp(u + 0.5, 0.0, static_cast<double>(count_ - 1)));
  const double offset = u - middle;
  const double exponent = std::clamp(2.0 * overlap_ * offset, kSmallestExponent, -kSmallestExponent);
  return {middle, std::min(reach_, middle), std::min(reach_, count_ - 1 - middle), offset,
          std::exp(exponent)};
}

inline double GaussianBasis::x(double s) const noexcept {
  const double exponent = -alpha_x_ * s;
  return exponent > kLeastPhase ? std::exp(exponent) : 0.0;
}

}  // namespace dmp
