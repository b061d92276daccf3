#pragma once

#include <dmp/coupling.hpp>
#include <dmp/forcing.hpp>
#include <dmp/options.hpp>
#include <dmp/phase.hpp>
#include <dmp/status.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "primitive/offset_path.hpp"
#include "primitive/product_system.hpp"

namespace dmp::detail {

/// Takes the transformation system of a space through the phase. What every run has in common stands here
/// once: steps are divided so that none exceeds a part of the duration and none straddles its end; the drive
/// (the scaled forcing term and the coupling) is formed at the nodes of each; the outputs change only while
/// they are finite.
template <class Space>
class Runner {
 public:
  using PointArgument = typename Space::PointArgument;

  /// Both must outlive the runner: the forcing term of the motion, and the same with, behind its axes, a
  /// column of the advance of each part. The second is asked only while start or goal are other than the
  /// demonstrated ones.
  Runner(const DmpOptions& options, const ForcingTerm& own, const ForcingTerm& with_advance, double duration,
         const Ends<Space>& ends)
      : own_(&own),
        with_advance_(&with_advance),
        phase_(duration, options),
        system_(options, ends),
        nodes_(RowMatrix::Zero(3, with_advance.dimension())),
        drive_(RowMatrix::Zero(3, with_advance.dimension())),
        coupling_value_(Eigen::VectorXd::Zero(ends.z.size())),
        shift_(RowMatrix::Zero(3, ends.z.size())),
        psi_(own.basis().window_capacity()),
        force_after_end_(options.force_after_end || options.motion == Motion::rhythmic),
        amplitude_rate_(options.goal_filter),
        largest_step_(std::min(0.005, 0.5 / largest_rate(options))) {
    coupling_state_.point = ends.start;
    coupling_state_.goal = ends.goal;
    coupling_state_.velocity = ends.z;
    choose_forcing();
    publish();
  }

  const System<Space>& system() const noexcept { return system_; }
  const Phase& phase() const noexcept { return phase_; }
  Status status() const noexcept { return status_; }

  Status step(double dt, const Coupling<Space>* coupling = nullptr) noexcept {
    if (status_ == Status::not_finite) return status_;
    const double way = phase_.increment(dt);
    if (!(dt >= 0.0) || !(way <= kFarthest)) return Status::invalid_input;
    coupling_ = coupling;
    plain_ = coupling == nullptr && !amplifies_;
    advance(way);
    phase_.advance(dt, way);
    status_ = !publish() ? Status::not_finite : phase_.ended() ? Status::finished : Status::running;
    coupling_ = nullptr;
    plain_ = !amplifies_;
    return status_;
  }

  /// Whether step(dt) would take dt.
  bool takes(double dt) const noexcept { return dt >= 0.0 && phase_.increment(dt) <= kFarthest; }
  bool fits(const SafetyStep& filter) const noexcept {
    return filter.fits(system_.axes(), place_axes_of(system_));
  }
  void hold() noexcept { system_.hold(); }
  /// Lets a filter change where the last step led, whose outputs were held before it; whether it did. A pull
  /// on the spring is a tracking error, beside the one that is set.
  bool confine(SafetyStep& filter) noexcept {
    constexpr double kSlowest = 0.1;  // of the speed: a run that pauses keeps its own velocity
    double pull = 0.0;
    const double speed = std::max(phase_.speed(), kSlowest / phase_.duration());
    const bool changed = system_.confine(filter, 0, true, speed, pull);
    set_pull(pull);
    return changed;
  }
  /// Behind no filter any more.
  void release() noexcept { set_pull(0.0); }
  Status block() noexcept { return status_ = Status::blocked; }

  /// Before the first step at once, later through the filter.
  Status set_goal(PointArgument goal) noexcept {
    if (at_start()) {
      start_with_goal(goal);
    } else {
      system_.set_goal(goal);
      choose_forcing();
    }
    return status_;
  }
  void start_with_goal(PointArgument goal) noexcept {
    system_.start_with_goal(goal);
    choose_forcing();
    publish();
  }
  Status set_duration(double duration) noexcept {
    const bool taken = phase_.set_duration(duration);
    if (taken && at_start()) {
      phase_.reset();
      publish();
    }
    return accepted(taken);
  }
  /// What the forcing term is multiplied by from now on: before the first step at once, later approached as a
  /// goal is.
  Status set_amplitude(double amplitude) noexcept {
    if (!(std::isfinite(amplitude) && amplitude >= 0.0)) return Status::invalid_input;
    wanted_amplitude_ = amplitude;
    if (at_start() || amplitude_rate_ == 0.0) amplitude_.fill(amplitude);
    amplifies_ = true;
    plain_ = false;
    if (at_start()) publish();
    return status_;
  }
  double amplitude() const noexcept { return wanted_amplitude_; }
  Status set_tracking_error(double error) noexcept {
    if (!(std::isfinite(error) && error >= 0.0)) return Status::invalid_input;
    tracking_error_ = error;
    return accepted(phase_.set_tracking_error(tracking_error_ + pull_));
  }
  void pause() noexcept { phase_.pause(); }
  void resume() noexcept { phase_.resume(); }
  /// Begins anew at `point` with z, tau times the velocity.
  Status restart(PointArgument point, typename Space::TangentArgument z) noexcept {
    release();
    phase_.reset();
    system_.begin(point, z);
    choose_forcing();
    amplitude_.fill(wanted_amplitude_);
    evaluated_at_ = kNowhere;
    return status_ = publish() ? Status::running : Status::not_finite;
  }

