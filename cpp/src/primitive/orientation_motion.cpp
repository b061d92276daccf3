#include "primitive/orientation_motion.hpp"

#include <dmp/so3.hpp>

#include <cmath>

#include "geometry/exponential_rates.hpp"
#include "geometry/flush.hpp"

namespace dmp::detail {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

double alpha_of(const DmpOptions& options) { return *options.orientation_alpha; }

/// J_l(u)^-1 v up to the order that a fourth-order step needs; u is the turn within the step.
Vector3d small_inverse_jacobian(const Vector3d& u, const Vector3d& v) noexcept {
  const Vector3d uv = u.cross(v);
  return v - 0.5 * uv + u.cross(uv) / 12.0;
}

/// Back to length 1 to first order: the steps leave it by rounding only.
void renormalise(Quaterniond& q) noexcept {
  q.coeffs() *= 1.5 - 0.5 * q.squaredNorm();
  q.coeffs() = flushed<Eigen::Array4d>(q.coeffs());  // on the way to the identity
}

}  // namespace

OrientationMotion::OrientationMotion(const DmpOptions& options, const Eigen::Matrix3d& start,
                                     const Eigen::Matrix3d& goal, const Vector3d& start_error,
                                     const Vector3d& eta, const Vector3d& amplitude,
                                     const RowMatrix& reference)
    : integrator_(options.integrator),
      form_(options.orientation_form),
      branch_(options.log_branch),
      unscaled_(options.scaling == Scaling::none),
      goal_filter_(options.goal_filter),
      spring_(alpha_of(options), *options.orientation_beta),
      scale_(options.scaling, start_error, amplitude),
      model_error_(start_error),
      q_(Quaterniond(start).normalized()),
      eta_(eta),
      e_(start_error),
      z_(Vector3d::Zero()),
      goal_(Quaterniond(goal).normalized()),
      target_(goal_),
      start_(q_),
      displacement_(start_error),
      rotation_(q_) {
  scale_.set(e_);
  follow_error();
  if (form_ != OrientationForm::turning) return;
  DmpOptions of_p = options;
  of_p.alpha = *options.orientation_alpha;
  of_p.beta = options.orientation_beta;
  const TurningReference turns(reference);
  const Vector3d zero = Vector3d::Zero();
  turning_.emplace(Turning{turns, PositionMotion(of_p, zero, zero, zero, zero),
                           turns.at(0.0).turn.conjugate(), turns.at(1.0).turn.conjugate()});
  set_turning_goal(true);
  begin_turning(q_, eta);
}

/// p = Log(R Q^-1), p' = J_l(p)^-1 eta: Q stands still at the start.
void OrientationMotion::begin_turning(const Quaterniond& rotation, const Vector3d& eta) noexcept {
  const Vector3d p = so3::log(Quaterniond(rotation * turning_->first));
  const Vector3d z = so3::left_jacobian_inverse(p) * eta;
  turning_->p.begin(p, z);
}

/// The goal of p, on the branch of the present one; back to the principal one where that leads far around.
void OrientationMotion::set_turning_goal(bool at_once) noexcept {
  constexpr double kFarthest = 4.0;  // rad
  const Quaterniond turn = target_ * turning_->last;
  const Vector3d present = turning_->p.goal();
  Vector3d goal = at_once ? so3::log(turn) : so3::lifted_log(turn, present);
  if (goal.norm() > kFarthest) goal = so3::log(turn);
  if (at_once) return turning_->p.start_with_goal(goal);
  turning_->p.set_goal(goal);
}

Vector3d OrientationMotion::error(const Quaterniond& goal, const Quaterniond& q) const noexcept {
  const Quaterniond turn = goal * q.conjugate();
  return branch_ == LogBranch::lifted ? so3::lifted_log(turn, e_) : so3::log(turn);
}

void OrientationMotion::begin(const Quaterniond& rotation, const Vector3d& eta) noexcept {
  if (turning_) {
    set_turning_goal(true);
    return begin_turning(rotation, eta);
  }
  start_ = rotation;
  q_ = rotation;
  eta_ = eta;
  e_ = model_error_;  // the branch to start on
  displacement_ = model_error_;
  jump_to_goal();
}

