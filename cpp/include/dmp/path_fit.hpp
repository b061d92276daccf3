#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>
#include <dmp/joint_trajectory.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>

namespace dmp {

/// What `fit_path` may do to a path of poses, and what its joints must hold.
struct PathFitOptions {
  double position_tolerance = 1e-3;   ///< m, > 0: the most that any sample may be away
  double angle_tolerance = 8.727e-3;  ///< rad, > 0
  /// Which directions of a pose count (> 0), as in IkOptions: moving along x, y, z and turning about x, y, z
  /// of the wanted pose; 0 is free.
  Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Ones();
  std::optional<Eigen::VectorXd> velocity;      ///< (n) rad/s, > 0; unless given, the arm's
  std::optional<Eigen::VectorXd> acceleration;  ///< (n) rad/s^2, > 0; unless given, the arm's
  std::optional<Eigen::VectorXd> effort;  ///< (n) N m, > 0, by Arm::inverse_dynamics; absent: not looked at
  /// (T) >= 1 and (T) 1/s: the clock on which the limits are held, `slowdown` and `rate` of a Pace. Absent:
  /// the time of the path, stretched evenly.
  std::optional<Eigen::VectorXd> slowdown, slowdown_rate;
  bool free_placement = false;  ///< the path may be moved, turned about z of the base, and the tool turned
  double floor = -std::numeric_limits<double>::infinity();  ///< m, lowest height of a path that is moved
  double target = 1.0;                                      ///< duration factor that is good enough, > 0
  int iterations = 450;                                     ///< steps of the optimiser at most, > 0
  int spline_coefficients = 0;  ///< of each joint; 0: by the duration and the tolerance
  /// A last word on joints, for what is not modelled here; what it refuses is not returned.
  std::function<bool(const JointTrajectory&)> accept;
};

/// What `fit_path` found. Deviations are measured by KDL's forward kinematics at the samples of the path and
/// between them.
struct PathFit {
  JointTrajectory joints;        ///< at the times of the path
  bool improved = false;         ///< false: the joints are those of the start
  double duration_factor = 0.0;  ///< that the limits ask for, effort in it where it is looked at
  double start_factor = 0.0;     ///< the same of the start
  double position_max = 0.0, position_rms = 0.0;  ///< m from the path, as placed
  double angle_max = 0.0, angle_rms = 0.0;        ///< rad
  double limit_margin = 0.0;                      ///< rad or m, the smallest distance from a joint limit
  /// The path as placed is `base_change` * pose * `tool_change`, (4 x 4) each.
  Eigen::Matrix4d base_change = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d tool_change = Eigen::Matrix4d::Identity();
  int iterations = 0;  ///< spent
};

/// Joints that follow a path faster: within a tolerance of each pose, with the null space and, where that is
/// free, the placement chosen so that the limits ask for the shortest duration.
///
/// The joints are a uniform cubic B-spline. Penalties on velocity, acceleration, effort and joint limits, and
/// a dead zone around each pose, are minimised by Levenberg and Marquardt on banded normal equations (the
/// placement is their border); the duration factor asked for falls from level to level. The fastest iterate
/// within every tolerance that is accepted is kept, the start `start` (T x n) among them, so the result is
/// never slower than its start. It depends on the arguments alone, to the last bit.
///
/// times (T) s, strictly increasing, one pose each, T >= 4; the poses between two of them are interpolated.
/// Throws InvalidArgument for arguments of other sizes or out of range, and for an effort limit that cannot
/// hold the arm.
DMP_EXPORT PathFit fit_path(const Arm& arm, const Eigen::VectorXd& times, const Poses& poses,
                            const RowMatrix& start, const PathFitOptions& options = {});

}  // namespace dmp
