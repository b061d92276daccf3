// The filter of a point among obstacles.

#include <algorithm>
#include <cmath>

#include "safety/approach.hpp"
#include "safety/safety_step.hpp"

namespace dmp::detail {

using Eigen::Index;
using Eigen::Vector3d;

/// A point of up to three axes over a step; axes that there are not do not move.
struct SafetyStep::Place {
  Vector3d position = Vector3d::Zero();
  Vector3d velocity = Vector3d::Zero();
  Vector3d goal = Vector3d::Zero();
  Vector3d next_position = Vector3d::Zero();
  Vector3d next_velocity = Vector3d::Zero();
  Vector3d next_acceleration = Vector3d::Zero();
  Vector3d wanted = Vector3d::Zero();  ///< the acceleration that leads there
  PlaceLimits limits{};
  std::array<Interval, 3> box{Interval{0.0, 0.0}, Interval{0.0, 0.0}, Interval{0.0, 0.0}};

  Vector3d position_with(const Vector3d& acceleration, double dt) const noexcept {
    return position + dt * (velocity + 0.5 * dt * acceleration);
  }
};

namespace {

/// The row that one obstacle makes: n . x >= bound.
struct Row {
  Vector3d normal;
  double bound;
  double height;   ///< h, the distance less what is kept
  double closing;  ///< -h'
  bool passable;   ///< the goal lies outside: there is a way around it
};

/// The hardest deceleration along a direction.
double deceleration(const PlaceLimits& limits, const Vector3d& direction) noexcept {
  double most = AxisLimits::kNone;
  for (int axis = 0; axis < 3; ++axis) {
    const double share = std::abs(direction[axis]);
    if (share > 1e-9) most = std::min(most, limits[static_cast<std::size_t>(axis)].acceleration / share);
  }
  return most;
}

/// A push along the surface, in the direction in which the point moves, or any. Its size is what the row
/// misses, less as the point gains speed: all that is missed would bring it to missing * duration / 15.
Vector3d along(const Row& row, const Vector3d& velocity, double missing, double duration) noexcept {
  const double most = 300.0 / (duration * duration);
  const double push = std::min(missing, most);
  const Vector3d tangential = velocity - row.normal.dot(velocity) * row.normal;
  const double speed = tangential.norm();
  const double left = std::max(0.0, push - 15.0 * speed / duration);
  if (speed > 1e-3 * velocity.norm() && speed > 0.0) return left / speed * tangential;
  Index least = 0;
  row.normal.cwiseAbs().minCoeff(&least);
  return left * row.normal.cross(Vector3d::Unit(least)).normalized();
}

/// The nearest rows, no more than a HalfSpaces takes.
class Rows {
 public:
  void add(const Row& row) noexcept {
    if (count_ < HalfSpaces::kMost) {
      rows_[static_cast<std::size_t>(count_++)] = row;
      return;
    }
    const auto farthest = std::max_element(rows_.begin(), rows_.end(),
                                           [](const Row& a, const Row& b) { return a.height < b.height; });
    if (row.height < farthest->height) *farthest = row;
  }
  const Row* begin() const noexcept { return rows_.data(); }
  const Row* end() const noexcept { return rows_.data() + count_; }

