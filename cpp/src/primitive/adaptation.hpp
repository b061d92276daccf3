#pragma once

#include <dmp/coupling.hpp>
#include <dmp/status.hpp>
#include <dmp/via.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "primitive/offset_path.hpp"
#include "primitive/offset_space.hpp"
#include "primitive/runner.hpp"

namespace dmp::detail {

inline bool is_reach(const Reach& reach) noexcept {
  return reach.rise >= kLeastReach && reach.rise <= 1.0 && reach.fall >= kLeastReach && reach.fall <= 1.0;
}

/// What is added to a run so that it passes its via-points: their list, the offset through them, and a second
/// runner that looks where the motion would be. It takes all its memory in the constructor.
template <class Space>
class Adaptation {
  using In = OffsetIn<Space>;
  using Point = typename Space::Point;

 public:
  /// `like`: a runner of the model, whose points are like `point`; room for so many via-points at once.
  Adaptation(const Runner<Space>& like, const Point& point, Eigen::Index axes, int room)
      : scout_(like),
        path_(axes, room),
        end_(like.phase().end()),
        room_(room),
        vias_(static_cast<std::size_t>(room), Place{point, Eigen::VectorXd::Zero(axes)}),
        aims_(vias_.size()),
        values_(RowMatrix::Zero(room, axes)),
        rates_(values_),
        state_(RowMatrix::Zero(3, axes)),
        seen_{} {
    seen_.point = point;
    seen_.goal = point;
    seen_.velocity = Eigen::VectorXd::Zero(axes);
  }

  const OffsetPath& offset() const noexcept { return path_; }
  bool is_stale() const noexcept { return stale_; }

  /// Passes `point` at a phase. `velocity` (d), per s, or null. What is not finite or no point is refused by
  /// the caller.
  template <class PointArgument>
  Status set(double now, double phase, const PointArgument& point, const double* velocity,
             const Reach& reach) noexcept {
    if (!(phase >= kLeastReach && phase <= end_ - kLeastReach && phase <= now + kFarthest) ||
        !is_reach(reach))
      return Status::invalid_input;
    if (phase - now < kLeastReach - kSame) return Status::too_late;
    int place = find(phase);
    if (place < 0) {
      if (!is_clear_of_others(phase) || !has_room(now)) return Status::invalid_input;
      place = open_at(phase);
    }
    Place& via = at(place);
    via.phase = phase;
    via.point = point;
    via.reach = reach;
    via.rise = std::min(reach.rise, phase - now);
    via.with_velocity = velocity != nullptr;
    if (velocity != nullptr) std::copy_n(velocity, path_.axes(), via.velocity.data());
    stale_ = true;
    return Status::running;
  }
  /// The via-point at a phase is elsewhere.
  template <class PointArgument>
  Status move(double now, double phase, const PointArgument& point) noexcept {
    const int place = find(phase);
    if (place < 0) return Status::invalid_input;
    if (phase - now <= 0.0) return Status::too_late;
    at(place).point = point;
    stale_ = true;
    return Status::running;
  }
  /// Forgets all; what is under way fades within its reach.
  void clear(double now) noexcept {
    release_ = count_ > 0 ? now + at(std::min(first_ahead(now), count_ - 1)).reach.fall : now;
    count_ = 0;
    stale_ = true;
  }

  /// What changes where the motion goes: the offset is aimed anew before the next step.
  void changed(double now) noexcept { stale_ = stale_ || first_ahead(now) < count_; }
  void changed_tempo(double now) noexcept {
    for (int k = first_ahead(now); k < count_; ++k) stale_ = stale_ || at(k).with_velocity;
  }
  /// Begins anew with no offset; all via-points lie ahead again.
  void restart(double now) noexcept {
    path_.clear();
    for (int k = 0; k < count_; ++k)
      at(k).rise = std::max(std::min(at(k).reach.rise, at(k).phase - now), kLeastReach);
    stale_ = count_ > 0;
  }
  /// From the own motion as it is published, per s, to a point with a velocity and an acceleration (both d):
  /// that difference fades within a part of the phase.
  template <class PointArgument>
  void bridge(const Phase& phase, const typename Space::Output& own, const PointArgument& point,
              const double* velocity, const double* acceleration, double reach) noexcept {
    state_.setZero();
    double* const value = state_.row(0).data();
    double* const rate = state_.row(1).data();
    In::between(own, point, rate, value);  // from the shortest rotation
    In::rate(own, value, velocity, rate);
    In::second(own, value, rate, acceleration, state_.row(2).data());
    state_.row(1) /= phase.speed();
    state_.row(2) = (state_.row(2) - phase.speed_rate() * state_.row(1)) / (phase.speed() * phase.speed());
    path_.begin(phase.s(), state_.data(), phase.s() + reach);
    stale_ = count_ > 0;
  }
  void forget_offset() noexcept { path_.clear(); }

