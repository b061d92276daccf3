#pragma once

#include <dmp/ik_status.hpp>
#include <optional>
#include <vector>

#include "kinematics/bounded_lm.hpp"
#include "kinematics/box_step.hpp"
#include "kinematics/joint_range.hpp"

namespace dmp::detail {

/// A path as the tracker sees it: poses in time, and how far each joint may go from one to the next.
struct TargetPath {
  std::vector<double> time;
  std::vector<Frame> target;
  std::vector<Joints> step;  ///< step[k] bounds the way from sample k to k + 1; the last one is not used
};

/// Joints along a path, and what they are worth.
struct Route {
  std::vector<Joints> joints;
  double miss = 0.0;                ///< distances from the poses that are not met, summed
  double velocity_ratio = 0.0;      ///< the largest step / time / velocity limit
  double acceleration_ratio = 0.0;  ///< the largest acceleration / (velocity limit / 0.2 s)
  double margin = 0.0;              ///< rad or m, the smallest distance from a limit

  bool complete() const { return miss == 0.0; }
  bool better_than(const Route& other) const;
};

/// Carries joints from pose to pose. Every pose is solved to the last digits, because a residual of 1e-6 m
/// that varies from sample to sample becomes 1 m/s^2 at a kilohertz.
class PathTracker {
 public:
  /// `tolerances` say when a pose counts as met.
  PathTracker(const ChainModel& model, const Tolerances& tolerances);

  /// From `joints` at sample `anchor` to both ends of the path. `pull` [rad per m of motion of the tip]
  /// drives joints away from their limits in the null space; it acts while the poses are met.
  Route track(const TargetPath& path, std::size_t anchor, const Joints& joints, double pull) const;
  /// The closest joints to the first pose that `start` allows, then onwards.
  Route track_from(const TargetPath& path, const Joints& start, double pull) const;
  /// From joints that met one pose to the next, each joint by at most `step`. `drift` is the way that would
  /// go on as the joints came, zero if they stood: where two ways meet, as at a singularity, it decides.
  Descent advance(const Descent& at, const Frame& target, const Joints& step, const Joints& drift,
                  double pull) const;
  /// Why `next`, one step on from `at`, misses the target; ok if it does not. Takes no memory.
  IkStatus verdict(const Descent& at, const Descent& next, const Frame& target, const Joints& step) const;
  /// The descent that begins and ends at the joints q.
  Descent standing_at(const Joints& q) const;
  const PoseGoal& goal() const { return lm_.goal(); }
  /// Joints in [lower, upper] that meet the target, by a descent from `near`; none if it misses.
  std::optional<Joints> meet(const Frame& target, const Joints& near, const Joints& lower,
                             const Joints& upper) const;
  bool meets(const Frame& target, const Joints& joints) const;
  /// Joints beyond those that the goal needs can move without the tip.
  bool has_null_space() const { return range_.lower.size() > lm_.goal().dimension(); }
  /// Fills in what the joints of a route are worth, but for its miss.
  void rate(const TargetPath& path, Route& route) const;

 private:
  Descent nearest(const Descent& at, const Frame& target, const Joints& lower, const Joints& upper,
                  double pull) const;
  Joints pulled(const Descent& at, const Frame& target, const Box& box, double pull) const;
  void walk(const TargetPath& path, Descent at, std::size_t from, int direction, double pull,
            std::vector<Joints>& joints, double& miss) const;
  bool met(const Vector6& error) const;
  double miss(const Frame& target, const Vector6& error) const;

  JointRange range_;
  Joints velocity_limit_;
  Tolerances tolerances_;
  BoundedLm lm_;
};

}  // namespace dmp::detail
