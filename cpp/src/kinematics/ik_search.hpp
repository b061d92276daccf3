#pragma once

#include <dmp/inverse_kinematics.hpp>
#include <memory>
#include <vector>

#include "kinematics/bounded_lm.hpp"
#include "kinematics/joint_range.hpp"
#include "kinematics/kdl_backend.hpp"
#include "robot/kdl_forward.hpp"

namespace dmp::detail {

/// The best joints that a search has seen.
struct Found {
  Joints joints;
  double position_error = 0.0, angle_error = 0.0;
  double distance = std::numeric_limits<double>::infinity();  ///< by PoseGoal
  int iterations = 0;
  int stalled = 0;  ///< descents that ended away from the pose because the error stopped falling
  bool ok = false;
};

/// Descents from the seed and from random joints until one meets the pose. One per thread; the model must
/// outlive it.
class IkSearch {
 public:
  IkSearch(const ChainModel& model, const IkOptions& options);

  /// Joints in [lower, upper], on the winding nearest to the seed, which lies in there too.
  Found find(const Frame& target, const Joints& seed, const Joints& lower, const Joints& upper);
  /// The same without limits, always by bounded_lm.
  Found find_beyond_limits(const Frame& target, const Joints& seed);
  /// Fills in the errors of `found.joints`, by KDL.
  void measure(const Frame& target, Found& found);

  /// Joints as a result, measured by KDL; ok or, for now, out_of_reach.
  IkResult result(const Frame& target, const Joints& joints, int iterations);

  const JointRange& range() const { return range_; }
  const BoundedLm& lm() const { return lm_; }
  const Tolerances& tolerances() const { return tolerances_; }

 private:
  Found search(const Frame& target, const Joints& seed, const Joints& lower, const Joints& upper,
               bool by_kdl);
  Found attempt(const Frame& target, const Joints& start, const Joints& lower, const Joints& upper,
                int iterations, bool by_kdl);
  Found closest(const Frame& target, const Joints& lower, const Joints& upper, std::vector<Found> ends);

  Tolerances tolerances_;
  int iteration_limit_;
  std::uint64_t random_seed_;
  JointRange range_;
  BoundedLm lm_;
  KdlForward forward_;
  std::unique_ptr<KdlBackend> kdl_;  ///< null for bounded_lm
};

}  // namespace dmp::detail
