#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>
#include <dmp/ik_status.hpp>
#include <dmp/path_tracking.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace dmp {

/// Which KDL::ChainIkSolverPos makes the single descents; the search around them is the same.
enum class IkBackend {
  bounded_lm,  ///< This library's Levenberg-Marquardt with the limits inside the step. Use this one.
  kdl_lma,     ///< KDL::ChainIkSolverPos_LMA: blind to limits, which are checked afterwards.
  kdl_nr_jl    ///< KDL::ChainIkSolverPos_NR_JL: Newton-Raphson that clamps to the limits.
};

/// Documented defaults; InverseKinematics throws InvalidArgument for values out of range.
struct IkOptions {
  IkBackend backend = IkBackend::bounded_lm;
  double position_tolerance = 1e-6;  ///< m, > 0
  double angle_tolerance = 1e-6;     ///< rad, > 0
  double angle_weight = 0.1;  ///< m per rad, > 0: "closest" is position error + angle_weight * angle error
  /// What of the pose counts, in the axes of the wanted pose: moving along x, y, z, then turning about x, y,
  /// z. 0: that direction is free, and left out of the errors; otherwise how much it counts for "closest".
  /// {1,1,1,0,0,0} is position only; {1,1,1,1,1,0} leaves a tool free to spin about its z axis. Of the turns
  /// none, one or all may be free. Not for the KDL backends.
  Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Ones();
  int iteration_limit = 2000;  ///< of one solve, all restarts together, > 0; the budget is not a time
  /// rad or m, > 0: how far solve() may leave the seed with any joint.
  double max_step = std::numeric_limits<double>::infinity();
  /// When a pose is missed, search on without limits to tell out_of_reach from limit_blocked. That costs as
  /// much as the search itself; without it the status is told from the joints that stand at a limit.
  bool diagnose = true;
  std::uint64_t random_seed = 1;  ///< of the restarts; the same seed gives the same joints to the last bit
};

/// The joints whose tip is at the pose, or as close to it as the search came. A pose that is missed is an
/// answer, not an error: ask ok(). (In Python `strict=True` raises IkError, whose `report` this is.)
struct IkResult {
  Eigen::VectorXd joints;  ///< (n) rad or m, always within the limits
  IkStatus status = IkStatus::invalid_input;
  double position_error = 0.0;        ///< m, by KDL's forward kinematics
  double angle_error = 0.0;           ///< rad, by KDL's forward kinematics
  int iterations = 0;                 ///< spent, diagnosis not counted
  double limit_margin = 0.0;          ///< rad or m from the nearest joint limit; infinity if no joint has one
  std::vector<Eigen::Index> blocked;  ///< joints that stand at a limit and would go on if it were not there

  bool ok() const { return status == IkStatus::ok; }
};

/// What solve_many found for N poses.
struct IkBatch {
  RowMatrix joints;                ///< (N x n) rad or m
  std::vector<IkStatus> status;    ///< (N)
  Eigen::VectorXd position_error;  ///< (N) m, by KDL's forward kinematics
  Eigen::VectorXd angle_error;     ///< (N) rad, by KDL's forward kinematics
  Eigen::Index solved = 0;         ///< poses with status ok
};

/// Joints for poses of an Arm's tip. One per thread: it takes its memory in the constructor and works in it.
/// Copies are independent. Every answer depends on the arguments and the options alone, never on time or on
/// earlier calls.
class DMP_EXPORT InverseKinematics {
 public:
  /// Throws InvalidArgument for an option out of range, an arm of more than 16 free joints, or a KDL backend
  /// for an arm with mimic or continuous joints, which those solvers do not know.
  explicit InverseKinematics(Arm arm, const IkOptions& options = {});
  InverseKinematics(const InverseKinematics& other);
  InverseKinematics(InverseKinematics&&) noexcept;
  InverseKinematics& operator=(InverseKinematics other) noexcept;
  ~InverseKinematics();

  const Arm& arm() const;
  const IkOptions& options() const;
  /// (n) The middle of each range, 0 for a continuous joint: the seed where none is given.
  Eigen::VectorXd middle() const;

  /// `pose` is tip in base, [R p; 0 1] with R in SO(3) to 1e-3 (the nearest rotation is taken); `seed` (n) is
  /// where the search begins and which of several windings of a joint is preferred. A seed outside the limits
  /// is moved to them. Never throws.
  IkResult solve(const Eigen::Matrix4d& pose, const Eigen::VectorXd& seed);
  IkResult solve(const Eigen::Matrix4d& pose) { return solve(pose, middle()); }

  /// solve() for each pose; the first begins at the seed (n), every other one at the last joints that met
  /// theirs.
  IkBatch solve_many(const Poses& poses, const Eigen::VectorXd& seed);
  IkBatch solve_many(const Poses& poses) { return solve_many(poses, middle()); }

  /// Joints for a whole path; times (T) in s, strictly increasing, one pose each, T >= 1. See FollowOptions.
  ///
  /// Joints that meet the path at a few of its poses are searched and tracked through the path both ways;
  /// what counts is the error of the whole path, then the duration it needs at the velocity limits, then the
  /// distance from the joint limits. An arm with more than six joints moves its null space away from the
  /// limits. Where no joints meet a pose, the closest ones stand in, and the report says so: ask
  /// report.complete(); report.summary() has the words for an error of your own. Throws InvalidArgument for
  /// times or poses that are no path (`poses[17]: ...`) or options out of range, never because a pose is out
  /// of reach.
  JointTrajectory follow(const Eigen::VectorXd& times, const Poses& poses, const FollowOptions& options = {});

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace dmp