void OrientationMotion::set_goal(const Quaterniond& goal) noexcept {
  target_ = goal;
  if (turning_) return set_turning_goal(false);
  settled_ = false;
  if (goal_filter_ == 0.0) jump_to_goal();
}

/// The scale follows the goal as filtered: the forcing term does not jump.
void OrientationMotion::rescale() noexcept {
  if (unscaled_) return;
  const Quaterniond turn = goal_ * start_.conjugate();
  displacement_ = branch_ == LogBranch::lifted ? so3::lifted_log(turn, displacement_) : so3::log(turn);
  scale_.set(displacement_);
}

void OrientationMotion::start_with_goal(const Quaterniond& goal) noexcept {
  if (turning_) {
    target_ = goal;
    return set_turning_goal(true);
  }
  set_goal(goal);
  jump_to_goal();
}

void OrientationMotion::jump_to_goal() noexcept {
  goal_ = target_;
  settled_ = true;
  follow_goal();
  rescale();
}

void OrientationMotion::follow_goal() noexcept {
  e_ = error(goal_, q_);
  follow_error();
}

/// What the log-linear form goes by, from the error and the velocity.
void OrientationMotion::follow_error() noexcept {
  if (form_ != OrientationForm::log_linear) return;
  z_ = so3::left_jacobian_inverse(-e_) * eta_;
  turn_ = so3::exp_quaternion(-e_);
}

const double* OrientationMotion::scaled(const double* forcing, int node) noexcept {
  if (unscaled_) return forcing;
  double* const row = scratch_.row(node).data();
  for (int d = 0; d < 3; ++d) row[d] = forcing[d];
  scale_.apply(row);
  return row;
}

Quaterniond OrientationMotion::filtered_goal(double piece) const noexcept {
  const Vector3d way = so3::log(Quaterniond(target_ * goal_.conjugate()));
  return so3::exp_quaternion((1.0 - std::exp(-goal_filter_ * piece)) * way) * goal_;
}

Vector3d OrientationMotion::acceleration(const Vector3d& e, const Vector3d& eta,
                                         const double* f) const noexcept {
  return spring_.stiffness() * e - spring_.alpha() * eta + Vector3d(f[0], f[1], f[2]);
}

void OrientationMotion::advance(double step, const ForcingNodes& forcing) noexcept {
  if (turning_) return turning_->p.advance(step, forcing);
  const double* end = scaled(forcing.end, 2);
  if (integrator_ == Integrator::semi_implicit_euler) {
    advance_euler(step, end);
  } else if (form_ == OrientationForm::log_linear) {
    advance_log_linear(step, scaled(forcing.start, 0), scaled(forcing.middle, 1), end);
  } else {
    advance_ude(step, scaled(forcing.start, 0), scaled(forcing.middle, 1), end);
  }
  renormalise(q_);
  if (!settled_) rescale();
  // Nearer than rounding tells: the filter has arrived.
  if (!settled_ && (target_ * goal_.conjugate()).vec().norm() < 1e-15) jump_to_goal();
}

/// The Runge-Kutta-Munthe-Kaas method of fourth order: R = Exp(u) R_n with ud = J_l(u)^-1 eta, so that R
/// stays on SO(3) (Munthe-Kaas 1998, BIT 38).
void OrientationMotion::advance_ude(double step, const double* start, const double* middle,
                                    const double* end) noexcept {
  const double half = 0.5 * step;
  const Quaterniond goal_middle = settled_ ? goal_ : filtered_goal(half);
  const Quaterniond goal_end = settled_ ? goal_ : filtered_goal(step);

  const Vector3d v1 = eta_;
  const Vector3d a1 = acceleration(e_, eta_, start);

  const Vector3d u2 = half * v1;
  const Vector3d eta2 = eta_ + half * a1;
  const Vector3d v2 = small_inverse_jacobian(u2, eta2);
  const Vector3d a2 = acceleration(error(goal_middle, so3::exp_quaternion(u2) * q_), eta2, middle);

  const Vector3d u3 = half * v2;
  const Vector3d eta3 = eta_ + half * a2;
  const Vector3d v3 = small_inverse_jacobian(u3, eta3);
  const Vector3d a3 = acceleration(error(goal_middle, so3::exp_quaternion(u3) * q_), eta3, middle);

  const Vector3d u4 = step * v3;
  const Vector3d eta4 = eta_ + step * a3;
  const Vector3d v4 = small_inverse_jacobian(u4, eta4);
  const Vector3d a4 = acceleration(error(goal_end, so3::exp_quaternion(u4) * q_), eta4, end);

  q_ = so3::exp_quaternion(step / 6.0 * (v1 + 2.0 * (v2 + v3) + v4)) * q_;
  eta_ += step / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
  eta_ = flushed<Eigen::Array3d>(eta_);
  goal_ = goal_end;
  e_ = error(goal_, q_);
}