  /// Before a step: the offset through what lies ahead, from where it is now.
  void aim(const Runner<Space>& runner) noexcept {
    stale_ = false;
    const double now = runner.phase().s();
    const int first = first_ahead(now);
    scout_.shadow(runner);
    if (!path_.at(now, state_.data())) state_.row(0).setZero();
    const double* near = state_.row(0).data();
    for (int k = first; k < count_; ++k) {
      look_at(k, runner.phase(), near);
      near = values_.row(k).data();
      aims_[static_cast<std::size_t>(k)] = {
          at(k).phase, at(k).rise, std::min(at(k).reach.fall, end_ - at(k).phase), at(k).with_velocity};
    }
    path_.pass(now, aims_, first, count_ - first, values_, rates_, std::max(release_, now + kLeastReach));
  }
  /// After a step: what lay far ahead is seen better from near by.
  void follow(const Runner<Space>& runner) noexcept {
    const double now = runner.phase().s();
    path_.leave_behind(now);
    const int next = first_ahead(now);
    if (stale_ || next == count_) return;
    const double left = at(next).phase - now;
    if (left > 0.5 * at(next).seen_from) return;
    scout_.shadow(runner);
    look_at(next, runner.phase(), values_.row(next).data());
    path_.correct(now, values_.row(next).data(), rates_.row(next).data());
  }

  /// Where the run will be at a phase if nothing changes until then.
  const CouplingState<Space>& ahead(const Runner<Space>& runner, double phase) noexcept {
    if (stale_) aim(runner);
    const double now = runner.phase().s();
    const double s = phase > now ? std::min({phase, std::max(now, end_), now + kFarthest}) : now;
    scout_.shadow(runner);
    scout_.look(s);
    if (path_.at(s, state_.data()) && state_.allFinite())
      scout_.seen().displace({state_.row(0).data(), state_.row(1).data(), state_.row(2).data()});
    seen_.phase = s;
    seen_.speed = 1.0 / runner.phase().duration();
    seen_.goal = runner.system().goal();
    return shown(scout_.system().output(), seen_.speed);
  }
  /// Where it is.
  const CouplingState<Space>& present(const Runner<Space>& runner) noexcept {
    seen_.phase = runner.phase().s();
    seen_.speed = runner.phase().speed();
    seen_.goal = runner.system().goal();
    return shown(runner.system().output(), 1.0);
  }

 private:
  static constexpr double kSame = 1e-9;
  static constexpr double kFarthest = 10.0;  // cycles ahead: bounds the work

  struct Place {
    Point point;
    Eigen::VectorXd velocity;  ///< per s
    double phase = 0.0;
    Reach reach{};
    double rise = 0.0;  ///< what there was of the reach before it
    bool with_velocity = false;
    double seen_from = 0.0;  ///< how far before it the motion was looked at last
  };

  const CouplingState<Space>& shown(const typename Space::Output& motion, double factor) noexcept {
    In::point(motion, seen_.point);
    In::velocity(motion, factor, seen_.velocity.data());
    return seen_;
  }

  Place& at(int k) noexcept { return vias_[static_cast<std::size_t>(k)]; }
  const Place& at(int k) const noexcept { return vias_[static_cast<std::size_t>(k)]; }

