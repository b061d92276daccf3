#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot/chain_model.hpp"

namespace dmp::detail {

/// At most this many free joints: everything in the solver's loop lives in memory of fixed size.
inline constexpr int joint_capacity = 16;
using Joints = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, joint_capacity, 1>;
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, joint_capacity>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A rigid transform: x_parent = rotation * x + position.
struct Frame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// The KDL chain flattened once into an array, so that one sweep gives tip and Jacobian without an allocation
/// or a virtual call (about 0.2 us for seven joints, an eighth of KDL's two solvers). Tests hold it equal to
/// KDL's.
class FlatChain {
 public:
  explicit FlatChain(const ChainModel& model);

  Eigen::Index joint_count() const { return joint_count_; }
  /// The tip in the base frame at the free joints q.
  Frame forward(const Joints& q) const;
  /// The tip, and how it moves with each free joint: linear rows first, base frame, at the tip.
  Frame forward(const Joints& q, Jacobian& jacobian) const;

 private:
  struct Link {
    Coupling coupling;
    bool prismatic;
    Frame to_next;  ///< from the moved joint to the next joint, or to the tip
  };

  Eigen::Index joint_count_;
  Frame base_;
  std::vector<Link> links_;
};

}  // namespace dmp::detail
