#pragma once

#include <dmp/path_tracking.hpp>

namespace dmp::detail {

/// Fills in velocity and acceleration from time and position: the derivatives, at the samples, of the cubic
/// spline through the positions with continuous second derivative and not-a-knot ends (de Boor, A Practical
/// Guide to Splines, ch. IV). Three samples give a parabola, two a line, one stands still.
void differentiate(JointTrajectory& joints);

}  // namespace dmp::detail
