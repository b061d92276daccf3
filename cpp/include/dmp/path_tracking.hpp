#pragma once

#include <dmp/joint_trajectory.hpp>

#include <Eigen/Core>
#include <optional>

namespace dmp {

/// How InverseKinematics::follow goes about a path.
struct FollowOptions {
  std::optional<Eigen::VectorXd> start;  ///< (n) where the robot already stands; it is kept, not searched
  double max_step = 0.2;  ///< rad or m, > 0: how far any joint may go from one pose to the next
  /// Also bound the steps by velocity limit x time between the poses. Leave it off for a motion whose timing
  /// is still to be stretched (duration_factor): then speed only decides between joint paths that are equally
  /// exact.
  bool respect_velocity = false;
  int anchors = 5;  ///< poses of the path at which starts are searched, > 0
  int starts = 24;  ///< joints tried at each anchor, > 0
  /// Where tracking misses a pose, search a roadmap of joints for a way through; then calm the null space.
  /// About 0.3 s a path that needs it. Off, one that many paths are tried with is answered at once.
  bool thorough = true;
  double position_tolerance = 1e-5;  ///< m, > 0: when a pose of the path counts as met
  double angle_tolerance = 1e-5;     ///< rad, > 0
};

}  // namespace dmp
