#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>
#include <dmp/joint_trajectory.hpp>

#include <Eigen/Core>

namespace dmp {

/// The smallest factor on the duration with which the joints' spline stays within the limits:
/// max(max |qd| / velocity_limit, sqrt(max |qdd| / acceleration_limit)) over all joints and all times,
/// between the samples too. Below 1 the motion may even be that much faster; 0 if nothing moves. Limits (n)
/// in rad/s and rad/s^2, > 0; infinity for none. Throws InvalidArgument for other sizes or signs.
DMP_EXPORT double duration_factor(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit,
                                  const Eigen::VectorXd& acceleration_limit);

/// The same with the effort that `arm` needs at each sample, by KDL's inverse dynamics (as time_optimal
/// counts it) with `gravity` [m/s^2] in the base frame; `effort_limit` (n) N m or N, > 0, infinity for none.
/// Throws InvalidArgument also if the arm cannot even stand still at a sample.
DMP_EXPORT double duration_factor(const Arm& arm, const JointTrajectory& joints,
                                  const Eigen::VectorXd& velocity_limit,
                                  const Eigen::VectorXd& acceleration_limit,
                                  const Eigen::VectorXd& effort_limit,
                                  const Eigen::Vector3d& gravity = {0.0, 0.0, -9.81});

/// The same path, `factor` times as long from the same first time: velocities are divided by the factor,
/// accelerations by its square. A uniform factor keeps the timing of a movement primitive. factor > 0 and
/// finite, else InvalidArgument.
DMP_EXPORT JointTrajectory stretched(const JointTrajectory& joints, double factor);

}  // namespace dmp
