#pragma once

#include <dmp/export.hpp>
#include <dmp/ik_status.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

namespace dmp {

/// How well joints follow a path of T poses.
struct DMP_EXPORT PathReport {
  Eigen::VectorXd position_error;  ///< (T) m, by KDL's forward kinematics
  Eigen::VectorXd angle_error;     ///< (T) rad, by KDL's forward kinematics
  std::vector<IkStatus> status;    ///< (T)
  Eigen::Index solved = 0;         ///< poses with status ok
  /// First and last index of each run of poses that were missed.
  std::vector<std::pair<Eigen::Index, Eigen::Index>> missed;
  double max_step = 0.0;        ///< rad or m, the largest step of any joint from one pose to the next
  double velocity_ratio = 0.0;  ///< the largest step / time between the poses / velocity limit of its joint
  double limit_margin = 0.0;    ///< rad or m, the smallest distance from a joint limit on the way
  int starts_tried = 0;         ///< joint paths that were tracked

  /// Every pose is met.
  bool complete() const { return solved == static_cast<Eigen::Index>(status.size()) && solved > 0; }
  /// The worst errors and the runs that were missed, in one sentence.
  std::string summary() const;
};

/// How a cubic spline ends, where its samples leave that open (de Boor, A Practical Guide to Splines, ch.
/// IV).
enum class SplineEnds {
  not_a_knot,  ///< as the samples suggest: the first three lie on one cubic, and the last three
  at_rest      ///< clamped: the velocity at both ends is zero, exactly
};

/// Joints over time.
struct DMP_EXPORT JointTrajectory {
  /// The C2 cubic spline through positions (T x n) at times (T) s, strictly increasing, T >= 1 (with
  /// not-a-knot ends three samples give a parabola, two a line). Throws InvalidArgument for times or values
  /// that are no motion.
  static JointTrajectory through(const Eigen::VectorXd& times, const RowMatrix& positions,
                                 const std::vector<std::string>& joint_names = {},
                                 SplineEnds ends = SplineEnds::not_a_knot);

  Eigen::VectorXd time;                  ///< (T) s
  RowMatrix position;                    ///< (T x n) rad or m
  RowMatrix velocity;                    ///< (T x n) rad/s, of the C2 cubic spline through the positions
  RowMatrix acceleration;                ///< (T x n) rad/s^2, of the same spline
  std::vector<std::string> joint_names;  ///< (n)
  PathReport report;
};

}  // namespace dmp
