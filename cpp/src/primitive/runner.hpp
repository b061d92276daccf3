#pragma once

#include <dmp/forcing.hpp>
#include <dmp/options.hpp>
#include <dmp/phase.hpp>
#include <dmp/status.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "primitive/position_motion.hpp"

namespace dmp::detail {

/// Takes a motion (positions, orientation, or both) through the phase. What every run has in common stands
/// here once: steps are divided so that none exceeds a part of the duration and none straddles its end, the
/// forcing term is evaluated at the nodes of each, and the outputs change only while they are finite.
template <class Motion>
class Runner {
 public:
  /// `forcing` must outlive the runner.
  Runner(const DmpOptions& options, const ForcingTerm& forcing, double duration, Motion motion)
      : forcing_(&forcing),
        phase_(duration, options.alpha_x, options.tempo_filter, options.phase_stop),
        motion_(std::move(motion)),
        nodes_(RowMatrix::Zero(3, forcing.dimension())),
        psi_(forcing.basis().window_capacity()),
        force_after_end_(options.force_after_end),
        largest_step_(std::min(0.005, 0.5 / largest_rate(options))) {
    publish();
  }

  Motion& motion() noexcept { return motion_; }
  const Motion& motion() const noexcept { return motion_; }
  const Phase& phase() const noexcept { return phase_; }
  Status status() const noexcept { return status_; }

  Status step(double dt) noexcept {
    if (status_ == Status::not_finite) return status_;
    const double way = phase_.increment(dt);
    if (!(dt >= 0.0) || !(way <= kFarthest)) return Status::invalid_input;
    advance(way);
    phase_.advance(dt, way);
    if (!publish()) return status_ = Status::not_finite;
    return status_ = phase_.s() >= 1.0 - kRounding ? Status::finished : Status::running;
  }

  /// Before the first step at once, later through the filter.
  Status set_duration(double duration) noexcept {
    const bool taken = phase_.set_duration(duration);
    if (taken && at_start()) {
      phase_.reset();
      publish();
    }
    return accepted(taken);
  }
  bool at_start() const noexcept { return phase_.time() == 0.0; }
  Status set_tracking_error(double error) noexcept { return accepted(phase_.set_tracking_error(error)); }
  void pause() noexcept { phase_.pause(); }
  void resume() noexcept { phase_.resume(); }
  /// The phase at its start; then put the motion there and call restart().
  void reset_phase() noexcept { phase_.reset(); }
  void restart() noexcept {
    phase_.reset();
    evaluated_at_ = kNowhere;
    status_ = publish() ? Status::running : Status::not_finite;
  }

  /// Outputs from the state as it is; false, and the last ones stay, if they are not finite.
  bool publish() noexcept {
    const bool on = force_after_end_ || phase_.s() <= 1.0 + kRounding;
    if (!on || !evaluated(phase_.s())) evaluate(kEnd, phase_.s(), on);
    evaluated_at_ = on ? phase_.s() : kNowhere;
    motion_.set_phase(phase_.s());
    if (!motion_.look(phase_.speed(), phase_.speed_rate(), node(kEnd))) return false;
    motion_.publish();
    return true;
  }

 private:
  static constexpr double kRounding = 1e-9;
  static constexpr double kFarthest = 10.0;  // durations in one call: bounds the work
  static constexpr double kNowhere = -1.0;
  enum Node : Eigen::Index { kStart, kMiddle, kEnd };

  static double largest_rate(const DmpOptions& options) {
    return std::max({options.alpha, *options.orientation_alpha, options.goal_filter});
  }

  Status accepted(bool accepted) const noexcept { return accepted ? status_ : Status::invalid_input; }
  /// Whether the last node holds the forcing term at s, but for rounding.
  bool evaluated(double s) const noexcept { return std::abs(s - evaluated_at_) < 1e-13; }
  double* node(Node which) noexcept { return nodes_.data() + row_[which] * nodes_.cols(); }

  void evaluate(Node which, double s, bool on) noexcept {
    if (on) return forcing_->evaluate(s, psi_.data(), node(which));
    std::fill_n(node(which), nodes_.cols(), 0.0);
  }

  void evaluate_way(double middle, double end, bool on) noexcept {
    if (on) return forcing_->evaluate(middle, end, psi_.data(), node(kMiddle), node(kEnd));
    evaluate(kMiddle, middle, on);
    evaluate(kEnd, end, on);
  }

  void advance(double way) noexcept {
    double s = phase_.s();
    const bool straddles = s < 1.0 - kRounding && s + way > 1.0 + kRounding;
    if (straddles && !force_after_end_) {
      advance_evenly(s, 1.0 - s);
      way -= 1.0 - s;
      s = 1.0;
    }
    advance_evenly(s, way);
  }

  void advance_evenly(double s, double way) noexcept {
    if (way <= 0.0) return;
    const bool on = force_after_end_ || s < 1.0 - kRounding;
    if (way <= largest_step_) return advance_once(s, way, on);
    const int pieces = std::max(1, static_cast<int>(std::ceil(way / largest_step_ - 1e-6)));
    const double piece = way / pieces;
    for (int i = 0; i < pieces; ++i) advance_once(s + i * piece, piece, on);
  }

  void advance_once(double s, double piece, bool on) noexcept {
    if (on && evaluated(s)) {
      std::swap(row_[kStart], row_[kEnd]);
    } else {
      evaluate(kStart, s, on);
    }
    evaluate_way(s + 0.5 * piece, s + piece, on);
    evaluated_at_ = on ? s + piece : kNowhere;
    motion_.advance(piece, {node(kStart), node(kMiddle), node(kEnd)});
  }

  const ForcingTerm* forcing_;
  Phase phase_;
  Motion motion_;
  RowMatrix nodes_;
  std::array<Eigen::Index, 3> row_{0, 1, 2};  // of nodes_, by Node: the end of a step starts the next one
  Eigen::VectorXd psi_;
  double evaluated_at_ = kNowhere;  // the phase whose forcing stands in the last node
  bool force_after_end_;
  double largest_step_;
  Status status_ = Status::running;
};

}  // namespace dmp::detail
