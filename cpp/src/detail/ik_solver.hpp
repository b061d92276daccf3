#pragma once

#include <dmp/inverse_kinematics.hpp>

#include "ik_search.hpp"
#include "path_tracker.hpp"

namespace dmp {

namespace detail {
/// Finite, with R in SO(3) to 1e-3 and the last row 0 0 0 1.
bool is_rigid(const Eigen::Matrix4d& pose);
/// The frame of a pose that is_rigid, with the nearest rotation.
Frame rigid_frame(const Eigen::Matrix4d& pose);
}  // namespace detail

/// What an InverseKinematics owns. The arm comes first: the search refers to its model.
struct InverseKinematics::Solver {
  Solver(Arm arm, const IkOptions& options);
  IkResult solve(const detail::Frame& target, const detail::Joints& seed);
  IkStatus diagnosis(const detail::Frame& target, const detail::Joints& seed, const detail::Found& best,
                     const detail::Jacobian& jacobian, bool blocked);
  PathReport report(const detail::TargetPath& path, const detail::Route& route, const FollowOptions& limits);

  Arm arm;
  IkOptions options;
  detail::IkSearch search;
  detail::FlatChain chain;
};

}  // namespace dmp
