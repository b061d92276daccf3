#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>
#include <dmp/joint_trajectory.hpp>
#include <dmp/trajectory.hpp>

namespace dmp {

/// How the arm's tip moves with its joints: poses by KDL's forward kinematics, with
///
///     twist = J qd,     acceleration = J qdd + dJ/dt qd
///
/// in the base frame (dJ/dt by central differences along qd). Throws InvalidArgument unless the joints are
/// those of the arm.
DMP_EXPORT PoseTrajectory tip_motion(const Arm& arm, const JointTrajectory& joints);

}  // namespace dmp
