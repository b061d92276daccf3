#include "safety/safety_step.hpp"

#include <algorithm>
#include <cmath>

#include "safety/approach.hpp"
#include "safety/turn_limits.hpp"

namespace dmp::detail {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// A little less than the limit, so that rounding does not exceed it.
double within(double limit) noexcept { return limit * (1.0 - 1e-12); }

double entry(const VectorXd& values, Index axis, double otherwise) {
  return values.size() > 0 ? values[axis] : otherwise;
}

std::vector<AxisLimits> axis_limits(const SafetyLimits& limits) {
  const Index axes = std::max(
      {limits.lower.size(), limits.upper.size(), limits.velocity.size(), limits.acceleration.size()});
  std::vector<AxisLimits> all(static_cast<std::size_t>(axes));
  for (Index axis = 0; axis < axes; ++axis) {
    const double lower = entry(limits.lower, axis, -AxisLimits::kNone);
    const double upper = entry(limits.upper, axis, AxisLimits::kNone);
    all[static_cast<std::size_t>(axis)] = {
        std::isinf(lower) ? lower : lower + 1e-12 * (1.0 + std::abs(lower)),
        std::isinf(upper) ? upper : upper - 1e-12 * (1.0 + std::abs(upper)),
        within(entry(limits.velocity, axis, AxisLimits::kNone)),
        within(entry(limits.acceleration, axis, AxisLimits::kNone))};
  }
  return all;
}

/// The axis as it goes on with an acceleration that is held.
void hold(const AxesStep& step, Index axis, double acceleration, double dt) noexcept {
  step.next_position[axis] = step.position[axis] + dt * (step.velocity[axis] + 0.5 * dt * acceleration);
  step.next_velocity[axis] = step.velocity[axis] + dt * acceleration;
  step.next_acceleration[axis] = acceleration;
}

bool is_kept(const AxisLimits& limits, const Interval& viable, const AxesStep& step, Index axis,
             double wanted, double longest) noexcept {
  return wanted >= viable.low && wanted <= viable.high &&
         std::abs(step.next_acceleration[axis]) <= limits.acceleration &&
         can_stop(limits, step.next_position[axis], step.next_velocity[axis], longest);
}

}  // namespace

SafetyStep::SafetyStep(const SafetyLimits& limits, int obstacles, const SafetyOptions& options)
    : given_(limits),
      options_(options),
      axes_(axis_limits(limits)),
      obstacles_(static_cast<std::size_t>(obstacles)) {}

bool SafetyStep::fits(Index axes, Index place) const noexcept {
  return (axes_.empty() || static_cast<Index>(axes_.size()) == axes) &&
         (count == 0 || (place > 0 && place <= 3));
}

double SafetyStep::pieces(double dt, double duration) const noexcept {
  constexpr double kFarthest = 0.005;  // of the duration
  return std::max(1.0, std::ceil(std::max(dt / options_.largest_step, dt / (kFarthest * duration)) - 1e-6));
}

void SafetyStep::begin_call() noexcept {
  changed_ = false;
  blocked_ = false;
}

void SafetyStep::begin(double dt, double duration) noexcept {
  dt_ = dt;
  duration_ = duration;
  places_ = 0;
  blocked_ = false;
}

void SafetyStep::end() noexcept {
  if (count == 0) return;
  for (std::optional<Obstacle>& obstacle : obstacles_)
    if (obstacle) move_on(*obstacle, dt_);
}

const AxisLimits& SafetyStep::limit(Index axis) const noexcept {
  return axes_.empty() ? free_ : axes_[static_cast<std::size_t>(axis)];
}

bool SafetyStep::keep(Index first, bool place, const AxesStep& step) noexcept {
  bool changed = false;
  if (place && count > 0) {
    changed = keep_place(first, step);
  } else if (!axes_.empty()) {
    for (Index axis = 0; axis < step.axes; ++axis) changed |= keep_axis(limit(first + axis), step, axis);
  }
  changed_ |= changed;
  return changed;
}

bool SafetyStep::keep(const TurnStep& step) noexcept {
  const bool changed =
      keep_turn({within(given_.angular_velocity), within(given_.angular_acceleration)}, step, dt_);
  changed_ |= changed;
  return changed;
}

bool SafetyStep::keep_axis(const AxisLimits& limits, const AxesStep& step, Index axis) noexcept {
  const double longest = options_.largest_step;
  const Interval allowed = viable(limits, step.position[axis], step.velocity[axis], dt_, longest);
  const double wanted = (step.next_velocity[axis] - step.velocity[axis]) / dt_;
  if (is_kept(limits, allowed, step, axis, wanted, longest)) return false;
  hold(step, axis, allowed.clamp(wanted), dt_);
  return true;
}

}  // namespace dmp::detail
