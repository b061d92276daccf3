#pragma once

#include <dmp/path_tracking.hpp>

#include "kinematics/path_tracker.hpp"

namespace dmp::detail {

/// Finds joints for a whole path. Which of an arm's many postures it begins with decides whether it can
/// finish: so postures are gathered at several poses of the path, the anchors, and each is tracked to both
/// ends on a thinned path; the best of these routes are tracked through every pose.
class RouteSearch {
 public:
  RouteSearch(const ChainModel& model, const Tolerances& tolerances, const FollowOptions& options,
              std::uint64_t random_seed);

  Route best(const TargetPath& path);
  int routes_tried() const { return routes_tried_; }

 private:
  struct Candidate {
    Route route;
    std::size_t anchor;
    double pull;
  };

  std::vector<Joints> starts(const Frame& target);
  std::vector<Candidate> candidates(const TargetPath& path);
  std::vector<double> pulls() const;
  std::vector<double> ranked_pulls(const TargetPath& path, const Joints& start) const;
  Route from_anchors(const TargetPath& path);
  void by_roadmap(const TargetPath& path, Route& best) const;
  void calm(const TargetPath& path, Route& best) const;
  Route from_start(const TargetPath& path, const Joints& start);

  const FollowOptions& options_;
  std::uint64_t random_seed_;
  const ChainModel& model_;
  JointRange range_;
  BoundedLm lm_;
  PathTracker tracker_;
  int routes_tried_ = 0;
};

}  // namespace dmp::detail