  int first_ahead(double now) const noexcept {
    int k = 0;
    while (k < count_ && at(k).phase <= now) ++k;
    return k;
  }
  int find(double phase) const noexcept {
    for (int k = 0; k < count_; ++k)
      if (std::abs(at(k).phase - phase) < kSame) return k;
    return -1;
  }
  bool is_clear_of_others(double phase) const noexcept {
    for (int k = 0; k < count_; ++k)
      if (std::abs(at(k).phase - phase) < kLeastReach - kSame) return false;
    return true;
  }
  /// Forgets what lies behind where that makes the room.
  bool has_room(double now) noexcept {
    if (count_ < room_) return true;
    const int behind = first_ahead(now);
    std::rotate(vias_.begin(), vias_.begin() + behind, vias_.begin() + count_);
    count_ -= behind;
    return count_ < room_;
  }
  /// A free place in the order of the phases.
  int open_at(double phase) noexcept {
    int k = count_++;
    for (; k > 0 && at(k - 1).phase > phase; --k) std::swap(at(k), at(k - 1));
    return k;
  }
  /// Value and rate of the offset with which the motion passes the k-th.
  void look_at(int k, const Phase& phase, const double* near) noexcept {
    Place& via = at(k);
    scout_.look(via.phase);
    const typename Space::Output own = scout_.system().output();
    In::between(own, via.point, near, values_.row(k).data());
    if (via.with_velocity) {
      state_.row(1) = phase.duration() * via.velocity.transpose();
      In::rate(own, values_.row(k).data(), state_.row(1).data(), rates_.row(k).data());
    }
    via.seen_from = via.phase - phase.s();
  }

  Runner<Space> scout_;
  OffsetPath path_;
  double end_;
  int room_;
  int count_ = 0;
  std::vector<Place> vias_;  // in the order of their phases
  bool stale_ = false;
  double release_ = 0.0;  // where an offset ends that no via-point takes over
  std::vector<OffsetPath::Aim> aims_;
  RowMatrix values_;
  RowMatrix rates_;
  RowMatrix state_;  // scratch: value, rate, second
  CouplingState<Space> seen_;
};

/// A runner with its adaptation, which belong together.
template <class Space>
struct AdaptedRunner {
  Runner<Space> runner;
  Adaptation<Space> adaptation;

  AdaptedRunner(const Runner<Space>& plain, const typename Space::Point& point, Eigen::Index axes, int room)
      : runner(plain), adaptation(plain, point, axes, room) {
    runner.set_offset(&adaptation.offset());
  }
  AdaptedRunner(const AdaptedRunner& other) : runner(other.runner), adaptation(other.adaptation) {
    runner.set_offset(&adaptation.offset());
  }
  AdaptedRunner& operator=(const AdaptedRunner&) = delete;

  /// The outputs are a point with a velocity and an acceleration (d), per s, from where they come onto the
  /// motion within the reach.
  template <class PointArgument>
  void bridge_from(const PointArgument& point, const double* velocity, const double* acceleration,
                   const Reach& reach) noexcept {
    adaptation.forget_offset();
    runner.republish();
    adaptation.bridge(runner.phase(), runner.system().output(), point, velocity, acceleration, reach.rise);
    runner.republish();
  }

  const System<Space>& system() const noexcept { return runner.system(); }
  double now() const noexcept { return runner.phase().s(); }

  Status step(double dt, const Coupling<Space>* coupling = nullptr) noexcept {
    runner.release();
    return step_on(dt, coupling);
  }

  /// The same in pieces, each as the filter lets it be.
  Status step(double dt, SafetyStep& filter, const Coupling<Space>* coupling = nullptr) noexcept {
    const double pieces = filter.pieces(dt, runner.phase().duration());
    if (!runner.takes(dt) || !runner.fits(filter) || pieces > SafetyStep::kMostPieces)
      return Status::invalid_input;
    filter.begin_call();
    if (dt == 0.0) return step_on(dt, coupling);
    Status status = runner.status();
    for (int piece = 0; piece < static_cast<int>(pieces) && status != Status::not_finite; ++piece)
      status = step_filtered(dt / pieces, filter, coupling);
    return status;
  }

 private:
  Status step_on(double dt, const Coupling<Space>* coupling) noexcept {
    if (adaptation.is_stale()) adaptation.aim(runner);
    const Status status = runner.step(dt, coupling);
    if (adaptation.offset().active()) adaptation.follow(runner);
    return status;
  }
  Status step_filtered(double dt, SafetyStep& filter, const Coupling<Space>* coupling) noexcept {
    runner.hold();
    const Status status = step_on(dt, coupling);
    if (status == Status::not_finite || status == Status::invalid_input) return status;
    filter.begin(dt, runner.phase().duration());
    if (runner.confine(filter)) adaptation.changed(now());
    filter.end();
    return filter.blocked() ? runner.block() : status;
  }
};

}  // namespace dmp::detail
