#pragma once

#include <dmp/coupling.hpp>
#include <dmp/export.hpp>
#include <dmp/primitive.hpp>
#include <dmp/realtime.hpp>
#include <dmp/safety_filter.hpp>
#include <dmp/status.hpp>
#include <dmp/via.hpp>

#include <memory>

namespace dmp {

/// One run of a Primitive, for one control loop. The constructor takes all the memory; copies are
/// independent. Run, OrientationRun, PoseRun and PoseGripperRun add the names of the outputs.
template <class Space>
class DMP_EXPORT Stepper {
 public:
  using PointArgument = typename Space::PointArgument;
  using TangentArgument = typename Space::TangentArgument;

  explicit Stepper(const Primitive<Space>& model);
  Stepper(const Stepper& other);
  Stepper(Stepper&& other) noexcept;
  Stepper& operator=(const Stepper& other);
  Stepper& operator=(Stepper&& other) noexcept;
  ~Stepper();

  /// Moves on by dt seconds, 0 to 10 durations (else invalid_input), in internal steps of at most 0.005 of
  /// the duration, or of half a duration over the largest of alpha and goal_filter where that is less.
  Status step(double dt) noexcept DMP_REALTIME;
  /// The same with a coupling term, called in each internal step; see Coupling.
  Status step(double dt, const Coupling<Space>& coupling) noexcept DMP_REALTIME;
  /// The same behind a filter, which changes where the run is so that limits are kept and obstacles not
  /// touched; see SafetyFilter. `blocked` where obstacles leave no way on, whether or not the phase has
  /// ended; invalid_input also for a filter whose limits have another number of axes, for obstacles before a
  /// motion that has more than three axes, and for more than 10^5 steps of the filter. A change pulls on the
  /// spring: that distance slows the phase as a tracking error does (DmpOptions::phase_stop). While the tempo
  /// goes below a tenth the run's own velocity is kept, to go on with.
  Status step(double dt, SafetyFilter& filter) noexcept DMP_REALTIME;
  Status step(double dt, const Coupling<Space>& coupling, SafetyFilter& filter) noexcept DMP_REALTIME;
  /// The goal to go to from now on, approached through DmpOptions::goal_filter; before the first step it
  /// counts at once. Refused (invalid_input) for a wrong size, numbers that are not finite, or what is no
  /// rotation (so3::is_rotation; the nearest one is taken) or no pose. Like start_from, it takes no memory
  /// for a vector; of an expression or a row of a matrix Eigen makes a copy before the call, which does.
  Status set_goal(PointArgument goal) noexcept DMP_REALTIME;
  /// The duration (s) of the whole motion from now on; the path stays the same. Before the first step at
  /// once, later through DmpOptions::tempo_filter.
  Status set_duration(double duration) noexcept DMP_REALTIME;
  /// Multiplies the forcing term (0 or more, 1 at first): what a rhythmic motion goes away from its centre.
  /// Before the first step at once, later approached through DmpOptions::goal_filter.
  Status set_amplitude(double amplitude) noexcept DMP_REALTIME;
  double amplitude() const noexcept DMP_REALTIME;  ///< the one set last
  /// How far the robot lags behind (0 or more): slows the phase by 1 + DmpOptions::phase_stop times it.
  Status set_tracking_error(double error) noexcept DMP_REALTIME;
  /// Comes to rest on the path, and goes on from there; both through DmpOptions::tempo_filter.
  void pause() noexcept DMP_REALTIME;
  void resume() noexcept DMP_REALTIME;
  bool paused() const noexcept DMP_REALTIME;
  /// Begins anew at a point with a velocity (d, per s; rotations in rad/s, world frame), at the goal and
  /// duration that were set last.
  Status start_from(PointArgument point, TangentArgument velocity) noexcept DMP_REALTIME;
  /// Begins anew, from any point and velocity with no acceleration, and comes onto the learned motion within
  /// the rise of `reach`: position, velocity and acceleration do not jump, and behind it nothing is changed.
  /// Refused while paused.
  Status start_from(PointArgument point, TangentArgument velocity, const Reach& reach) noexcept DMP_REALTIME;
  /// Begins anew at the demonstrated start, with the goal, duration and via-points that were set last. A
  /// pause goes on.
  void reset() noexcept DMP_REALTIME;

  /// Passes `point` at a phase that lies ahead, and changes the motion within `reach` only: exactly, whatever
  /// happens to the goal, the duration or the point (move_via) until then; with a coupling as closely as the
  /// coupling lets foresee. With `velocity` (d, per s at the duration that is set) it has that there. A
  /// via-point that is set again at its phase is replaced. At most 16 at once, 0.01 or more from each other
  /// and from both ends of the phase (else invalid_input); too_late where less than 0.01 is left until there.
  Status via(double phase, PointArgument point, const Reach& reach = {}) noexcept DMP_REALTIME;
  Status via(double phase, PointArgument point, TangentArgument velocity,
             const Reach& reach = {}) noexcept DMP_REALTIME;
  /// The via-point that was set at `phase` has moved; invalid_input if there is none, too_late if it lies
  /// behind.
  Status move_via(double phase, PointArgument point) noexcept DMP_REALTIME;
  /// Forgets all via-points; what is under way fades within its reach.
  void clear_vias() noexcept DMP_REALTIME;
  /// Goes on with another motion from the present state: `next`, a run of the same space that stands where it
  /// shall begin, with its goal, duration and via-points set. Position, velocity and acceleration do not
  /// jump; what lies between the two motions fades within the rise of `reach`, a part of the phase of `next`.
  /// The two runs change places: `next` is the old one afterwards, so that nothing is set free in the loop.
  /// invalid_input for another dimension, a run that is paused or not finite, or itself.
  Status join(Stepper& next, const Reach& reach = {}) noexcept DMP_REALTIME;
  /// Where the run will be at a phase from now to 1 if nothing changes until then, via-points included; speed
  /// and velocity at the duration that is set. Valid until the next call.
  const CouplingState<Space>& ahead(double phase) noexcept DMP_REALTIME;

  /// Where the run is, as `ahead` says of later phases. Valid until the next call of either.
  const CouplingState<Space>& state() noexcept DMP_REALTIME;
  typename Space::Output output() const noexcept DMP_REALTIME;   ///< where the run is, the last finite one
  typename Space::PointView goal() const noexcept DMP_REALTIME;  ///< the one set last
  double time() const noexcept DMP_REALTIME;                     ///< s since the start
  double phase() const noexcept DMP_REALTIME;                    ///< 0 at the start, 1 at the end
  double duration() const noexcept DMP_REALTIME;                 ///< s, the one set last
  Status status() const noexcept DMP_REALTIME;

 private:
  static constexpr int kMostVias = 16;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dmp
