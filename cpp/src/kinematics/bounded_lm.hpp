#pragma once

#include <kdl/chainiksolver.hpp>

#include "kinematics/pose_goal.hpp"
#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// When a pose counts as met, and what of it counts where not all can be had.
struct Tolerances {
  double position;  ///< m
  double angle;     ///< rad
  PoseGoal goal;
};

/// Where a descent ended.
struct Descent {
  Joints joints;
  Frame tip;          ///< at `joints`
  Jacobian jacobian;  ///< at `joints`
  Vector6 error;      ///< from the tip at `joints` to the target, by the goal
  int iterations = 0;
  bool converged = false;  ///< both errors are within the tolerances
  bool stalled = false;    ///< the error stopped falling; if neither, the iterations ran out
};

/// Levenberg-Marquardt for the pose of the tip, with the joint limits inside the step.
///
/// Each iteration solves the damped step in a box (box_step): the limits, met exactly, and a trust region.
/// The damping is proportional to the squared error (as Sugihara, IEEE Trans. Robotics 27(5), 2011), so that
/// the last steps are Gauss-Newton's. It ends when the tolerances hold, or when eight iterations have not
/// halved the squared error.
class BoundedLm final : public KDL::ChainIkSolverPos {
 public:
  BoundedLm(const ChainModel& model, const Tolerances& tolerances, int iteration_limit);

  /// KDL's interface: one descent from q_init. Takes the free joints (mimic joints are not counted).
  /// E_NOERROR, or E_NO_CONVERGE with the closest joints found.
  int CartToJnt(const KDL::JntArray& q_init, const KDL::Frame& p_in, KDL::JntArray& q_out) override;
  void updateInternalDataStructures() override {}

  /// One descent from `start`, which lies in [lower, upper], of at most iteration_limit steps.
  Descent descend(const Frame& target, const Joints& start, const Joints& lower, const Joints& upper,
                  int iteration_limit) const;
  /// The same from where another descent ended, whose tip and Jacobian are known.
  Descent descend_from(const Descent& end, const Frame& target, const Joints& lower, const Joints& upper,
                       int iteration_limit) const;
  /// From where a descent stalled to the joints nearby that are truly closest, by PoseGoal::distance. A
  /// sum of norms, not of squares: minimised by squares that are weighted anew at every step with one over
  /// the norms.
  Joints closest(const Frame& target, const Joints& start, const Joints& lower, const Joints& upper) const;

  const FlatChain& chain() const { return chain_; }
  const PoseGoal& goal() const { return tolerances_.goal; }

 private:
  bool within_tolerances(const Vector6& miss) const;

  FlatChain chain_;
  Tolerances tolerances_;
  Joints lower_, upper_;
  int iteration_limit_;
};

}  // namespace dmp::detail
