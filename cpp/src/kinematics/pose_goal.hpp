#pragma once

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// Which directions of a pose are constrained: a weight for each direction of the target's own frame, moving
/// along x, y, z and turning about x, y, z. A direction of weight 0 is free. Of the turns, all count, or all
/// but one (the axis of a tool that may spin), or none.
class PoseGoal {
 public:
  /// `angle_weight` [m/rad] multiplies the weights of the turns.
  PoseGoal(const Vector6& weight, double angle_weight);

  /// From the tip to the nearest pose that the goal accepts: position [m] in rows 0-2, rotation vector [rad]
  /// in rows 3-5, base frame.
  Vector6 error(const Frame& target, const Frame& tip) const {
    return is_whole_ ? whole_error(target, tip) : partial_error(target, tip);
  }
  /// An error or a Jacobian of the base frame, row by row times the weights. Free rows are 0.
  template <class Rows>
  Rows weighted(const Frame& target, const Rows& rows) const {
    if (is_isotropic_) return weight_.asDiagonal() * rows;
    Rows result = rows;
    const Eigen::Matrix3d turn = target.rotation.transpose();
    result.template topRows<3>() = weight_.head<3>().asDiagonal() * (turn * rows.template topRows<3>());
    result.template bottomRows<3>() = weight_.tail<3>().asDiagonal() * (turn * rows.template bottomRows<3>());
    return result;
  }
  /// What "closest" means: weighted position error + weighted angle error.
  double distance(const Frame& target, const Vector6& error) const {
    const Vector6 far = weighted(target, error);
    return far.head<3>().norm() + far.tail<3>().norm();
  }
  /// Where each joint would go to come closer: the descent of half the squared distance.
  Joints wish(const Frame& target, const Jacobian& jacobian, const Vector6& error) const {
    return weighted(target, jacobian).transpose() * weighted(target, error);
  }
  /// How many directions count.
  Eigen::Index dimension() const { return (weight_.array() > 0.0).count(); }

 private:
  static Vector6 whole_error(const Frame& target, const Frame& tip);
  Vector6 partial_error(const Frame& target, const Frame& tip) const;

  Vector6 weight_;
  bool is_whole_;      ///< every direction counts
  bool is_isotropic_;  ///< one weight for all moves, one for all turns: any frame will do
  int free_turns_;
  Eigen::Index free_axis_ = 0;  ///< if free_turns_ is 1
};

}  // namespace dmp::detail
