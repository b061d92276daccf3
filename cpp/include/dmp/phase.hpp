#pragma once

#include <dmp/export.hpp>
#include <dmp/realtime.hpp>

namespace dmp {

struct DmpOptions;

/// The canonical system: tau sd = 1 and tau xd = -alpha_x x, x = exp(-alpha_x s) (Ijspeert et al. 2013,
/// Neural Computation 25(2), canonical system; tau is the duration in s). s runs from 0 to 1 over the motion
/// and on beyond it.
///
/// All that changes the tempo on the way (another duration, a tracking error, a pause) sets the speed that sd
/// goes to, through one critically damped second-order filter: velocities and accelerations do not jump, and
/// the path y(s) is kept exactly. A tracking error e slows the phase to sd = 1 / (tau (1 + k e)) (phase
/// stopping; Ijspeert et al. 2013), and the spring and damper with it.
class DMP_EXPORT Phase {
 public:
  /// `filter` is the time constant in s of changes of tempo, 0 for jumps; `stop_gain` is k. Throws
  /// InvalidArgument unless duration is 1e-9 to 1e15 s, alpha_x finite and positive, filter and stop_gain
  /// finite and not negative.
  Phase(double duration, double alpha_x, double filter = 0.0, double stop_gain = 0.0);

  /// The clock that resolved options describe. Throws InvalidArgument as above.
  Phase(double duration, const DmpOptions& options);

  double s() const noexcept DMP_REALTIME { return s_; }
  double x() const noexcept DMP_REALTIME;
  /// Time since the start, s; pauses count.
  double time() const noexcept DMP_REALTIME { return time_; }
  /// tau as it was set last, s.
  double duration() const noexcept DMP_REALTIME { return tau_; }
  /// ds/dt as it is now, 1/s, and its rate of change, 1/s^2.
  double speed() const noexcept DMP_REALTIME { return speed_; }
  double speed_rate() const noexcept DMP_REALTIME { return speed_rate_; }

  /// False, and nothing changes, unless 1e-9 to 1e15.
  bool set_duration(double duration) noexcept DMP_REALTIME;
  /// The distance e >= 0 between where the robot is and where it should be, in any unit; see stop_gain.
  /// False, and nothing changes, unless finite and not negative.
  bool set_tracking_error(double error) noexcept DMP_REALTIME;
  void pause() noexcept DMP_REALTIME;
  void resume() noexcept DMP_REALTIME;
  bool paused() const noexcept DMP_REALTIME { return paused_; }

  /// Where the motion ends: 1, or, of a rhythmic one, nowhere (infinite).
  double end() const noexcept DMP_REALTIME { return end_; }
  /// Whether s has come to the end of the motion, 1 but for rounding; and whether it lies beyond it.
  bool ended() const noexcept DMP_REALTIME { return s_ >= end_ - kRounding; }
  bool past_end() const noexcept DMP_REALTIME { return s_ > end_ + kRounding; }
  /// How much of a way on from here lies before the end; all of it where it does not lead across the end.
  double before_end(double way) const noexcept DMP_REALTIME {
    return !ended() && s_ + way > end_ + kRounding ? end_ - s_ : way;
  }

  /// How far s will go in dt seconds.
  double increment(double dt) const noexcept DMP_REALTIME;
  /// Moves time, speed and s on by dt.
  void advance(double dt) noexcept DMP_REALTIME;
  /// The same, with the increment(dt) at hand.
  void advance(double dt, double increment) noexcept DMP_REALTIME;
  /// Back to the start, at the duration that was set last and the speed that goes with it; a pause goes on.
  void reset() noexcept DMP_REALTIME;

 private:
  static constexpr double kRounding = 1e-9;

  void retarget() noexcept;
  bool settled() const noexcept { return speed_ == target_speed_ && speed_rate_ == 0.0; }

  double end_ = 1.0;  // infinite of a rhythmic motion
  double alpha_x_;
  double filter_;
  double stop_gain_;
  double tau_;
  double error_ = 0.0;
  bool paused_ = false;
  double speed_;
  double target_speed_;
  double speed_rate_ = 0.0;
  double s_ = 0.0;
  double time_ = 0.0;
};

}  // namespace dmp
