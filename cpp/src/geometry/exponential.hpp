#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>

namespace dmp::detail {

/// exp, element by element, of an array whose size is known: side by side in registers, without branches,
/// calls or divisions, in fewer cycles from start to end than the C library takes for one, and the same bits
/// with every C library. Within 1 unit in the last place for |x| <= 700; beyond that, and for what is not a
/// number, undefined.
///
/// exp(x) = 2^n exp(r), n = round(x / ln 2), |r| <= ln 2 / 2 (Cody and Waite 1980, chapter 6);
/// exp(r) = 1 + r + r^2 q(r), q the minimax polynomial of degree 10, 2e-19 off.
template <int Size>
[[gnu::always_inline]] inline Eigen::Array<double, Size, 1> exponential(
    const Eigen::Array<double, Size, 1>& x) noexcept {
  using Array = Eigen::Array<double, Size, 1>;
  constexpr double kToInteger = 6755399441055744.0;  // 1.5 * 2^52: the sum's last bits are the integer
  const Array shifted = x * 1.4426950408889634 + kToInteger;
  const Array n = shifted - kToInteger;
  const Array r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;  // ln 2 in two parts
  const Array r2 = r * r;
  const Array r4 = r2 * r2;
  const Array low = (0.5 + r * 0.1666666666666667) + r2 * (0.04166666666666667 + r * 0.008333333333326136);
  const Array middle = (0.0013888888888883748 + r * 0.00019841269874820627) +
                       r2 * (2.4801587325547743e-05 + r * 2.7557255400206422e-06);
  const Array high = (2.75572736431103e-07 + r * 2.5105217004720745e-08) + r2 * 2.0914686968086876e-09;
  Array result = 1.0 + (r + r2 * (low + r4 * (middle + r4 * high)));

  std::array<std::uint64_t, Size> exponents;
  std::array<std::uint64_t, Size> bits;
  std::memcpy(exponents.data(), shifted.data(), sizeof(exponents));
  std::memcpy(bits.data(), result.data(), sizeof(bits));
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] += exponents[i] << 52;
  std::memcpy(result.data(), bits.data(), sizeof(bits));
  return result;
}

}  // namespace dmp::detail
