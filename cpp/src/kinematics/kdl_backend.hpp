#pragma once

#include <dmp/inverse_kinematics.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainiksolverpos_nr_jl.hpp>
#include <kdl/chainiksolvervel_pinv.hpp>
#include <memory>

#include "kinematics/joint_range.hpp"
#include "robot/kdl_forward.hpp"

namespace dmp::detail {

/// KDL's own position solvers behind the search, with what they need set right: LMA with equal weights (its
/// default forgives 1e-3 rad), NR_JL with limits (its default forbids negative angles).
class KdlBackend {
 public:
  /// Throws InvalidArgument for mimic and continuous joints, which KDL's solvers do not know.
  KdlBackend(const ChainModel& model, const IkOptions& options);

  /// One descent; joints outside [lower, upper] after the best winding are moved to its side. Returns the
  /// iterations.
  int descend(const Frame& target, const Joints& seed, const Joints& lower, const Joints& upper,
              Joints& joints);

 private:
  static constexpr int iterations_each = 100;

  bool lma_wanted_;
  JointRange range_;
  KDL::ChainFkSolverPos_recursive forward_;
  KDL::ChainIkSolverVel_pinv velocity_;
  KDL::ChainIkSolverPos_LMA lma_;
  KDL::ChainIkSolverPos_NR_JL newton_;
  KDL::JntArray seed_, joints_;
};

}  // namespace dmp::detail
