#pragma once

#include <dmp/export.hpp>
#include <dmp/pose_gripper_dmp.hpp>
#include <dmp/primitive.hpp>
#include <dmp/realtime.hpp>
#include <dmp/status.hpp>
#include <dmp/stepper.hpp>
#include <dmp/via.hpp>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

namespace dmp {

/// One motion of a Sequence.
template <class Space>
struct SequencePart {
  SequencePart(const Primitive<Space>& motion, double leaves_at = 1.0, double comes_within = 0.2,
               const std::vector<Via<Space>>& past = {})
      : model(motion), leave(leaves_at), reach(comes_within), vias(past) {}

  Primitive<Space> model;
  /// Its phase at which the next one takes over, 0.01 to 1; below 1 without coming to rest. Of a rhythmic
  /// motion cycles, to 1e5.
  double leave;
  double reach;  ///< 0.01 to 1, the part of its phase within which it is come onto from the one before
  std::vector<Via<Space>> vias;  ///< 16 at most
};

/// Motions one after another as one: each takes over where the one before is left, without a jump of
/// position, velocity or acceleration (Stepper::join). Immutable.
template <class Space>
class DMP_EXPORT Sequence {
 public:
  using Point = typename Space::Point;
  using Trajectory = typename Space::Trajectory;
  using Part = SequencePart<Space>;

  /// Throws InvalidArgument, naming parts[k], for none or more than 32, other dimensions than the first
  /// one's, phases, reaches or via-points out of range.
  explicit Sequence(const std::vector<Part>& parts);

  const std::vector<Part>& parts() const noexcept { return *parts_; }
  double duration() const noexcept;  ///< s, of all as demonstrated
  const Point& start() const noexcept { return parts_->front().model.start(); }
  const Point& goal() const noexcept { return parts_->back().model.goal(); }  ///< of the last one
  Eigen::Index dimension() const noexcept { return parts_->front().model.dimension(); }

  /// The whole motion, to `goal` at its end, within `duration` (all parts in proportion), as
  /// Primitive::rollout.
  Trajectory rollout(const std::optional<Point>& goal = {}, std::optional<double> duration = {},
                     double dt = 1e-3) const;
  Trajectory rollout_at(const Eigen::VectorXd& times, const std::optional<Point>& goal = {},
                        std::optional<double> duration = {}) const;

 private:
  std::shared_ptr<const std::vector<Part>> parts_;
};

/// One run of a Sequence, for one control loop. The constructor takes all the memory.
template <class Space>
class DMP_EXPORT SequenceRun {
 public:
  explicit SequenceRun(const Sequence<Space>& sequence);

  /// Moves on by dt seconds, 0 to 10 durations of the part that is under way.
  Status step(double dt) noexcept DMP_REALTIME;
  /// The goal of the last part.
  Status set_goal(typename Space::PointArgument goal) noexcept DMP_REALTIME;
  /// All durations times `factor`, from now on.
  Status stretch(double factor) noexcept DMP_REALTIME;

  typename Space::Output output() const noexcept DMP_REALTIME { return current_.output(); }
  const CouplingState<Space>& state() noexcept DMP_REALTIME { return current_.state(); }
  Eigen::Index part() const noexcept DMP_REALTIME { return part_; }  ///< which is under way, from 0
  /// The run of that part: its goal, via-points, pauses. Parts that come are run as they were set up.
  Stepper<Space>& current() noexcept DMP_REALTIME { return current_; }
  const Stepper<Space>& current() const noexcept DMP_REALTIME { return current_; }
  double time() const noexcept DMP_REALTIME { return time_; }  ///< s since the start

 private:
  bool is_last() const noexcept;

  Sequence<Space> sequence_;
  Stepper<Space> current_;
  std::vector<Stepper<Space>> others_;  // [k] is the run of part k until it takes over
  Eigen::Index part_ = 0;
  double time_ = 0.0;
};

using DmpSequence = Sequence<VectorSpace>;
using OrientationDmpSequence = Sequence<RotationSpace>;
using PoseDmpSequence = Sequence<PoseSpace>;
using PoseGripperDmpSequence = Sequence<PoseGripperSpace>;
extern template class Sequence<VectorSpace>;
extern template class Sequence<RotationSpace>;
extern template class Sequence<PoseSpace>;
extern template class Sequence<PoseGripperSpace>;
extern template class SequenceRun<VectorSpace>;
extern template class SequenceRun<RotationSpace>;
extern template class SequenceRun<PoseSpace>;
extern template class SequenceRun<PoseGripperSpace>;

}  // namespace dmp
