#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>
#include <dmp/joint_trajectory.hpp>

#include <Eigen/Core>
#include <optional>

namespace dmp {

/// What a timing may not exceed, each of n values.
struct TimingLimits {
  Eigen::VectorXd velocity;               ///< rad/s or m/s, > 0; infinity for none
  Eigen::VectorXd acceleration;           ///< rad/s^2 or m/s^2, > 0 and finite
  std::optional<Eigen::VectorXd> effort;  ///< N m or N, > 0, infinity for none; absent: not looked at
};

/// The same joints at other times: from rest to rest, close to as fast as the limits allow at each point of
/// the path, instead of `stretched` by what the worst point asks for.
///
/// Reachability analysis on the samples (TOPP-RA: Pham and Pham, IEEE Trans. Robotics 34(3), 2018) gives each
/// sample its time; the C2 spline through them, at rest at both ends, is measured, the path slowed down where
/// it exceeds a limit, and what is left is stretched. So velocity and acceleration hold everywhere on the
/// spline that is returned, to rounding. Positions, and the report's errors with them, stay as they are; a
/// motion of fewer than three samples, or in which nothing moves, is returned as it came. Throws
/// InvalidArgument for limits of other sizes or signs, or for effort, which needs an arm.
DMP_EXPORT JointTrajectory time_optimal(const JointTrajectory& joints, const TimingLimits& limits);

/// The same with the effort that `arm` needs at each sample, by KDL's inverse dynamics (recursive
/// Newton-Euler with the URDF's inertias; joints beside the way from base to tip stand in the middle of
/// their range, friction is none). `gravity` [m/s^2] in the base frame. Throws InvalidArgument also if the
/// arm cannot even stand still at a sample.
DMP_EXPORT JointTrajectory time_optimal(const Arm& arm, const JointTrajectory& joints,
                                        const TimingLimits& limits,
                                        const Eigen::Vector3d& gravity = {0.0, 0.0, -9.81});

}  // namespace dmp
