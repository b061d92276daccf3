#include "primitive/rotation_system.hpp"

#include <dmp/so3.hpp>

#include <cmath>

#include "geometry/exponential_rates.hpp"
#include "geometry/flush.hpp"
#include "geometry/pose.hpp"

namespace dmp::detail {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

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

RotationSystem::RotationSystem(const DmpOptions& options, const Ends<RotationSpace>& ends)
    : integrator_(options.integrator),
      form_(options.orientation_form),
      branch_(options.log_branch),
      spring_(*options.orientation_alpha, *options.orientation_beta),
      scale_(options, ends.displacement, ends.amplitude),
      goal_(options.goal_filter, unit_quaternion(ends.goal)),
      start_(unit_quaternion(ends.start)),
      model_error_(ends.displacement),
      displacement_(ends.displacement),
      q_(start_),
      eta_(ends.z),
      e_(ends.displacement),
      outputs_{q_, Vector3d::Zero(), Vector3d::Zero()},
      held_(outputs_) {
  scale_.set(displacement_);
  follow_error();
  if (form_ != OrientationForm::turning) return;
  turning_.emplace(options, ends.reference);
  turning_->start_with_goal(goal_.target());
  turning_->begin(q_, eta_);
}

Vector3d RotationSystem::error(const Quaterniond& goal, const Quaterniond& q) const noexcept {
  const Quaterniond turn = goal * q.conjugate();
  return branch_ == LogBranch::lifted ? so3::lifted_log(turn, e_) : so3::log(turn);
}

void RotationSystem::begin(const Eigen::Matrix3d& rotation, RotationSpace::TangentArgument eta) noexcept {
  if (turning_) {
    turning_->start_with_goal(goal_.target());
    return turning_->begin(unit_quaternion(rotation), eta);
  }
  start_ = unit_quaternion(rotation);
  q_ = start_;
  eta_ = eta;
  e_ = model_error_;  // the branch to start on
  displacement_ = model_error_;
  jump_to_goal();
}

void RotationSystem::set_goal(const Eigen::Matrix3d& goal) noexcept {
  goal_.set(unit_quaternion(goal));
  if (turning_) return turning_->set_goal(goal_.target());
  if (goal_.settled()) jump_to_goal();
}

void RotationSystem::start_with_goal(const Eigen::Matrix3d& goal) noexcept {
  goal_.set(unit_quaternion(goal));
  if (turning_) return turning_->start_with_goal(goal_.target());
  jump_to_goal();
}

void RotationSystem::jump_to_goal() noexcept {
  goal_.jump();
  follow_goal();
  rescale();
}

/// The scale follows the goal as filtered: the drive does not jump.
void RotationSystem::rescale() noexcept {
  if (scale_.is_fixed()) return;
  const Quaterniond turn = goal_.goal() * start_.conjugate();
  displacement_ = branch_ == LogBranch::lifted ? so3::lifted_log(turn, displacement_) : so3::log(turn);
  scale_.set(displacement_);
}

void RotationSystem::follow_goal() noexcept {
  e_ = error(goal_.goal(), q_);
  follow_error();
}

/// What the log-linear form goes by, from the error and the velocity.
void RotationSystem::follow_error() noexcept {
  if (form_ != OrientationForm::log_linear) return;
  z_ = so3::left_jacobian_inverse(-e_) * eta_;
  turn_ = so3::exp_quaternion(-e_);
}

/// p'' for an angular acceleration in the world frame, but for terms of the velocity.
void RotationSystem::to_drive(double* tangent) const noexcept {
  if (form_ == OrientationForm::ude) return;
  const Vector3d p = turning_ ? turning_->p() : Vector3d(-e_);
  Eigen::Map<Vector3d> c(tangent);
  c = so3::left_jacobian_inverse(p) * Vector3d(c);
}

Vector3d RotationSystem::acceleration(const Vector3d& e, const Vector3d& eta,
                                      const double* drive) const noexcept {
  return spring_.stiffness() * e - spring_.alpha() * eta + Vector3d(drive[0], drive[1], drive[2]);
}

void RotationSystem::advance(double step, const Nodes& drive) noexcept {
  if (turning_) return turning_->advance(step, drive);
  if (integrator_ == Integrator::semi_implicit_euler) {
    advance_euler(step, drive.end);
  } else if (form_ == OrientationForm::log_linear) {
    advance_log_linear(step, drive);
  } else {
    advance_ude(step, drive);
  }
  renormalise(q_);
  if (goal_.settled()) return;
  rescale();
  if (goal_.settle()) jump_to_goal();
}

/// The Runge-Kutta-Munthe-Kaas method of fourth order: R = Exp(u) R_n with ud = J_l(u)^-1 eta, so that R
/// stays on SO(3) (Munthe-Kaas 1998, BIT 38).
void RotationSystem::advance_ude(double step, const Nodes& drive) noexcept {
  const double half = 0.5 * step;
  const Quaterniond goal_middle = goal_.settled() ? goal_.goal() : goal_.after(half);
  const Quaterniond goal_end = goal_.settled() ? goal_.goal() : goal_.after(step);

  const Vector3d v1 = eta_;
  const Vector3d a1 = acceleration(e_, eta_, drive.start);

  const Vector3d u2 = half * v1;
  const Vector3d eta2 = eta_ + half * a1;
  const Vector3d v2 = small_inverse_jacobian(u2, eta2);
  const Vector3d a2 = acceleration(error(goal_middle, so3::exp_quaternion(u2) * q_), eta2, drive.middle);

  const Vector3d u3 = half * v2;
  const Vector3d eta3 = eta_ + half * a2;
  const Vector3d v3 = small_inverse_jacobian(u3, eta3);
  const Vector3d a3 = acceleration(error(goal_middle, so3::exp_quaternion(u3) * q_), eta3, drive.middle);

  const Vector3d u4 = step * v3;
  const Vector3d eta4 = eta_ + step * a3;
  const Vector3d v4 = small_inverse_jacobian(u4, eta4);
  const Vector3d a4 = acceleration(error(goal_end, so3::exp_quaternion(u4) * q_), eta4, drive.end);

  q_ = so3::exp_quaternion(step / 6.0 * (v1 + 2.0 * (v2 + v3) + v4)) * q_;
  eta_ += step / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
  eta_ = flushed<Eigen::Array3d>(eta_);
  if (!goal_.settled()) goal_.advance(goal_.left_after(step));
  e_ = error(goal_end, q_);
}

/// Within a step of the linear forms the goal stands still; R and omega do not jump.
void RotationSystem::advance_goal(double step) noexcept {
  if (goal_.settled()) return;
  goal_.advance(goal_.left_after(step));
  follow_goal();
}

/// p = -e obeys the linear equation of positions with the goal 0, which has an exact step.
void RotationSystem::advance_log_linear(double step, const Nodes& drive) noexcept {
  advance_goal(step);
  spring_.prepare(step);
  Vector3d p = -e_;
  for (int d = 0; d < 3; ++d) spring_.advance(p[d], z_[d], drive.start[d], drive.middle[d], drive.end[d]);
  turn_to(p);
}

/// R = Exp(p) Rg, after a step of the log-linear form.
void RotationSystem::turn_to(const Vector3d& p) noexcept {
  e_ = -p;
  turn_ = so3::exp_quaternion(p);
  q_ = turn_ * goal_.goal();
  if (!goal_.settled()) eta_ = ExponentialRates(p, turn_).velocity(z_);  // what the next goal finds
}

void RotationSystem::advance_euler(double step, const double* drive) noexcept {
  advance_goal(step);
  if (form_ == OrientationForm::log_linear) {
    z_ += step * acceleration(e_, z_, drive);
    z_ = flushed<Eigen::Array3d>(z_);
    return turn_to(flushed<Eigen::Array3d>(step * z_ - e_));
  }
  eta_ += step * acceleration(e_, eta_, drive);
  eta_ = flushed<Eigen::Array3d>(eta_);
  q_ = so3::exp_quaternion(step * eta_) * q_;
  e_ = error(goal_.goal(), q_);
}

bool RotationSystem::compute_outputs(double speed, double speed_rate, const double* drive) noexcept {
  Vector3d change;
  if (turning_) {
    const TurningSystem::State state = turning_->state(drive);
    q_ = state.rotation;
    renormalise(q_);
    eta_ = state.eta;
    change = state.eta_rate;
  } else if (form_ == OrientationForm::log_linear) {
    const ExponentialRates rates(-e_, turn_);
    eta_ = rates.velocity(z_);
    change = rates.acceleration(z_, acceleration(e_, z_, drive));
  } else {
    change = acceleration(e_, eta_, drive);
  }
  next_.angular_velocity = eta_ * speed;
  next_.angular_acceleration = change * (speed * speed) + eta_ * speed_rate;
  return q_.coeffs().allFinite() && next_.angular_velocity.allFinite() &&
         next_.angular_acceleration.allFinite();
}

void RotationSystem::publish() noexcept {
  outputs_.quaternion = q_;
  outputs_.angular_velocity = next_.angular_velocity;
  outputs_.angular_acceleration = next_.angular_acceleration;
}

void RotationSystem::hold() noexcept { held_ = outputs_; }

// R_out = Exp(Delta) R, and Delta stays: R takes what R_out took, seen from before that turn.
bool RotationSystem::confine(SafetyStep& filter, Eigen::Index, bool, double speed, double&) noexcept {
  const Quaterniond wanted = outputs_.quaternion;
  const Vector3d velocity = outputs_.angular_velocity;
  const TurnStep step{held_.quaternion, held_.angular_velocity, outputs_.quaternion,
                      outputs_.angular_velocity, outputs_.angular_acceleration};
  if (!filter.keep(step)) return false;
  const Quaterniond back = q_ * wanted.conjugate();
  const Vector3d turn = so3::log(Quaterniond(outputs_.quaternion * wanted.conjugate()));
  q_ = so3::exp_quaternion(back * turn) * q_;
  eta_ += back * Vector3d(outputs_.angular_velocity - velocity) / speed;
  if (turning_) {
    turning_->reseat(q_, eta_);
  } else {
    follow_goal();
  }
  return true;
}

Eigen::Matrix3d RotationSystem::point() const noexcept {
  return turning_ ? turning_->rotation().toRotationMatrix() : q_.toRotationMatrix();
}

Vector3d RotationSystem::eta() const noexcept {
  if (turning_) return turning_->eta();
  return form_ == OrientationForm::ude ? eta_ : ExponentialRates(-e_, turn_).velocity(z_);
}

void RotationSystem::velocity(double speed, double* out) const noexcept {
  Vector3d::Map(out) = eta() * speed;
}

}  // namespace dmp::detail
