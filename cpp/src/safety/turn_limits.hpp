#pragma once

#include "safety/safety_step.hpp"

namespace dmp::detail {

/// Limits of the norm of an angular velocity (rad/s) and acceleration (rad/s^2).
struct TurnLimits {
  double velocity;
  double acceleration;
};

/// The acceleration nearest to `wanted` that keeps both limits over a step of dt from `velocity`.
Eigen::Vector3d nearest_turn(const TurnLimits& limits, const Eigen::Vector3d& velocity,
                             const Eigen::Vector3d& wanted, double dt) noexcept;
/// Changes the step so that it keeps them; whether it had to.
bool keep_turn(const TurnLimits& limits, const TurnStep& step, double dt) noexcept;

}  // namespace dmp::detail
