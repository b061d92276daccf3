#pragma once

#include <kdl/chainfksolverpos_recursive.hpp>

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// The tip by KDL's own forward kinematics: what every reported error is measured with. One per thread; the
/// model must outlive it.
class KdlForward {
 public:
  explicit KdlForward(const ChainModel& model);
  Frame operator()(const Eigen::Ref<const Eigen::VectorXd>& q);

 private:
  const ChainModel& model_;
  KDL::ChainFkSolverPos_recursive solver_;
  KDL::JntArray joints_;
};

/// The joints of the KDL chain, mimic joints included, at the free joints q.
void expand(const ChainModel& model, const Eigen::Ref<const Eigen::VectorXd>& q, KDL::JntArray& joints);

Frame from_kdl(const KDL::Frame& frame);
KDL::Frame to_kdl(const Frame& frame);

}  // namespace dmp::detail
