#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>
#include <dmp/joint_trajectory.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <limits>
#include <optional>

namespace dmp {

/// What a motion may not exceed, and how quickly its tempo may change.
struct PacingLimits {
  Eigen::VectorXd velocity;               ///< (n) rad/s or m/s, > 0; infinity for none
  Eigen::VectorXd acceleration;           ///< (n) rad/s^2 or m/s^2, > 0; infinity for none
  std::optional<Eigen::VectorXd> jerk;    ///< (n) rad/s^3 or m/s^3, > 0, infinity for none
  std::optional<Eigen::VectorXd> effort;  ///< (n) N m or N, > 0, infinity for none; needs an arm
  double tool_speed = std::numeric_limits<double>::infinity();  ///< m/s of the tip, > 0; needs an arm
  /// 1/s, > 0: the most that the logarithm of the slowdown changes in a second of the original time. The
  /// default is a factor of 2 in 0.2 s.
  double tempo_rate = 3.4657359027997265;
};

/// A clock: when a motion that was recorded at one time is carried out.
struct Pace {
  Eigen::VectorXd time;      ///< (T) s, of each sample, carried out
  Eigen::VectorXd slowdown;  ///< (T) sigma = d time / d original time; never below 1
  Eigen::VectorXd rate;      ///< (T) 1/s, d ln sigma / d original time
};

/// The kinds of limits that a motion is slowed down for.
enum class PacedLimit { velocity, acceleration, jerk, effort, tool_speed };

/// What a motion asks of its limits where it asks most.
struct Demand {
  double factor = 0.0;  ///< on the duration; below 1 the motion may be that much faster
  PacedLimit limit = PacedLimit::velocity;
  Eigen::Index joint = -1;  ///< -1 for the tool's speed, or if nothing moves
  double time = 0.0;        ///< s, of the sample
};

/// Joints at their original tempo wherever that is within the limits.
struct Paced {
  JointTrajectory joints;
  Pace pace;
};

/// The same joints, slower only where limits ask for it: elsewhere the original time is kept.
///
/// With T(t) the new time, sigma = dT/dt >= 1 and l = ln sigma,
///
///     dq/dT = qd / sigma,     d2q/dT2 = (qdd - qd l') / sigma^2,     |l'| <= tempo_rate,
///
/// l is a uniform cubic B-spline with coefficients >= 0; it is raised where the C2 spline of the joints over
/// T exceeds a limit and kept within tempo_rate, until every limit holds. What 60 rounds leave is stretched,
/// so velocity and acceleration hold everywhere on the spline that is returned, to rounding; effort, jerk
/// (the differences of accelerations) and the tool's speed hold at and between its samples. It never takes
/// longer than `stretched` by what the worst sample asks for. Unlike `time_optimal` it need not start from
/// rest.
///
/// Throws InvalidArgument for limits of other sizes or signs, or for those that need an arm.
DMP_EXPORT Paced paced(const JointTrajectory& joints, const PacingLimits& limits);

/// The same with effort (`Arm::inverse_dynamics`) and the speed of the arm's tip. Throws InvalidArgument also
/// if the arm cannot even stand still at a sample.
DMP_EXPORT Paced paced(const Arm& arm, const JointTrajectory& joints, const PacingLimits& limits);

/// What the joints ask of the limits where they ask most, at their own tempo; throws as `paced` does.
DMP_EXPORT Demand largest_demand(const JointTrajectory& joints, const PacingLimits& limits);
DMP_EXPORT Demand largest_demand(const Arm& arm, const JointTrajectory& joints, const PacingLimits& limits);

/// The same poses on another clock, with the velocities and accelerations that they have on it. Throws
/// InvalidArgument unless there is one time, slowdown and rate for each pose.
DMP_EXPORT PoseTrajectory retimed(const PoseTrajectory& motion, const Pace& pace);

}  // namespace dmp
