#include "safety/turn_limits.hpp"

#include <dmp/so3.hpp>

#include <cmath>

namespace dmp::detail {

using Eigen::Vector3d;

namespace {

struct Ball {
  Vector3d center;
  double radius;

  bool holds(const Vector3d& x) const noexcept {
    return std::isinf(radius) || (x - center).squaredNorm() <= radius * radius;
  }
  Vector3d nearest(const Vector3d& x) const noexcept {
    return holds(x) ? x : Vector3d(center + radius * (x - center).normalized());
  }
};

/// The point nearest to x on the circle in which two spheres cut.
Vector3d nearest_on_circle(const Ball& a, const Ball& b, const Vector3d& x) noexcept {
  const Vector3d line = b.center - a.center;
  const double distance = line.norm();
  const Vector3d axis = line / distance;
  const double along = 0.5 * (distance + (a.radius * a.radius - b.radius * b.radius) / distance);
  const double radius = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
  const Vector3d off = (x - a.center) - axis.dot(x - a.center) * axis;
  const double length = off.norm();
  const Vector3d side = length > 0.0 ? Vector3d(off / length) : axis.unitOrthogonal();
  return a.center + along * axis + radius * side;
}

}  // namespace

Vector3d nearest_turn(const TurnLimits& limits, const Vector3d& velocity, const Vector3d& wanted,
                      double dt) noexcept {
  const Ball hard{Vector3d::Zero(), limits.acceleration};
  const Ball fast{-velocity / dt, limits.velocity / dt};
  if (!fast.holds(Vector3d::Zero()) && !hard.holds(fast.nearest(Vector3d::Zero())))
    return hard.nearest(-velocity / dt);  // it began too fast: as hard as may be
  const Vector3d by_hard = hard.nearest(wanted);
  if (fast.holds(by_hard)) return by_hard;
  const Vector3d by_fast = fast.nearest(wanted);
  if (hard.holds(by_fast)) return by_fast;
  return nearest_on_circle(hard, fast, wanted);
}

bool keep_turn(const TurnLimits& limits, const TurnStep& step, double dt) noexcept {
  if (std::isinf(limits.velocity) && std::isinf(limits.acceleration)) return false;
  const Vector3d wanted = (step.next_velocity - step.velocity) / dt;
  if (step.next_velocity.norm() <= limits.velocity && wanted.norm() <= limits.acceleration &&
      step.next_acceleration.norm() <= limits.acceleration)
    return false;
  const Vector3d chosen = nearest_turn(limits, step.velocity, wanted, dt);
  step.next_rotation = so3::exp_quaternion(dt * (step.velocity + 0.5 * dt * chosen)) * step.rotation;
  step.next_velocity = step.velocity + dt * chosen;
  step.next_acceleration = chosen;
  return true;
}

}  // namespace dmp::detail
