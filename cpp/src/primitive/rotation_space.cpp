#include <dmp/error.hpp>
#include <dmp/so3.hpp>
#include <dmp/spline.hpp>

#include <cmath>
#include <optional>
#include <utility>

#include "geometry/exponential_rates.hpp"
#include "geometry/pose.hpp"
#include "primitive/advance.hpp"
#include "primitive/cycle.hpp"
#include "primitive/learning.hpp"
#include "primitive/space.hpp"
#include "primitive/turning_reference.hpp"

namespace dmp::detail {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using RotationGeometry = Geometry<RotationSpace>;

namespace {

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

OrientationTrajectory sampled(const OrientationDemonstration& demonstration, const DmpOptions& options) {
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

RowMatrix orientation_forcing(const OrientationTrajectory& motion, const RowMatrix& errors, double tau,
                              const DmpOptions& options) {
  const double alpha = *options.orientation_alpha;
  const double beta = *options.orientation_beta;
  if (options.orientation_form != OrientationForm::log_linear)
    return forcing_of(tau, alpha, beta, motion.angular_acceleration, errors, motion.angular_velocity);
  const Spline::Samples p = Spline(motion.time, -errors).sample(motion.time);
  return forcing_of(tau, alpha, beta, p.second, errors, p.first);
}

/// Exp(p) at a sample.
Quaterniond turn_from(const OrientationTrajectory& motion, Index k, const TurningReference::State& with) {
  return Quaterniond(motion.rotation[static_cast<std::size_t>(k)]) * with.turn.conjugate();
}

/// The forcing term of p in R = Exp(p) Q with its goal: p, p' and p'' from those of R, analytically.
RowMatrix turning_forcing(const OrientationTrajectory& motion, double tau, const DmpOptions& options,
                          const TurningReference& reference, const Vector3d& goal) {
  const double stiffness = *options.orientation_alpha * *options.orientation_beta;
  const Index n = motion.time.size();
  RowMatrix forcing(n, 3);
  Vector3d p = Vector3d::Zero();
  for (Index k = 0; k < n; ++k) {
    const TurningReference::State with = reference.at(motion.time[k] / tau);
    p = options.motion == Motion::rhythmic ? so3::lifted_log(turn_from(motion, k, with), p)
                                           : so3::log(turn_from(motion, k, with));
    const Quaterniond turn = so3::exp_quaternion(p);
    const ExponentialRates rates(p, turn);
    const Matrix3d inverse = so3::left_jacobian_inverse(p);
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

/// The displacement of p in R = Exp(p) Q, or with no Q that of R.
VectorXd way_in_form(const OrientationDemonstration& demonstration, const RowMatrix& errors,
                     const RowMatrix& reference) {
  if (reference.rows() == 0) return errors.row(0);
  const TurningReference along(reference);
  const auto p = [&](const Matrix3d& rotation, double s) {
    return so3::log(Quaterniond(Quaterniond(rotation) * along.at(s).turn.conjugate()));
  };
  return p(demonstration.rotation().back(), 1.0) - p(demonstration.rotation().front(), 0.0);
}

RowMatrix forcing_in_form(const OrientationTrajectory& motion, const RowMatrix& errors, double tau,
                          const DmpOptions& options, const RowMatrix& reference) {
  if (options.orientation_form != OrientationForm::turning)
    return orientation_forcing(motion, errors, tau, options);
  if (reference.rows() == 0) return RowMatrix::Zero(errors.rows(), 3);
  const TurningReference turning(reference);
  const Vector3d goal = so3::log(turn_from(motion, motion.time.size() - 1, turning.at(1.0)));
  return turning_forcing(motion, tau, options, turning, goal);
}

}  // namespace

Matrix3d RotationGeometry::projected(const Matrix3d& point) { return detail::projected(point); }

VectorXd RotationGeometry::displacement(const Matrix3d& start, const Matrix3d& goal, const VectorXd& near,
                                        const DmpOptions& options) {
  const Quaterniond turn = Quaterniond(goal) * Quaterniond(start).conjugate();
  return options.log_branch == LogBranch::lifted ? so3::lifted_log(turn, near) : so3::log(turn);
}

Ends<RotationSpace> RotationGeometry::ends_of(const OrientationDmpParameters& p) {
  return {p.start, p.goal, p.duration * p.start_velocity, p.start_error, p.amplitude, p.reference};
}

void RotationGeometry::set_ends(OrientationDmpParameters& p, const Ends<RotationSpace>& ends) {
  p.start = ends.start;
  p.goal = ends.goal;
  p.start_velocity = ends.z / p.duration;
  p.start_error = ends.displacement;
  p.amplitude = ends.amplitude;
  p.reference = ends.reference;
}

namespace {

/// Of one cycle about what turns on evenly: p in R = Exp(p) Q, on the branch that it follows.
Example<RotationSpace> cycle_of(const OrientationDemonstration& cycle, const DmpOptions& options,
                                const RowMatrix& reference) {
  require_closed(cycle);
  const OrientationTrajectory motion = round_of(cycle, cycle_samples(cycle.size(), options));
  const double tau = cycle.duration();
  const Matrix3d centre = TurningReference(reference).at(0.0).turn.toRotationMatrix();
  const Vector3d range = Vector3d::Constant(M_PI);  // scales nothing
  return {{motion.rotation.front(), centre, tau * motion.angular_velocity.row(0), Vector3d::Zero(), range,
           reference},
          {motion.time / tau,
           turning_forcing(motion, tau, options, TurningReference(reference), Vector3d::Zero()),
           Vector3d::Ones()},
          RowMatrix::Zero(motion.time.size(), 1)};
}

}  // namespace

Example<RotationSpace> RotationGeometry::example_of(const OrientationDemonstration& given,
                                                    const DmpOptions& options, const RowMatrix& reference) {
  if (options.motion == Motion::rhythmic)
    return cycle_of(options.derivatives == Derivatives::smooth ? given.smoothed() : given, options,
                    reference);
  const std::optional<OrientationDemonstration> smoothed =
      options.derivatives == Derivatives::smooth ? std::optional(given.smoothed()) : std::nullopt;
  const OrientationDemonstration& demonstration = smoothed ? *smoothed : given;
  const OrientationTrajectory motion = sampled(demonstration, options);
  const double tau = demonstration.duration();
  const RowMatrix errors = errors_to_goal(motion.rotation, options.log_branch);
  const VectorXd range = errors.colwise().maxCoeff() - errors.colwise().minCoeff();
  const VectorXd way = reference.rows() > 0 ? VectorXd::Zero(3) : VectorXd(errors.row(0));
  return {{demonstration.rotation().front(), demonstration.rotation().back(),
           tau * motion.angular_velocity.row(0), errors.row(0), range, reference},
          {motion.time / tau, forcing_in_form(motion, errors, tau, options, reference), Vector3d::Ones()},
          advance_along(motion.time / tau, motion.angular_velocity, way, range,
                        {*options.orientation_alpha, *options.orientation_beta}),
          way_in_form(demonstration, errors, reference)};
}

OrientationTrajectory RotationGeometry::room_for(const VectorXd& times, const Matrix3d&) {
  const RowMatrix room(times.size(), 3);
  return {times, Rotations(static_cast<std::size_t>(times.size())), room, room};
}

void RotationGeometry::record(OrientationTrajectory& trajectory, Index k, RotationSpace::Output output) {
  trajectory.rotation[static_cast<std::size_t>(k)] = output.quaternion.toRotationMatrix();
  trajectory.angular_velocity.row(k) = output.angular_velocity;
  trajectory.angular_acceleration.row(k) = output.angular_acceleration;
}

void RotationGeometry::deviation(RotationSpace::Output output, const OrientationDemonstration& demonstration,
                                 Index k, double* away) {
  Vector3d::Map(away) =
      minus(output.quaternion.toRotationMatrix(), demonstration.rotation()[static_cast<std::size_t>(k)]);
}

void RotationGeometry::add_second_differences(const OrientationDemonstration& demonstration, Index k,
                                              std::vector<double>& sizes) {
  const VectorXd& t = demonstration.time();
  const auto rate = [&](Index from) {
    const auto first = static_cast<std::size_t>(from);
    const Rotations& r = demonstration.rotation();
    return Vector3d(minus(r[first + 1], r[first]) / (t[from + 1] - t[from]));
  };
  sizes.push_back(2.0 * (rate(k) - rate(k - 1)).norm() / (t[k + 1] - t[k - 1]));
}

OrientationDemonstration RotationGeometry::denoised(const OrientationDemonstration& demonstration,
                                                    std::vector<NoiseEstimate>& found) {
  return demonstration.denoised(&found.emplace_back());
}

void RotationGeometry::add_extents(const OrientationDemonstration& demonstration,
                                   std::vector<Extent>& extents) {
  double extent = 0.3;  // rad; what turns less is no motion of the orientation
  for (const Matrix3d& rotation : demonstration.rotation())
    extent = std::max(extent, so3::distance(rotation, demonstration.rotation().front()));
  extents.push_back({3, extent, 1e-9});
}

double RotationGeometry::largest_log(const OrientationDemonstration& demonstration,
                                     const DmpOptions& options) {
  return errors_to_goal(demonstration.rotation(), options.log_branch).rowwise().norm().maxCoeff();
}

}  // namespace dmp::detail
