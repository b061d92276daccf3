#pragma once

#include <dmp/inverse_kinematics.hpp>

#include "kinematics/ik_search.hpp"
#include "kinematics/path_tracker.hpp"

namespace dmp {

/// What an InverseKinematics owns. The arm comes first: the search refers to its model.
struct InverseKinematics::Solver {
  Solver(Arm arm, const IkOptions& options);
  IkResult solve(const detail::Frame& target, const detail::Joints& seed);
  IkStatus diagnosis(const detail::Frame& target, const detail::Joints& seed, const detail::Found& best,
                     bool blocked);
  bool stuck(const detail::Frame& target, const detail::Joints& q) const;
  PathReport report(const detail::TargetPath& path, const detail::Route& route, const FollowOptions& limits);

  Arm arm;
  IkOptions options;
  detail::IkSearch search;
  detail::FlatChain chain;
};

}  // namespace dmp
