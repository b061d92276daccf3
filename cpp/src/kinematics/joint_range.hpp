#pragma once

#include <vector>

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// Where the joints of an arm may stand, and which of them come back to the same place after a full turn.
struct JointRange {
  explicit JointRange(const ChainModel& model);

  Joints lower, upper;
  std::vector<bool> turns;  ///< a turn by 2 pi leaves the tip where it is

  /// The middle of each range; for a joint without one, or as good as without, 0 if it may stand there.
  Joints middle() const;
  /// The distance from the nearest limit; infinity if no joint has one.
  double margin(const Joints& q) const;
  /// The windings of q that are nearest to `seed` in [lowest, highest].
  Joints nearest_winding(Joints q, const Joints& seed, const Joints& lowest, const Joints& highest) const;
  /// Shifts a whole path by the whole turns of each joint that leave the most room to its limits, or that
  /// bring it around middle() where it has none. Poses and steps stay.
  void wind_to_middle(std::vector<Joints>& path) const;
};

/// [lower, upper], or half a turn around `center` of it where it is infinite or as good as that.
struct FiniteRange {
  FiniteRange(const Joints& lower, const Joints& upper, const Joints& center);
  Joints lower, upper;
};

}  // namespace dmp::detail
