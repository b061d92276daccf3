#include "primitive/learning.hpp"

#include <dmp/error.hpp>
#include <dmp/so3.hpp>
#include <dmp/spline.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "geometry/exponential_rates.hpp"
#include "motion/continuous_quaternions.hpp"
#include "primitive/forcing_scale.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

VectorXd range(const RowMatrix& values) { return values.colwise().maxCoeff() - values.colwise().minCoeff(); }

/// Second-order differences: central inside, one-sided at the ends; any grid.
RowMatrix gradient(const VectorXd& t, const RowMatrix& y) {
  const Index n = t.size();
  RowMatrix rate(n, y.cols());
  rate.row(0) = (y.row(1) - y.row(0)) / (t[1] - t[0]);
  rate.row(n - 1) = (y.row(n - 1) - y.row(n - 2)) / (t[n - 1] - t[n - 2]);
  for (Index k = 1; k + 1 < n; ++k) {
    const double before = t[k] - t[k - 1];
    const double after = t[k + 1] - t[k];
    rate.row(k) = (before / after * (y.row(k + 1) - y.row(k)) + after / before * (y.row(k) - y.row(k - 1))) /
                  (before + after);
  }
  return rate;
}

Trajectory looked_at(const Demonstration& demonstration, const DmpOptions& options) {
  if (options.derivatives != Derivatives::gradient)
    return demonstration.at(fit_times(demonstration.time(), options));
  const VectorXd& time = demonstration.time();
  const RowMatrix velocity = gradient(time, demonstration.position());
  return {time, demonstration.position(), velocity, gradient(time, velocity)};
}

RowMatrix difference_velocity(const VectorXd& t, const Rotations& r) {
  const Index n = t.size();
  RowMatrix omega(n, 3);
  for (Index k = 0; k < n; ++k) {
    const Index before = std::max<Index>(k - 1, 0);
    const Index after = std::min<Index>(k + 1, n - 1);
    omega.row(k) =
        so3::log(Eigen::Matrix3d(r[after] * r[before].transpose())).transpose() / (t[after] - t[before]);
  }
  return omega;
}

OrientationTrajectory looked_at(const OrientationDemonstration& demonstration, const DmpOptions& options) {
  if (options.derivatives != Derivatives::gradient)
    return demonstration.at(fit_times(demonstration.time(), options));
  const VectorXd& time = demonstration.time();
  const RowMatrix omega = difference_velocity(time, demonstration.rotation());
  return {time, demonstration.rotation(), omega, gradient(time, omega)};
}

/// e_k = Log(Rg R_k^T), the branch followed backward from e = 0 at the end.
RowMatrix errors_to_goal(const Rotations& rotations, LogBranch branch) {
  const Index n = static_cast<Index>(rotations.size());
  RowMatrix errors(n, 3);
  const Eigen::Quaterniond goal(rotations.back());
  Vector3d later = Vector3d::Zero();
  for (Index k = n - 1; k >= 0; --k) {
    const Eigen::Quaterniond turn = goal * Eigen::Quaterniond(rotations[k]).conjugate();
    later = branch == LogBranch::lifted ? so3::lifted_log(turn, later) : so3::log(turn);
    errors.row(k) = later.transpose();
  }
  return errors;
}

/// tau^2 acceleration - alpha (beta error - tau velocity); `error` may be an expression.
template <class Error>
RowMatrix forcing_of(double tau, double alpha, double beta, RowMatrix acceleration, const Error& error,
                     const RowMatrix& velocity) {
  acceleration = tau * tau * acceleration - alpha * (beta * error - tau * velocity);
  return acceleration;
}

RowMatrix orientation_forcing(const OrientationTrajectory& motion, const RowMatrix& errors, double tau,
                              const DmpOptions& options) {
  const double alpha = *options.orientation_alpha;
  const double beta = *options.orientation_beta;
  if (options.orientation_form != OrientationForm::log_linear)
    return forcing_of(tau, alpha, beta, motion.angular_acceleration, errors, motion.angular_velocity);
  const Spline::Samples p = Spline(motion.time, -errors).sample(motion.time);
  return forcing_of(tau, alpha, beta, p.second, errors, p.first);
}

