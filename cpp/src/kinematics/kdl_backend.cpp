#include "kinematics/kdl_backend.hpp"

#include <dmp/error.hpp>

namespace dmp::detail {
namespace {

KDL::JntArray to_kdl(const Eigen::Ref<const Eigen::VectorXd>& values) {
  KDL::JntArray array(static_cast<unsigned>(values.size()));
  array.data = values;
  return array;
}

constexpr double largest_joint = 1e6;  // rad or m, beyond which no winding is worth taking back

const ChainModel& plain(const ChainModel& model) {
  if (model.couplings.size() != model.joint_names.size())
    throw InvalidArgument("options.backend: KDL's solvers do not know mimic joints; use bounded_lm.");
  if (!model.lower.allFinite() || !model.upper.allFinite())
    throw InvalidArgument("options.backend: KDL's solvers need finite joint limits; use bounded_lm.");
  return model;
}

// LMA compares the norm of all six errors with this.
double tolerance(const IkOptions& options) {
  return std::min(options.position_tolerance, options.angle_tolerance);
}

}  // namespace

KdlBackend::KdlBackend(const ChainModel& model, const IkOptions& options)
    : lma_wanted_(options.backend == IkBackend::kdl_lma),
      range_(plain(model)),
      forward_(model.chain),
      velocity_(model.chain),
      lma_(model.chain, Vector6::Ones(), tolerance(options), iterations_each),
      newton_(model.chain, to_kdl(model.lower), to_kdl(model.upper), forward_, velocity_, iterations_each,
              tolerance(options)),
      seed_(model.chain.getNrOfJoints()),
      joints_(model.chain.getNrOfJoints()) {}

int KdlBackend::descend(const Frame& target, const Joints& seed, const Joints& lower, const Joints& upper,
                        Joints& joints) {
  seed_.data = seed;
  if (lma_wanted_) {
    lma_.CartToJnt(seed_, detail::to_kdl(target), joints_);
  } else {
    newton_.setJointLimits(to_kdl(lower), to_kdl(upper));
    newton_.CartToJnt(seed_, detail::to_kdl(target), joints_);
  }
  // Newton-Raphson may diverge to anything, NaN included.
  const bool is_sane = joints_.data.allFinite() && joints_.data.cwiseAbs().maxCoeff() < largest_joint;
  const Joints found = is_sane ? Joints(joints_.data) : seed;
  joints = range_.nearest_winding(found, seed, lower, upper).cwiseMax(lower).cwiseMin(upper);
  return lma_wanted_ ? std::max(lma_.lastNrOfIter, 1) : iterations_each;
}

}  // namespace dmp::detail
