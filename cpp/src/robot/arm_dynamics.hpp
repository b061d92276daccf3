#pragma once

#include <dmp/joint_trajectory.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <string>

#include "robot/chain_model.hpp"

namespace dmp::detail {

/// The effort of the free joints, by KDL. One per thread; the model must outlive it.
class ArmDynamics {
 public:
  ArmDynamics(const ChainModel& model, const Eigen::Vector3d& gravity);

  /// (n) N m or N that holds the arm still at q.
  Eigen::VectorXd holding(const Eigen::VectorXd& q);
  /// (n) N m or N, of holding and moving together.
  Eigen::VectorXd total(const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
                        const Eigen::VectorXd& acceleration);
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

/// (T x n) N m or N that hold the arm still at each sample. InvalidArgument where the limit `name` (n) does
/// not even allow that.
RowMatrix holding_efforts(ArmDynamics& dynamics, const RowMatrix& positions, const Eigen::VectorXd& limit,
                          const std::string& name);

/// (T) The square of the smallest factor on the time with which each sample stays within the effort limit:
/// what moves the arm falls with the square, what holds it (`holding`) stays.
Eigen::VectorXd squared_effort_factors(ArmDynamics& dynamics, const JointTrajectory& joints,
                                       const RowMatrix& holding, const Eigen::VectorXd& limit);

}  // namespace dmp::detail