  /// What is added to the outputs from now on; it must outlive the runner.
  void set_offset(const OffsetPath* offset) noexcept { offset_ = offset; }
  /// The outputs anew, after the offset changed; whether they are finite.
  bool republish() noexcept { return publish(); }

  /// Takes over the own motion of another runner of the same model, as it is now, to look ahead.
  void shadow(const Runner& other) noexcept {
    system_ = other.system_;
    amplitude_ = other.amplitude_;
    wanted_amplitude_ = other.wanted_amplitude_;
    amplifies_ = other.amplifies_;
    plain_ = !amplifies_;
    seen_ = other.phase_.s();
    choose_forcing();
    evaluated_at_ = kNowhere;
  }
  /// Goes on to s, as nothing changes until then; the outputs are per unit of phase.
  void look(double s) noexcept {
    choose_forcing();
    advance_evenly(seen_, s - seen_, true);
    seen_ = s;
    publish_at(s, true, 1.0, 0.0);
  }
  System<Space>& seen() noexcept { return system_; }

 private:
  static constexpr double kFarthest = 10.0;  // durations in one call: bounds the work
  static constexpr double kNowhere = -1.0;
  static constexpr double kLargestShift = 1e100;
  enum Node : Eigen::Index { kStart, kMiddle, kEnd };

  static double largest_rate(const DmpOptions& options) {
    return std::max({options.alpha, *options.orientation_alpha, options.goal_filter});
  }

  void set_pull(double pull) noexcept {
    if (pull == pull_) return;
    pull_ = pull;
    phase_.set_tracking_error(tracking_error_ + pull_);
  }
  bool at_start() const noexcept { return phase_.time() == 0.0; }
  Status accepted(bool accepted) const noexcept { return accepted ? status_ : Status::invalid_input; }

  /// Outputs from the state as it is; false, and the last ones stay, if they are not finite.
  bool publish() noexcept {
    const bool on = force_after_end_ || !phase_.past_end();
    if (offset_ != nullptr && offset_->active()) return publish_shifted(on);
    return publish_at(phase_.s(), on, phase_.speed(), phase_.speed_rate());
  }
  [[gnu::noinline]] bool publish_shifted(bool on) noexcept {
    const bool shifted = offset_->at(phase_.s(), shift_.data());
    if (shifted && !shift_over_time()) return false;
    if (!publish_at(phase_.s(), on, phase_.speed(), phase_.speed_rate())) return false;
    if (shifted) system_.displace({shift_.row(0).data(), shift_.row(1).data(), shift_.row(2).data()});
    return true;
  }
  [[gnu::always_inline]] bool publish_at(double s, bool on, double speed, double speed_rate) noexcept {
    if (!on || !evaluated(s)) evaluate(kEnd, s, on);
    evaluated_at_ = on ? s : kNowhere;
    system_.set_phase(s);
    if (coupling_ != nullptr) evaluate_coupling(s);
    if (!system_.compute_outputs(speed, speed_rate, drive(kEnd))) return false;
    system_.publish();
    return true;
  }
  /// Takes the derivatives of the offset from phase to time; false unless their products stay finite.
  bool shift_over_time() noexcept {
    const double speed = phase_.speed();
    shift_.row(2) = speed * speed * shift_.row(2) + phase_.speed_rate() * shift_.row(1);
    shift_.row(1) *= speed;
    return (shift_.array().abs() < kLargestShift).all();
  }

  // The forcing term at the nodes of a step.

  /// After everything that may change where the run goes: whether its forcing term needs the advance.
  void choose_forcing() noexcept { forcing_ = system_.advances() ? with_advance_ : own_; }
  /// Whether the last node holds the forcing term that is asked for at s, but for rounding.
  bool evaluated(double s) const noexcept {
    return std::abs(s - evaluated_at_) < 1e-13 && evaluated_ == forcing_;
  }
  double* node(Node which) noexcept { return nodes_.data() + row_[which] * nodes_.cols(); }

  void evaluate(Node which, double s, bool on) noexcept {
    evaluated_ = forcing_;
    if (on) return forcing_->evaluate(s, psi_.data(), node(which));
    std::fill_n(node(which), nodes_.cols(), 0.0);
  }

