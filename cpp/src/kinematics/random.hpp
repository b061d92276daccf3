#pragma once

#include <cstdint>

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine, unlike the distributions of
/// <random>.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// In [0, 1).
  double uniform() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  }

  /// Each joint uniformly between lower and upper.
  Joints between(const Joints& lower, const Joints& upper) {
    Joints q(lower.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = lower[i] + (upper[i] - lower[i]) * uniform();
    return q;
  }

 private:
  std::uint64_t state_;
};

}  // namespace dmp::detail