 private:
  std::array<Row, HalfSpaces::kMost> rows_;
  int count_ = 0;
};

}  // namespace

/// The barriers of all obstacles, and, where one stands in the way, what is wanted instead: a way along it.
HalfSpaces SafetyStep::half_spaces(const Place& place, Vector3d& wanted) const noexcept {
  const double kept = options_.margin + options_.radius + error;
  Rows rows;
  for (const std::optional<Obstacle>& obstacle : obstacles_) {
    if (!obstacle) continue;
    const Approach seen = approach(*obstacle, place.position, place.velocity);
    const double speed = (place.velocity - velocity_of(*obstacle)).norm();
    double rate = options_.gain / duration_;
    if (speed > 0.0) rate = std::min(rate, deceleration(place.limits, seen.near.normal) / speed);
    const double height = seen.near.distance - kept;
    const bool passable = nearness(*obstacle, place.goal).distance > kept;
    rows.add({seen.near.normal, 2.0 * rate * seen.closing - seen.bend - rate * rate * height, height,
              seen.closing, passable});
  }
  HalfSpaces spaces(place.box);
  for (const Row& row : rows) {
    spaces.add(row.normal, row.bound);
    const double missing = row.bound - row.normal.dot(place.wanted);
    if (options_.slide && row.passable && row.closing > 0.0 && missing > 0.0)
      wanted += along(row, place.velocity, missing, duration_);
  }
  return spaces;
}

/// Whether a point is nearer to something that stands still than it can come unless it began so.
bool SafetyStep::is_within_reserve(const Vector3d& position) const noexcept {
  const double kept = 0.5 * options_.margin + options_.radius + error;
  return std::any_of(obstacles_.begin(), obstacles_.end(), [&](const std::optional<Obstacle>& obstacle) {
    return obstacle && velocity_of(*obstacle).isZero(0.0) && nearness(*obstacle, position).distance < kept;
  });
}

/// Whether a point can brake from here along a straight line and touch nothing that stands still.
bool SafetyStep::is_safe(const Place& place, const Vector3d& position,
                         const Vector3d& velocity) const noexcept {
  const double kept = 0.5 * options_.margin + options_.radius + error;
  const Braking braking(place.limits, position, velocity, options_.largest_step);
  if (!braking.ends_within(place.limits)) return false;
  return std::all_of(obstacles_.begin(), obstacles_.end(), [&](const std::optional<Obstacle>& obstacle) {
    return !obstacle || !velocity_of(*obstacle).isZero(0.0) || braking.clears(*obstacle, kept);
  });
}

/// Whether the step can stay as it is.
bool SafetyStep::is_admitted(const Place& place, const HalfSpaces& spaces) const noexcept {
  if (!spaces.admits(place.wanted)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const AxisLimits& limits = place.limits[static_cast<std::size_t>(axis)];
    if (std::abs(place.next_acceleration[axis]) > limits.acceleration ||
        !can_stop(limits, place.next_position[axis], place.next_velocity[axis], options_.largest_step))
      return false;
  }
  return is_safe(place, place.next_position, place.next_velocity);
}

/// The acceleration instead: the nearest that keeps all, or the brake.
Vector3d SafetyStep::chosen(const Place& place, const HalfSpaces& spaces, const Vector3d& wanted) noexcept {
  const Vector3d nearest = spaces.nearest(wanted);
  const bool all_kept = spaces.admits(nearest, 1e-3 * (1.0 + nearest.cwiseAbs().maxCoeff()));
  if (!all_kept) blocked_ = true;
  if (is_safe(place, place.position_with(nearest, dt_), place.velocity + dt_ * nearest)) return nearest;
  if (is_within_reserve(place.position)) return nearest;  // it began there: away from the obstacle
  blocked_ = true;
  const Braking braking(place.limits, place.position, place.velocity, options_.largest_step);
  return spaces.clamped(braking.acceleration(dt_));
}

bool SafetyStep::keep_place(Index first, const AxesStep& step) noexcept {
  Place place;
  for (Index axis = 0; axis < step.axes; ++axis) {
    const AxisLimits& limits = limit(first + axis);
    place.limits[static_cast<std::size_t>(axis)] = limits;
    place.position[axis] = step.position[axis];
    place.velocity[axis] = step.velocity[axis];
    place.goal[axis] = step.goal[axis];
    place.next_position[axis] = step.next_position[axis];
    place.next_velocity[axis] = step.next_velocity[axis];
    place.next_acceleration[axis] = step.next_acceleration[axis];
    place.box[static_cast<std::size_t>(axis)] =
        viable(limits, step.position[axis], step.velocity[axis], dt_, options_.largest_step);
  }
  place.wanted = (place.next_velocity - place.velocity) / dt_;
  Vector3d wanted = place.wanted;
  const HalfSpaces spaces = half_spaces(place, wanted);
  if (is_admitted(place, spaces)) {
    look_around(place.next_position);
    return false;
  }
  const Vector3d chosen = this->chosen(place, spaces, wanted);
  place.next_position = place.position_with(chosen, dt_);
  place.next_velocity = place.velocity + dt_ * chosen;
  for (Index axis = 0; axis < step.axes; ++axis) {
    step.next_position[axis] = place.next_position[axis];
    step.next_velocity[axis] = place.next_velocity[axis];
    step.next_acceleration[axis] = chosen[axis];
  }
  // It stands, and something keeps it from where it would go.
  const double per_phase = duration_ * duration_;
  if (duration_ * place.next_velocity.norm() < 0.01 && per_phase * chosen.norm() < 1.0 &&
      per_phase * (place.wanted - chosen).norm() > 1.0)
    blocked_ = true;
  look_around(place.next_position);
  return true;
}

void SafetyStep::look_around(const Vector3d& position) noexcept {
  for (const std::optional<Obstacle>& obstacle : obstacles_) {
    if (!obstacle) continue;
    const Vector3d then = position - dt_ * velocity_of(*obstacle);
    clearance_ = std::min(clearance_, nearness(*obstacle, then).distance - options_.radius);
  }
}

}  // namespace dmp::detail
