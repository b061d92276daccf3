#pragma once

#include "base/random.hpp"
#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// Seeded numbers for searches.
class Random : public SplitMix {
 public:
  using SplitMix::SplitMix;

  /// Each joint uniformly between lower and upper.
  Joints between(const Joints& lower, const Joints& upper) {
    Joints q(lower.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = lower[i] + (upper[i] - lower[i]) * uniform();
    return q;
  }
};

}  // namespace dmp::detail