/// The forcing term of p in R = Exp(p) Q: p, p' and p'' from those of R, analytically.
RowMatrix turning_forcing(const OrientationTrajectory& motion, double tau, const DmpOptions& options,
                          const TurningReference& reference) {
  const double stiffness = *options.orientation_alpha * *options.orientation_beta;
  const Index n = motion.time.size();
  const auto log_at = [&](Index k, const TurningReference::State& with) {
    return so3::log(Eigen::Quaterniond(Eigen::Quaterniond(motion.rotation[static_cast<std::size_t>(k)]) *
                                       with.turn.conjugate()));
  };
  const Vector3d goal = log_at(n - 1, reference.at(1.0));
  RowMatrix forcing(n, 3);
  for (Index k = 0; k < n; ++k) {
    const TurningReference::State with = reference.at(motion.time[k] / tau);
    const Vector3d p = log_at(k, with);
    const Eigen::Quaterniond turn = so3::exp_quaternion(p);
    const ExponentialRates rates(p, turn);
    const Eigen::Matrix3d inverse = so3::left_jacobian_inverse(p);
    const Vector3d along = turn * with.velocity;
    const Vector3d v = inverse * (tau * motion.angular_velocity.row(k).transpose() - along);
    const Vector3d own = rates.velocity(v);
    const Vector3d rest =
        turn * with.acceleration + own.cross(along) + rates.acceleration(v, Vector3d::Zero());
    const Vector3d a = inverse * (tau * tau * motion.angular_acceleration.row(k).transpose() - rest);
    forcing.row(k) = (a - stiffness * (goal - p) + *options.orientation_alpha * v).transpose();
  }
  return forcing;
}

/// (g - y0) scales only an axis that ends elsewhere than it starts, measured by the range it covers.
void require_displacement(const VectorXd& displacement, const VectorXd& amplitude) {
  for (Index d = 0; d < displacement.size(); ++d)
    if (amplitude[d] > 0.0 && std::abs(displacement[d]) < 1e-9 * amplitude[d])
      throw InvalidArgument("scaling: axis " + std::to_string(d) + " of the demonstration ends " +
                            number(displacement[d]) + " from its start and covers " + number(amplitude[d]) +
                            ", so (goal - start) cannot scale its forcing term. Use Scaling::none or "
                            "Scaling::per_axis_relative.");
}

/// Two samples tell where from and where to, but no way and no velocity.
template <class Velocity>
void keep_spring_only(Velocity& start, ForcingTarget& target) {
  start.setZero();
  target.value.setZero();
}

}  // namespace

double largest_log(const OrientationDemonstration& demonstration, LogBranch branch) {
  return errors_to_goal(demonstration.rotation(), branch).rowwise().norm().maxCoeff();
}

namespace {

// Beyond this the spring of the UDE form grows weak and then pushes away across the axis, and the logarithm
// about the goal turns quickly near 2 pi.
constexpr double kNear = 2.0;
constexpr double kNearIfScaled = 3.0;

OrientationForm without_reference(double largest_log, const DmpOptions& options) {
  const bool far = options.log_branch == LogBranch::lifted && largest_log > kNearIfScaled;
  return far ? OrientationForm::log_linear : OrientationForm::ude;
}

std::optional<TurningReference> reference_along(
    const std::vector<const OrientationDemonstration*>& together) {
  std::vector<VectorXd> phases;
  std::vector<RowMatrix> tables;
  for (const OrientationDemonstration* one : together) {
    phases.push_back(one->time() / one->duration());
    tables.push_back(continuous_quaternions(one->rotation()));
    if (tables.back().row(0).dot(tables.front().row(0)) < 0.0) tables.back() *= -1.0;
  }
  return TurningReference::along(phases, tables);
}

}  // namespace

void settle_form(DmpOptions& options, double largest_log, const RowMatrix& reference) {
  const bool turns = reference.rows() > 0;
  if (options.orientation_form == OrientationForm::automatic)
    options.orientation_form = turns ? OrientationForm::turning : without_reference(largest_log, options);
  if (turns != (options.orientation_form == OrientationForm::turning))
    throw InvalidArgument(turns
                              ? "reference: given, expected none unless options.orientation_form is turning."
                              : "reference: none, expected one for options.orientation_form turning.");
  if (turns) TurningReference{reference};
}

std::optional<TurningReference> choose_form(DmpOptions& options,
                                            const std::vector<const OrientationDemonstration*>& together) {
  OrientationForm& form = options.orientation_form;
  double largest = 0.0;
  if (form == OrientationForm::automatic)
    for (const OrientationDemonstration* one : together)
      largest = std::max(largest, largest_log(*one, options.log_branch));
  const bool may_turn = options.log_branch == LogBranch::lifted && options.scaling == Scaling::none;
  const bool wanted =
      form == OrientationForm::turning || (form == OrientationForm::automatic && may_turn && largest > kNear);
  std::optional<TurningReference> reference;
  if (wanted) reference = reference_along(together);
  if (form == OrientationForm::turning && !reference)
    throw InvalidArgument(
        "demonstrations: turn too fast, or too differently, for one rotation to turn along with them. Use "
        "OrientationForm::log_linear, or learn them apart.");
  if (form == OrientationForm::automatic)
    form = reference ? OrientationForm::turning : without_reference(largest, options);
  return reference;
}

