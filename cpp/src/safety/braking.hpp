#pragma once

#include <dmp/obstacle.hpp>

#include <Eigen/Core>
#include <array>

#include "safety/axis_limits.hpp"

namespace dmp::detail {

using PlaceLimits = std::array<AxisLimits, 3>;

/// A stop along the straight line in which a point moves, as hard as the limits allow: what the filter falls
/// back on.
class Braking {
 public:
  /// In steps of at most `longest` seconds.
  Braking(const PlaceLimits& limits, const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
          double longest) noexcept;

  double way() const noexcept { return way_; }
  /// The acceleration of its first step, of dt seconds.
  Eigen::Vector3d acceleration(double dt) const noexcept;
  bool ends_within(const PlaceLimits& limits) const noexcept;
  /// Whether it keeps more than `keep` from an obstacle that stands still: proven by going ahead only as far
  /// as the distance found allows (conservative advancement; Mirtich 1996).
  bool clears(const Obstacle& obstacle, double keep) const noexcept;

 private:
  Eigen::Vector3d position_;
  Eigen::Vector3d direction_;
  double speed_;
  double deceleration_;
  double way_;
};

}  // namespace dmp::detail
