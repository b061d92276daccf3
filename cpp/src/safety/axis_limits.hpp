#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmp::detail {

/// Limits of one axis; infinite where there is none.
struct AxisLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double lower = -kNone;
  double upper = kNone;
  double velocity = kNone;
  double acceleration = kNone;
};

struct Interval {
  double low;
  double high;
  double clamp(double value) const noexcept { return std::max(low, std::min(value, high)); }
};

/// The largest velocity w after a step of dt, from a velocity v and with `room` to the limit of the position,
/// so that a stop in steps of at most `longest` remains possible:
///   v dt/2 + w dt/2 + w^2/(2 a) + a longest^2/8 <= room;
/// the last term is the last step of braking, which is shorter than a whole one (after Del Prete 2018, IEEE
/// RA-L 3(1), "Joint position and velocity bounds in discrete-time acceleration/torque control of robot
/// arms").
inline double fastest_towards(double room, double v, double dt, double a, double longest) noexcept {
  if (room == AxisLimits::kNone) return AxisLimits::kNone;
  const double left = room - 0.5 * v * dt;
  if (a == AxisLimits::kNone) return left / dt;
  const double c = left - 0.125 * a * longest * longest;
  return a * (-0.5 * dt + std::sqrt(std::max(0.0, 0.25 * dt * dt + 2.0 * c / a)));
}

/// The accelerations that may be held over a step of dt. Where the limits cannot be kept any more (the motion
/// began beyond them) the interval is the one acceleration that leads back fastest.
inline Interval viable(const AxisLimits& limits, double y, double v, double dt, double longest) noexcept {
  const double a = limits.acceleration;
  const double up = fastest_towards(limits.upper - y, v, dt, a, longest);
  const double down = fastest_towards(y - limits.lower, -v, dt, a, longest);
  const double high = std::min({a, (limits.velocity - v) / dt, (up - v) / dt});
  const double low = std::max({-a, (-limits.velocity - v) / dt, (-down - v) / dt});
  // Their bounds may cross by rounding, or far, where a limit is exceeded already: never more than a then.
  return {std::min(low, a), std::max(std::min(low, a), std::max(high, -a))};
}

/// Whether a stop within the limits is possible from here.
inline bool can_stop(const AxisLimits& limits, double y, double v, double longest) noexcept {
  if (std::abs(v) > limits.velocity) return false;
  const double room = v > 0.0 ? limits.upper - y : y - limits.lower;
  const double reserve =
      limits.acceleration == AxisLimits::kNone
          ? std::abs(v) * longest
          : 0.5 * v * v / limits.acceleration + 0.125 * limits.acceleration * longest * longest;
  return y <= limits.upper && y >= limits.lower && (room == AxisLimits::kNone || reserve <= room);
}

}  // namespace dmp::detail
