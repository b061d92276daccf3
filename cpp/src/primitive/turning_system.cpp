#include "primitive/turning_system.hpp"

#include <dmp/so3.hpp>

#include "geometry/exponential_rates.hpp"

namespace dmp::detail {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

DmpOptions of_vectors(DmpOptions options) {
  options.alpha = *options.orientation_alpha;
  options.beta = options.orientation_beta;
  return options;
}

Ends<VectorSpace> at_zero() {
  const VectorXd zero = VectorXd::Zero(3);
  return {zero, zero, zero, zero, zero, {}};
}

}  // namespace

TurningSystem::TurningSystem(const DmpOptions& options, const RowMatrix& reference)
    : reference_(reference),
      p_(of_vectors(options), at_zero()),
      first_(reference_.at(0.0).turn.conjugate()),
      last_(reference_.at(1.0).turn.conjugate()) {}

/// p = Log(R Q^-1), p' = J_l(p)^-1 (eta - Exp(p) omega_Q); only a rhythmic Q moves at the start.
void TurningSystem::begin(const Quaterniond& rotation, const Vector3d& eta) noexcept {
  const Vector3d p = so3::log(Quaterniond(rotation * first_));
  const Vector3d along = so3::exp_quaternion(p) * reference_.at(0.0).velocity;
  const Vector3d z = so3::left_jacobian_inverse(p) * (eta - along);
  p_.begin(p, z);
}

void TurningSystem::reseat(const Quaterniond& rotation, const Vector3d& eta) noexcept {
  const TurningReference::State with = reference_.at(phase_);
  const Vector3d p = so3::lifted_log(Quaterniond(rotation * with.turn.conjugate()), this->p());
  const Vector3d z = so3::left_jacobian_inverse(p) * (eta - so3::exp_quaternion(p) * with.velocity);
  p_.reseat(p, z);
}

void TurningSystem::set_goal(const Quaterniond& goal) noexcept {
  constexpr double kFarthest = 4.0;  // rad
  const Quaterniond turn = goal * last_;
  const Vector3d near = so3::lifted_log(turn, Vector3d(p_.goal()));
  p_.set_goal(near.norm() > kFarthest ? so3::log(turn) : near);
}

void TurningSystem::start_with_goal(const Quaterniond& goal) noexcept {
  p_.start_with_goal(so3::log(Quaterniond(goal * last_)));
}

/// eta = J_l p' + Exp(p) omega_Q and its rate, omega_Q that of the reference.
TurningSystem::State TurningSystem::state(const double* drive) noexcept {
  p_.compute_outputs(1.0, 0.0, drive);
  p_.publish();
  const Vector3d p = p_.output().position;
  const Vector3d v = p_.output().velocity;
  const Vector3d a = p_.output().acceleration;
  const TurningReference::State with = reference_.at(phase_);
  const Quaterniond turn = so3::exp_quaternion(p);
  const ExponentialRates rates(p, turn);
  const Vector3d own = rates.velocity(v);
  const Vector3d along = turn * with.velocity;
  return {turn * with.turn, own + along,
          rates.acceleration(v, a) + turn * with.acceleration + own.cross(along)};
}

Quaterniond TurningSystem::rotation() const noexcept {
  return so3::exp_quaternion(p()) * reference_.at(phase_).turn;
}

Vector3d TurningSystem::eta() const noexcept {
  const Quaterniond turn = so3::exp_quaternion(p());
  Vector3d v;
  p_.velocity(1.0, v.data());
  return ExponentialRates(p(), turn).velocity(v) + turn * reference_.at(phase_).velocity;
}

}  // namespace dmp::detail
