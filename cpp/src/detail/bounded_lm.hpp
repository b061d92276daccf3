#pragma once

#include <kdl/chainiksolver.hpp>

#include "flat_chain.hpp"

namespace dmp::detail {

/// When a pose counts as met, and what an angle weighs against a position where both can not be had.
struct Tolerances {
  double position = 1e-6;     ///< m
  double angle = 1e-6;        ///< rad
  double angle_weight = 0.1;  ///< m per rad
};

/// Where a descent ended.
struct Descent {
  Joints joints;
  Frame tip;          ///< at `joints`
  Jacobian jacobian;  ///< at `joints`
  Vector6 error;      ///< from the tip at `joints` to the target, by pose_error
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
  /// From where a descent stalled to the joints nearby that are truly closest, by position_error +
  /// angle_weight * angle_error. A sum of norms, not of squares: minimised by squares that are weighted anew
  /// at every step with one over the norms.
  Joints closest(const Frame& target, const Joints& start, const Joints& lower, const Joints& upper) const;

  const FlatChain& chain() const { return chain_; }

 private:
  bool within_tolerances(const Vector6& miss) const;

  FlatChain chain_;
  Tolerances tolerances_;
  Vector6 weight_;
  Joints lower_, upper_;
  int iteration_limit_;
};

}  // namespace dmp::detail
