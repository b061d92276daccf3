#include "robot/arm_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <dmp/error.hpp>

#include "robot/kdl_forward.hpp"

namespace dmp::detail {
namespace {

unsigned joints_of(const ChainModel& model) { return model.chain.getNrOfJoints(); }

// Rates of the chain's joints: a mimic joint moves `multiplier` times as fast as its master.
void expand_rate(const ChainModel& model, const Eigen::VectorXd& rate, KDL::JntArray& joints) {
  for (std::size_t i = 0; i < model.couplings.size(); ++i)
    joints.data[static_cast<Eigen::Index>(i)] =
        model.couplings[i].multiplier * rate[model.couplings[i].joint];
}

}  // namespace

ArmDynamics::ArmDynamics(const ChainModel& model, const Eigen::Vector3d& gravity)
    : model_(model),
      standing_(model.chain, KDL::Vector(gravity.x(), gravity.y(), gravity.z())),
      weightless_(model.chain, KDL::Vector::Zero()),
      position_(joints_of(model)),
      velocity_(joints_of(model)),
      acceleration_(joints_of(model)),
      effort_(joints_of(model)),
      nothing_(model.chain.getNrOfSegments(), KDL::Wrench::Zero()) {}

Eigen::VectorXd ArmDynamics::effort(KDL::ChainIdSolver_RNE& solver, const Eigen::VectorXd& q,
                                    const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration) {
  expand(model_, q, position_);
  expand_rate(model_, velocity, velocity_);
  expand_rate(model_, acceleration, acceleration_);
  solver.CartToJnt(position_, velocity_, acceleration_, nothing_, effort_);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(q.size());
  for (std::size_t i = 0; i < model_.couplings.size(); ++i)
    result[model_.couplings[i].joint] +=
        model_.couplings[i].multiplier * effort_.data[static_cast<Eigen::Index>(i)];
  return result;
}

Eigen::VectorXd ArmDynamics::holding(const Eigen::VectorXd& q) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(q.size());
  return effort(standing_, q, none, none);
}

Eigen::VectorXd ArmDynamics::total(const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
                                   const Eigen::VectorXd& acceleration) {
  return effort(standing_, q, velocity, acceleration);
}

Eigen::VectorXd ArmDynamics::moving(const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
                                    const Eigen::VectorXd& acceleration) {
  return effort(weightless_, q, velocity, acceleration);
}

RowMatrix holding_efforts(ArmDynamics& dynamics, const RowMatrix& positions, const Eigen::VectorXd& limit,
                          const std::string& name) {
  RowMatrix holding(positions.rows(), positions.cols());
  for (Eigen::Index k = 0; k < holding.rows(); ++k) {
    holding.row(k) = dynamics.holding(positions.row(k)).transpose();
    for (Eigen::Index i = 0; i < holding.cols(); ++i)
      if (!(std::abs(holding(k, i)) < limit[i]))
        throw InvalidArgument(name + "[" + std::to_string(i) + "]: " + std::to_string(limit[i]) +
                              ", but joint " + std::to_string(i) + " needs " +
                              std::to_string(std::abs(holding(k, i))) + " to stand still at positions[" +
                              std::to_string(k) + "].");
  }
  return holding;
}

Eigen::VectorXd squared_effort_factors(ArmDynamics& dynamics, const JointTrajectory& joints,
                                       const RowMatrix& holding, const Eigen::VectorXd& limit) {
  Eigen::VectorXd square = Eigen::VectorXd::Zero(joints.time.size());
  for (Eigen::Index k = 0; k < square.size(); ++k) {
    const Eigen::VectorXd moving =
        dynamics.moving(joints.position.row(k), joints.velocity.row(k), joints.acceleration.row(k));
    for (Eigen::Index i = 0; i < moving.size(); ++i) {
      const double room = limit[i] - std::copysign(1.0, moving[i]) * holding(k, i);
      square[k] = std::max(square[k], std::abs(moving[i]) / room);
    }
  }
  return square;
}

}  // namespace dmp::detail
