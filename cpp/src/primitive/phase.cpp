#include <dmp/error.hpp>
#include <dmp/options.hpp>
#include <dmp/phase.hpp>

#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace dmp {
namespace {

bool is_duration(double duration) noexcept { return duration >= 1e-9 && duration <= 1e15; }

void require(bool holds, const char* name, double value, const char* expected) {
  if (!holds)
    throw InvalidArgument(std::string(name) + ": " + detail::number(value) + ", expected " + expected + ".");
}

}  // namespace

Phase::Phase(double duration, double alpha_x, double filter, double stop_gain)
    : alpha_x_(alpha_x),
      filter_(filter),
      stop_gain_(stop_gain),
      tau_(duration),
      speed_(1.0 / duration),
      target_speed_(speed_) {
  require(is_duration(duration), "duration", duration, "a time in s, 1e-9 to 1e15");
  require(std::isfinite(alpha_x) && alpha_x > 0.0, "alpha_x", alpha_x, "a positive decay rate");
  require(std::isfinite(filter) && filter >= 0.0, "tempo_filter", filter, "a time constant in s, 0 or more");
  require(std::isfinite(stop_gain) && stop_gain >= 0.0, "phase_stop", stop_gain, "a gain, 0 or more");
}

Phase::Phase(double duration, const DmpOptions& options)
    : Phase(duration, options.alpha_x, options.tempo_filter, options.phase_stop) {
  if (options.motion == Motion::rhythmic) end_ = std::numeric_limits<double>::infinity();
}

double Phase::x() const noexcept { return std::exp(-alpha_x_ * s_); }

bool Phase::set_duration(double duration) noexcept {
  if (!is_duration(duration)) return false;
  tau_ = duration;
  retarget();
  return true;
}

bool Phase::set_tracking_error(double error) noexcept {
  if (!(std::isfinite(error) && error >= 0.0)) return false;
  error_ = error;
  retarget();
  return true;
}

void Phase::pause() noexcept {
  paused_ = true;
  retarget();
}

void Phase::resume() noexcept {
  paused_ = false;
  retarget();
}

void Phase::retarget() noexcept {
  target_speed_ = paused_ ? 0.0 : 1.0 / (tau_ * (1.0 + stop_gain_ * error_));
  if (filter_ > 0.0) return;
  speed_ = target_speed_;
  speed_rate_ = 0.0;
}

// The filter T^2 v'' + 2 T v' + v = v*: v = v* + (c + d t) exp(-t / T), c = v_0 - v*, d = v'_0 + c / T.

double Phase::increment(double dt) const noexcept {
  if (settled()) return dt * speed_;
  const double c = speed_ - target_speed_;
  const double d = speed_rate_ + c / filter_;
  const double gone = -std::expm1(-dt / filter_);  // 1 - exp(-dt / T)
  return dt * target_speed_ + filter_ * (c * gone + d * (filter_ * gone - dt * (1.0 - gone)));
}

void Phase::advance(double dt) noexcept { advance(dt, increment(dt)); }

void Phase::advance(double dt, double increment) noexcept {
  s_ += increment;
  time_ += dt;
  if (settled()) return;
  const double c = speed_ - target_speed_;
  const double d = speed_rate_ + c / filter_;
  const double decay = std::exp(-dt / filter_);
  speed_ = target_speed_ + (c + d * dt) * decay;
  speed_rate_ = (d - (c + d * dt) / filter_) * decay;
  // The filter only ever closes a share of the distance: end it once it no longer shows.
  if ((std::abs(speed_ - target_speed_) + filter_ * std::abs(speed_rate_)) * tau_ > 1e-12) return;
  speed_ = target_speed_;
  speed_rate_ = 0.0;
}

void Phase::reset() noexcept {
  s_ = 0.0;
  time_ = 0.0;
  retarget();
  speed_ = target_speed_;
  speed_rate_ = 0.0;
}

}  // namespace dmp
