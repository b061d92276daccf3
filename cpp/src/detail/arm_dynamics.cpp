#include "arm_dynamics.hpp"

#include "kdl_forward.hpp"

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

Eigen::VectorXd ArmDynamics::moving(const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
                                    const Eigen::VectorXd& acceleration) {
  return effort(weightless_, q, velocity, acceleration);
}

}  // namespace dmp::detail