GaussianBasis basis_of(const DmpOptions& options) {
  if (options.kernels == Kernels::source) return GaussianBasis::source(options.basis_count, options.alpha_x);
  return GaussianBasis::equal_in_time(options.basis_count, options.alpha_x, *options.overlap);
}

VectorXd fit_times(const VectorXd& time, const DmpOptions& options) {
  const Index wanted = 10 * static_cast<Index>(options.basis_count) + 1;
  if (options.derivatives == Derivatives::gradient || time.size() >= wanted - 1) return time;
  return VectorXd::LinSpaced(wanted, 0.0, time[time.size() - 1]);
}

PositionLesson lesson_of(const Demonstration& given, const DmpOptions& options) {
  const std::optional<Demonstration> smoothed =
      options.derivatives == Derivatives::smooth ? std::optional(given.smoothed()) : std::nullopt;
  const Demonstration& demonstration = smoothed ? *smoothed : given;
  Trajectory motion = looked_at(demonstration, options);
  const double tau = demonstration.duration();
  PositionLesson lesson;
  lesson.start = demonstration.position().row(0);
  lesson.goal = demonstration.position().row(demonstration.size() - 1);
  lesson.start_z = tau * motion.velocity.row(0);
  if (options.start == Start::rest) lesson.start_z.setZero();
  lesson.amplitude = range(demonstration.position());
  const auto to_goal = (-motion.position).rowwise() + lesson.goal.transpose();
  lesson.target = {
      motion.time / tau,
      forcing_of(tau, options.alpha, *options.beta, std::move(motion.acceleration), to_goal, motion.velocity),
      VectorXd::Ones(lesson.start.size())};
  if (demonstration.size() < 3) keep_spring_only(lesson.start_z, lesson.target);
  return lesson;
}

OrientationLesson lesson_of(const OrientationDemonstration& given, const DmpOptions& options,
                            const TurningReference* reference) {
  const std::optional<OrientationDemonstration> smoothed =
      options.derivatives == Derivatives::smooth ? std::optional(given.smoothed()) : std::nullopt;
  const OrientationDemonstration& demonstration = smoothed ? *smoothed : given;
  const OrientationTrajectory motion = looked_at(demonstration, options);
  const double tau = demonstration.duration();
  const RowMatrix errors = errors_to_goal(motion.rotation, options.log_branch);
  OrientationLesson lesson;
  lesson.start = demonstration.rotation().front();
  lesson.goal = demonstration.rotation().back();
  lesson.start_eta = tau * motion.angular_velocity.row(0);
  if (options.start == Start::rest) lesson.start_eta.setZero();
  lesson.start_error = errors.row(0);
  lesson.amplitude = range(errors);
  lesson.target = {motion.time / tau, RowMatrix::Zero(motion.time.size(), 3), Vector3d::Ones()};
  if (reference) {
    lesson.target.value = turning_forcing(motion, tau, options, *reference);
  } else if (options.orientation_form != OrientationForm::turning) {
    lesson.target.value = orientation_forcing(motion, errors, tau, options);
  }
  if (demonstration.size() < 3) keep_spring_only(lesson.start_eta, lesson.target);
  return lesson;
}

void apply_scaling(ForcingTarget& target, Index first, const VectorXd& displacement,
                   const VectorXd& reference, const VectorXd& amplitude, const DmpOptions& options) {
  if (options.scaling == Scaling::none) return;
  const Index axes = displacement.size();
  if (options.scaling == Scaling::per_axis) require_displacement(displacement, amplitude);
  if (options.scaling != Scaling::rotation_dilation) {
    ForcingScale scale(options.scaling, reference, amplitude);
    scale.set(displacement);
    scale.apply(target.scale.segment(first, axes).data());
    return;
  }
  // target = c R f: turned back by R^T (the rotation of the inverse way), scaled by c on every axis.
  ForcingScale back(Scaling::rotation_dilation, displacement, amplitude);
  back.set(reference);
  if (displacement.norm() <= 1e-3 * amplitude.norm() || reference.norm() <= 1e-3 * amplitude.norm()) return;
  const double dilation = displacement.norm() / reference.norm();
  for (Index k = 0; k < target.value.rows(); ++k) back.apply(target.value.row(k).data() + first);
  target.value.middleCols(first, axes) *= dilation;  // back.apply divided by it
  target.scale.segment(first, axes).setConstant(dilation);
}

}  // namespace dmp::detail
