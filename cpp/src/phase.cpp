#include <dmp/error.hpp>
#include <dmp/phase.hpp>

#include <cmath>
#include <string>

namespace dmp {

Phase::Phase(double duration, double alpha_x) : alpha_x_(alpha_x), tau_(duration), target_tau_(duration) {
  if (!(std::isfinite(duration) && duration > 0.0))
    throw InvalidArgument("duration: " + std::to_string(duration) + ", expected a positive time in s.");
  if (!(std::isfinite(alpha_x) && alpha_x > 0.0))
    throw InvalidArgument("alpha_x: " + std::to_string(alpha_x) + ", expected a positive decay rate.");
}

double Phase::x() const noexcept { return std::exp(-alpha_x_ * s_); }

double Phase::duration_rate() const noexcept { return filter_ > 0.0 ? (target_tau_ - tau_) / filter_ : 0.0; }

bool Phase::set_duration(double duration, double filter) noexcept {
  if (!(std::isfinite(duration) && duration > 0.0 && std::isfinite(filter) && filter >= 0.0)) return false;
  target_tau_ = duration;
  filter_ = filter;
  if (filter == 0.0) tau_ = duration;
  return true;
}

double Phase::increment(double dt) const noexcept {
  if (tau_ == target_tau_) return dt / tau_;
  const double later = target_tau_ + (tau_ - target_tau_) * std::exp(-dt / filter_);
  return (dt + filter_ * std::log(later / tau_)) / target_tau_;
}

void Phase::advance(double dt) noexcept {
  s_ += increment(dt);
  time_ += dt;
  if (tau_ == target_tau_) return;
  tau_ = target_tau_ + (tau_ - target_tau_) * std::exp(-dt / filter_);
  // The filter only ever halves the distance: close it once it no longer shows.
  if (std::abs(tau_ - target_tau_) < 1e-12 * target_tau_) tau_ = target_tau_;
}

void Phase::reset() noexcept {
  s_ = 0.0;
  time_ = 0.0;
  tau_ = target_tau_;
}

}  // namespace dmp
