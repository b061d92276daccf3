// The filter of a point among obstacles.

#include <algorithm>
#include <cmath>
#include <utility>

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
  double room = AxisLimits::kNone;  ///< from where it is to what stands still
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
  double height;    ///< h, the distance less what is kept
  bool in_the_way;  ///< it comes no farther away, and the goal lies outside: there is a way around it
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

/// What a row leaves missing: how far the wanted acceleration is from keeping it.
struct Missing {
  double size = 0.0;
  Vector3d normal = Vector3d::Zero();
};

/// The direction along one surface, or the crease of two, in which a point moves, or any.
Vector3d along(const Missing& deepest, const Missing& second, const Vector3d& velocity) noexcept {
  constexpr double kParallel = 0.05;
  constexpr double kHardly = 1e-3;
  const Vector3d crease = deepest.normal.cross(second.normal);
  if (crease.norm() > kParallel) return crease.normalized() * (crease.dot(velocity) < 0.0 ? -1.0 : 1.0);
  const Vector3d tangential = velocity - deepest.normal.dot(velocity) * deepest.normal;
  const double speed = tangential.norm();
  if (speed > kHardly * velocity.norm() && speed > 0.0) return tangential / speed;
  Index least = 0;
  deepest.normal.cwiseAbs().minCoeff(&least);
  return deepest.normal.cross(Vector3d::Unit(least)).normalized();
}

/// A push along what stands in the way, as large as what is missing, less as the point gains speed: all of it
/// would bring it to missing * duration / 15.
Vector3d push(const Missing& deepest, const Missing& second, const Vector3d& velocity,
              double duration) noexcept {
  const double most = 300.0 / (duration * duration);
  const Vector3d direction = along(deepest, second, velocity);
  const double speed = std::max(0.0, direction.dot(velocity));
  return std::max(0.0, std::min(deepest.size + second.size, most) - 15.0 * speed / duration) * direction;
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
HalfSpaces SafetyStep::half_spaces(Place& place, Vector3d& wanted) const noexcept {
  const double kept = options_.margin + options_.radius + error;
  constexpr double kComesNearer = -1e-6;  // m/s
  Rows rows;
  for (const std::optional<Obstacle>& obstacle : obstacles_) {
    if (!obstacle) continue;
    const Approach seen = approach(*obstacle, place.position, place.velocity);
    const Vector3d& moving = velocity_of(*obstacle);
    const double speed = (place.velocity - moving).norm();
    if (moving.isZero(0.0)) place.room = std::min(place.room, seen.near.distance);
    double rate = options_.gain / duration_;
    if (speed > 0.0) rate = std::min(rate, deceleration(place.limits, seen.near.normal) / speed);
    const double height = seen.near.distance - kept;
    const double bound = 2.0 * rate * seen.closing - seen.bend - rate * rate * height;
    const bool in_the_way = seen.closing > kComesNearer && bound > seen.near.normal.dot(place.wanted) &&
                            nearness(*obstacle, place.goal).distance > kept;
    rows.add({seen.near.normal, bound, height, in_the_way});
  }
  HalfSpaces spaces(place.box);
  Missing deepest, second;
  for (const Row& row : rows) {
    spaces.add(row.normal, row.bound);
    if (!row.in_the_way) continue;
    Missing missing{row.bound - row.normal.dot(place.wanted), row.normal};
    if (missing.size > deepest.size) std::swap(missing, deepest);
    if (missing.size > second.size) second = missing;
  }
  if (options_.slide && deepest.size > 0.0) wanted += push(deepest, second, place.velocity, duration_);
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
  if (place.room - (position - place.position).norm() - braking.way() > kept) return true;
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
    remember(place.next_position);
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
  remember(place.next_position);
  return true;
}

void SafetyStep::remember(const Vector3d& position) noexcept {
  if (places_ < kPlaces) place_[static_cast<std::size_t>(places_++)] = position;
}

double SafetyStep::clearance() const noexcept {
  double least = AxisLimits::kNone;
  for (const std::optional<Obstacle>& obstacle : obstacles_)
    for (int k = 0; obstacle && k < places_; ++k)
      least = std::min(least,
                       nearness(*obstacle, place_[static_cast<std::size_t>(k)]).distance - options_.radius);
  return least;
}

}  // namespace dmp::detail
