#include "safety/braking.hpp"

#include <algorithm>
#include <cmath>

namespace dmp::detail {

using Eigen::Vector3d;

Braking::Braking(const PlaceLimits& limits, const Vector3d& position, const Vector3d& velocity,
                 double longest) noexcept
    : position_(position),
      direction_(Vector3d::Zero()),
      speed_(velocity.norm()),
      deceleration_(AxisLimits::kNone) {
  if (speed_ > 0.0) direction_ = velocity / speed_;
  for (int axis = 0; axis < 3; ++axis) {
    const double share = std::abs(direction_[axis]);
    if (share > 0.0)
      deceleration_ = std::min(deceleration_, limits[static_cast<std::size_t>(axis)].acceleration / share);
  }
  const bool at_once = deceleration_ == AxisLimits::kNone;
  way_ = at_once ? 0.5 * speed_ * longest
                 : 0.5 * speed_ * speed_ / deceleration_ + 0.125 * deceleration_ * longest * longest;
  if (speed_ == 0.0) way_ = 0.0;
}

Vector3d Braking::acceleration(double dt) const noexcept {
  return -std::min(deceleration_, speed_ / dt) * direction_;
}

bool Braking::ends_within(const PlaceLimits& limits) const noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const AxisLimits& limit = limits[static_cast<std::size_t>(axis)];
    const double end = position_[axis] + way_ * direction_[axis];
    if (end > limit.upper || end < limit.lower) return false;
  }
  return true;
}

bool Braking::clears(const Obstacle& obstacle, double keep) const noexcept {
  constexpr int kMostLooks = 32;
  constexpr double kLeast = 1e-6;  // m
  double gone = 0.0;
  for (int look = 0; look < kMostLooks; ++look) {
    const double room = nearness(obstacle, position_ + gone * direction_).distance - keep;
    if (room < kLeast) return false;
    gone += room;
    if (gone >= way_) return true;
  }
  return false;
}

}  // namespace dmp::detail