/// p = -e obeys the linear equation of positions with the goal 0, which has an exact step.
void OrientationMotion::advance_log_linear(double step, const double* start, const double* middle,
                                           const double* end) noexcept {
  if (!settled_) {  // the goal stands still within a step; R and omega do not jump
    goal_ = filtered_goal(step);
    follow_goal();
  }
  spring_.prepare(step);
  Vector3d p = -e_;
  for (int d = 0; d < 3; ++d) spring_.advance(p[d], z_[d], start[d], middle[d], end[d]);
  turn_to(p);
}

/// R = Exp(p) Rg, after a step of the log-linear form.
void OrientationMotion::turn_to(const Vector3d& p) noexcept {
  e_ = -p;
  turn_ = so3::exp_quaternion(p);
  q_ = turn_ * goal_;
  if (!settled_) eta_ = ExponentialRates(p, turn_).velocity(z_);  // what the next goal finds
}

void OrientationMotion::advance_euler(double step, const double* end) noexcept {
  if (!settled_) {
    goal_ = filtered_goal(step);
    follow_goal();
  }
  if (form_ == OrientationForm::log_linear) {
    z_ += step * acceleration(e_, z_, end);
    z_ = flushed<Eigen::Array3d>(z_);
    return turn_to(flushed<Eigen::Array3d>(step * z_ - e_));
  }
  eta_ += step * acceleration(e_, eta_, end);
  eta_ = flushed<Eigen::Array3d>(eta_);
  q_ = so3::exp_quaternion(step * eta_) * q_;
  e_ = error(goal_, q_);
}

/// eta = J_l p' + Exp(p) omega_Q and its rate, omega_Q that of the reference.
bool OrientationMotion::look_turning(double speed, double speed_rate, const double* forcing) noexcept {
  if (!turning_->p.look(1.0, 0.0, forcing)) return false;
  turning_->p.publish();
  const Vector3d p = turning_->p.position();
  const Vector3d v = turning_->p.velocity();
  const Vector3d a = turning_->p.acceleration();
  const TurningReference::State with = turning_->reference.at(phase_);
  turn_ = so3::exp_quaternion(p);
  const ExponentialRates rates(p, turn_);
  const Vector3d own = rates.velocity(v);
  const Vector3d along = turn_ * with.velocity;
  eta_ = own + along;
  const Vector3d change = rates.acceleration(v, a) + turn_ * with.acceleration + own.cross(along);
  q_ = turn_ * with.turn;
  renormalise(q_);
  next_velocity_ = eta_ * speed;
  next_acceleration_ = change * (speed * speed) + eta_ * speed_rate;
  return q_.coeffs().allFinite() && next_velocity_.allFinite() && next_acceleration_.allFinite();
}

bool OrientationMotion::look(double speed, double speed_rate, const double* forcing) noexcept {
  if (turning_) return look_turning(speed, speed_rate, forcing);
  const double* const f = scaled(forcing, 3);
  Vector3d change;
  if (form_ == OrientationForm::log_linear) {
    const ExponentialRates rates(-e_, turn_);
    eta_ = rates.velocity(z_);
    change = rates.acceleration(z_, acceleration(e_, z_, f));
  } else {
    change = this->acceleration(e_, eta_, f);
  }
  next_velocity_ = eta_ * speed;
  next_acceleration_ = change * (speed * speed) + eta_ * speed_rate;
  return q_.coeffs().allFinite() && next_velocity_.allFinite() && next_acceleration_.allFinite();
}

void OrientationMotion::publish() noexcept {
  rotation_ = q_;
  velocity_ = next_velocity_;
  acceleration_ = next_acceleration_;
}

}  // namespace dmp::detail
