#pragma once

#include <dmp/export.hpp>
#include <dmp/realtime.hpp>

namespace dmp {

/// The canonical system: tau sd = 1 and tau xd = -alpha_x x, x = exp(-alpha_x s) (Ijspeert et al. 2013,
/// Neural Computation 25(2), canonical system; tau is the duration in s). s runs from 0 to 1 over the motion
/// and on beyond it. The duration may change at any time: it is then followed through a first-order filter,
/// so that velocities do not jump, and the path y(s) is kept exactly.
class DMP_EXPORT Phase {
 public:
  /// Throws InvalidArgument unless duration [s] and alpha_x are finite and positive.
  Phase(double duration, double alpha_x);

  double s() const noexcept DMP_REALTIME { return s_; }
  double x() const noexcept DMP_REALTIME;
  /// Time since the start, s; pauses count.
  double time() const noexcept DMP_REALTIME { return time_; }
  /// tau as it is now, s, and d tau / dt.
  double duration() const noexcept DMP_REALTIME { return tau_; }
  double duration_rate() const noexcept DMP_REALTIME;

  /// The duration to go to; `filter` is the filter's time constant in s, 0 for a jump.
  /// False, and nothing changes, unless both are finite, duration positive and filter not negative.
  bool set_duration(double duration, double filter) noexcept DMP_REALTIME;

  /// How far s will go in dt seconds: the integral of dt / tau.
  double increment(double dt) const noexcept DMP_REALTIME;
  /// Moves time, tau and s on by dt.
  void advance(double dt) noexcept DMP_REALTIME;
  /// Back to the start, at the duration that was set last.
  void reset() noexcept DMP_REALTIME;

 private:
  double alpha_x_;
  double tau_;
  double target_tau_;
  double filter_ = 0.0;
  double s_ = 0.0;
  double time_ = 0.0;
};

}  // namespace dmp
