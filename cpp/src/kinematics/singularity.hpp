#pragma once

#include "kinematics/pose_goal.hpp"

namespace dmp::detail {

/// Whether most of the error points where the arm, at these joints, cannot go: along directions that have
/// singular values below 1 mm per rad, although the arm has joints enough for them elsewhere. Takes no
/// memory.
bool is_singular(const PoseGoal& goal, const Frame& target, const Jacobian& jacobian, const Vector6& error);

}  // namespace dmp::detail