  void evaluate_way(double middle, double end, bool on) noexcept {
    evaluated_ = forcing_;
    if (on) return forcing_->evaluate(middle, end, psi_.data(), node(kMiddle), node(kEnd));
    evaluate(kMiddle, middle, on);
    evaluate(kEnd, end, on);
  }

  /// What a piece of the way adds to the forcing term, or multiplies it by.
  [[gnu::noinline]] void prepare_drive(double s, double piece) noexcept {
    if (coupling_ != nullptr) evaluate_coupling(s);
    if (amplifies_) approach_amplitude(piece);
  }

  /// At the nodes of a piece: a share exp(-rate s) of the way is left, so that the drive does not jump.
  void approach_amplitude(double piece) noexcept {
    const double half = std::exp(-0.5 * amplitude_rate_ * piece);
    amplitude_[kStart] = amplitude_[kEnd];
    const double way = amplitude_[kStart] - wanted_amplitude_;
    const bool there = amplitude_rate_ == 0.0 || std::abs(way) < 1e-15 * (1.0 + wanted_amplitude_);
    amplitude_[kMiddle] = there ? wanted_amplitude_ : wanted_amplitude_ + half * way;
    amplitude_[kEnd] = there ? wanted_amplitude_ : wanted_amplitude_ + half * half * way;
  }

  // The drive: the forcing term, scaled for this run's start and goal, and the coupling.

  /// Asks the coupling what it adds from here on.
  [[gnu::noinline]] void evaluate_coupling(double s) noexcept {
    coupling_value_.setZero();
    if (phase_.speed() == 0.0)
      return;  // paused: no acceleration over phase moves it, and a / speed^2 is none
    system_.set_phase(s);
    coupling_state_.phase = s;
    coupling_state_.speed = phase_.speed();
    coupling_state_.point = system_.point();
    coupling_state_.goal = system_.goal();
    system_.velocity(coupling_state_.speed, coupling_state_.velocity.data());
    coupling_->add_to(coupling_value_.data(), coupling_value_.size(), coupling_state_);
    system_.to_drive(coupling_value_.data());
  }

  [[gnu::always_inline]] const double* drive(Node which) noexcept {
    return system_.unscaled() && plain_ ? node(which) : formed_drive(which);
  }

  [[gnu::noinline]] const double* formed_drive(Node which) noexcept {
    double* const result = drive_.data() + which * drive_.cols();
    std::copy_n(node(which), drive_.cols(), result);
    if (!system_.unscaled()) system_.scale(result, result + coupling_value_.size());
    if (amplifies_) Eigen::Map<Eigen::VectorXd>(result, coupling_value_.size()) *= amplitude_[which];
    if (coupling_ != nullptr) Eigen::Map<Eigen::VectorXd>(result, coupling_value_.size()) += coupling_value_;
    return result;
  }

  // The way that a step goes, in pieces.

  void advance(double way) noexcept {
    const bool on = force_after_end_ || !phase_.ended();
    const double before_end = force_after_end_ ? way : phase_.before_end(way);
    advance_evenly(phase_.s(), before_end, on);
    if (before_end < way) advance_evenly(1.0, way - before_end, false);
  }

  void advance_evenly(double s, double way, bool on) noexcept {
    if (way <= 0.0) return;
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
    if (!plain_) prepare_drive(s, piece);
    system_.advance(piece, {drive(kStart), drive(kMiddle), drive(kEnd)});
    choose_forcing();
  }

  const ForcingTerm* own_;
  const ForcingTerm* with_advance_;
  const ForcingTerm* forcing_ = nullptr;    // one of the two
  const ForcingTerm* evaluated_ = nullptr;  // which of them the nodes hold
  Phase phase_;
  System<Space> system_;
  RowMatrix nodes_;
  std::array<Eigen::Index, 3> row_{0, 1, 2};  // of nodes_, by Node: the end of a step starts the next one
  RowMatrix drive_;
  const Coupling<Space>* coupling_ = nullptr;  // of the call that is under way
  CouplingState<Space> coupling_state_;        // what the coupling is shown
  Eigen::VectorXd coupling_value_;             // what it answered, as a drive
  const OffsetPath* offset_ = nullptr;
  RowMatrix shift_;    // the offset at the present phase
  double seen_ = 0.0;  // the phase that a runner which looks ahead has come to
  Eigen::VectorXd psi_;
  double evaluated_at_ = kNowhere;  // the phase whose forcing stands in the last node
  bool force_after_end_;
  double amplitude_rate_;
  double wanted_amplitude_ = 1.0;
  std::array<double, 3> amplitude_{1.0, 1.0, 1.0};  // by Node
  bool amplifies_ = false;
  bool plain_ = true;  // the drive is the forcing term, but for its scale
  double largest_step_;
  double tracking_error_ = 0.0;  // as it was set
  double pull_ = 0.0;            // what a filter adds to it
  Status status_ = Status::running;
};

}  // namespace dmp::detail
