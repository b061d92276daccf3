#pragma once

#include <dmp/joint_trajectory.hpp>

namespace dmp::detail {

/// Fills in velocity and acceleration from time and position: the derivatives, at the samples, of the cubic
/// spline through the positions with continuous second derivative (de Boor, A Practical Guide to Splines,
/// ch. IV). With not-a-knot ends three samples give a parabola, two a line; one stands still.
void differentiate(JointTrajectory& joints, SplineEnds ends);

}  // namespace dmp::detail
