#pragma once

#include <dmp/arm.hpp>

#include <Eigen/Core>
#include <kdl/chain.hpp>
#include <limits>
#include <string>
#include <vector>

namespace dmp::detail {

/// How one joint of the KDL chain follows the arm's free joints: q_chain = multiplier * q[joint] + offset.
/// A mimic joint shares the free joint of its master; every other joint has multiplier 1 and offset 0.
struct Coupling {
  Eigen::Index joint;
  double multiplier;
  double offset;
};

/// What an Arm knows: the way from base to tip as KDL sees it, and the limits of its n free joints.
///
/// Every joint of the chain is RotZ or TransZ, with the axis turned to z and fixed joints folded into the
/// segment before. This matters for threads: a KDL::Joint of type RotAxis caches its last pose in a mutable
/// member, so two threads that share a const chain read each other's poses (KDL issue 373); RotZ and TransZ
/// cache nothing.
struct ChainModel {
  std::string name, base, tip;
  std::string choice;  ///< how base and tip were chosen; "" where they were stated
  std::string urdf;
  std::string folder;
  std::vector<std::string> joint_names;
  Eigen::VectorXd lower, upper, velocity_limit, acceleration_limit, jerk_limit, effort_limit;
  LimitSources limit_sources;
  double tool_speed_limit = std::numeric_limits<double>::infinity();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< z of the URDF's root, in the base frame
  std::vector<std::string> warnings;
  KDL::Chain chain;
  std::vector<Coupling> couplings;  ///< one for each joint of the chain
};

}  // namespace dmp::detail
