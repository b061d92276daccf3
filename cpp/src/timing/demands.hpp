#pragma once

#include <dmp/pacing.hpp>

#include <optional>

#include "robot/arm_dynamics.hpp"

namespace dmp::detail {

/// What a motion asks of its limits at each sample and on the way to the next one, as the square of the
/// factor on the time with which they hold.
class Demands {
 public:
  /// Of joints along the positions of `joints`, at any tempo. InvalidArgument for limits of other sizes or
  /// signs, those that need an arm where it is null, and an effort that cannot hold the arm.
  Demands(const Arm* arm, const JointTrajectory& joints, const PacingLimits& limits);

  /// (T) at the tempo of `joints`, whose positions are those of the constructor.
  Eigen::VectorXd squared(const JointTrajectory& joints) const;
  /// The same with the effort of the original motion slowed down as `pace` says: what moves the joints is
  /// linear in their acceleration, so that Newton-Euler is asked once for all tempi.
  Eigen::VectorXd squared(const JointTrajectory& joints, const Pace& pace) const;
  Demand largest(const JointTrajectory& joints) const;

 private:
  Eigen::VectorXd without_effort(const JointTrajectory& joints) const;
  Eigen::VectorXd by_jerk(const JointTrajectory& joints) const;
  Eigen::VectorXd by_tool_speed(const JointTrajectory& joints) const;
  Eigen::VectorXd by_effort(const RowMatrix& moving) const;
  RowMatrix moving(const JointTrajectory& joints) const;
  Demand of_joint(const JointTrajectory& joints, Eigen::Index k) const;

  const PacingLimits& limits_;
  mutable std::optional<ArmDynamics> dynamics_;
  RowMatrix holding_, moving_, along_;  // N m: stands still; moves as the original does, and with qdd := qd
  Eigen::VectorXd way_;                 // m of the tip, from each sample to the next one
};

}  // namespace dmp::detail
