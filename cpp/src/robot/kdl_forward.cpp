#include "robot/kdl_forward.hpp"

namespace dmp::detail {
namespace {
using RowMatrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
}

void expand(const ChainModel& model, const Eigen::Ref<const Eigen::VectorXd>& q, KDL::JntArray& joints) {
  for (std::size_t i = 0; i < model.couplings.size(); ++i) {
    const Coupling& coupling = model.couplings[i];
    joints.data[static_cast<Eigen::Index>(i)] = coupling.multiplier * q[coupling.joint] + coupling.offset;
  }
}

Frame from_kdl(const KDL::Frame& frame) {
  return {Eigen::Map<const RowMatrix3>(frame.M.data), Eigen::Map<const Eigen::Vector3d>(frame.p.data)};
}

KDL::Frame to_kdl(const Frame& frame) {
  KDL::Frame result;
  Eigen::Map<RowMatrix3>(result.M.data) = frame.rotation;
  Eigen::Map<Eigen::Vector3d>(result.p.data) = frame.position;
  return result;
}

KdlForward::KdlForward(const ChainModel& model)
    : model_(model), solver_(model.chain), joints_(static_cast<unsigned>(model.couplings.size())) {}

Frame KdlForward::operator()(const Eigen::Ref<const Eigen::VectorXd>& q) {
  expand(model_, q, joints_);
  KDL::Frame tip;
  solver_.JntToCart(joints_, tip);
  return from_kdl(tip);
}

}  // namespace dmp::detail
