#pragma once

#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "chain_model.hpp"

namespace dmp::detail {

/// The effort of the free joints, by KDL. One per thread; the model must outlive it.
class ArmDynamics {
 public:
  ArmDynamics(const ChainModel& model, const Eigen::Vector3d& gravity);

  /// (n) N m or N that holds the arm still at q.
  Eigen::VectorXd holding(const Eigen::VectorXd& q);
  /// (n) N m or N, beyond `holding`, of the velocity and acceleration.
  Eigen::VectorXd moving(const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
                         const Eigen::VectorXd& acceleration);

 private:
  Eigen::VectorXd effort(KDL::ChainIdSolver_RNE& solver, const Eigen::VectorXd& q,
                         const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration);

  const ChainModel& model_;
  KDL::ChainIdSolver_RNE standing_, weightless_;
  KDL::JntArray position_, velocity_, acceleration_, effort_;
  KDL::Wrenches nothing_;
};

}  // namespace dmp::detail
