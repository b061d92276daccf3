#pragma once

#include <dmp/demonstration.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// Demonstrations of one cycle: the last sample is where the first one is. Three of them one after another
/// show the one in the middle on a spline that goes round.

/// Throws InvalidArgument unless the cycle closes to 5 % of its extent (rotations: to 0.2 rad).
void require_closed(const Demonstration& cycle);
void require_closed(const OrientationDemonstration& cycle);

Demonstration three_of(const Demonstration& cycle);
OrientationDemonstration three_of(const OrientationDemonstration& cycle);

/// At `count` times evenly round the cycle, without the last one, which is the first again; times from 0.
Trajectory round_of(const Demonstration& cycle, Eigen::Index count);
OrientationTrajectory round_of(const OrientationDemonstration& cycle, Eigen::Index count);

}  // namespace dmp::detail
