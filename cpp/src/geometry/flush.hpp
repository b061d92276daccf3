#pragma once

namespace dmp::detail {

/// What decays for ever counts as zero long before it turns denormal: arithmetic on denormal numbers costs a
/// hundred times more than on others. Products with speeds and gains stay normal too. The sum rounds to
/// multiples of 1e-200: what is less is lost, what is more than 1e-168 is not changed. For numbers and arrays
/// of them.
template <class Value>
inline Value flushed(const Value& value) noexcept {
  constexpr double kSmall = 1e-184;
  return (value + kSmall) - kSmall;
}

}  // namespace dmp::detail
