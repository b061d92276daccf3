#pragma once
// The demonstrations that the tests share, in closed form.

#include <dmp/demonstration.hpp>
#include <dmp/dmp.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/so3.hpp>

#include <cmath>

namespace motions {

using namespace dmp;

inline Eigen::VectorXd grid(int count, double end) { return Eigen::VectorXd::LinSpaced(count, 0.0, end); }

inline double minimum_jerk(double s) { return s * s * s * (10 - 15 * s + 6 * s * s); }

/// The helix of the source: x = sin, y = cos, z linear; radius and rise as given, `turns` of it in `duration`
/// s.
inline Demonstration helix(int count, double duration, double radius, double rise, double turns) {
  const Eigen::VectorXd t = grid(count, duration);
  RowMatrix y(count, 3);
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * turns * t[k] / duration;
    y.row(k) << radius * std::sin(angle), radius * std::cos(angle), rise * t[k] / duration;
  }
  return {t, y};
}

inline Demonstration reach(int count, double duration) {
  const Eigen::VectorXd t = grid(count, duration);
  RowMatrix y(count, 3);
  for (int k = 0; k < count; ++k) y.row(k) = minimum_jerk(t[k] / duration) * Eigen::RowVector3d(.3, -.2, .4);
  return {t, y};
}

inline Eigen::Matrix3d euler_path(double u) {
  return so3::from_euler({.8 * std::sin(u), .5 * std::cos(u), .6 * u}, "ZYX");
}

/// Euler angles (.8 sin u, .5 cos u, .6 u) while u goes from 0 to `end` in `duration` s.
inline OrientationDemonstration rotation(int count, double duration, double end) {
  const Eigen::VectorXd t = grid(count, duration);
  Rotations r;
  for (int k = 0; k < count; ++k) r.push_back(euler_path(end * t[k] / duration));
  return {t, r};
}

inline PoseDemonstration pose(int count, double duration, double turns = 2) {
  const Demonstration p = helix(count, duration, .1, .2, turns);
  const OrientationDemonstration r = rotation(count, duration, 3.0);
  Poses poses;
  for (int k = 0; k < count; ++k) poses.push_back(pose_of(r.rotation()[k], p.position().row(k)));
  return {p.time(), poses};
}

/// Locally weighted regression with 100 kernels on the samples as they are: nothing is chosen by the data.
inline DmpOptions stated() {
  DmpOptions options;
  options.basis_count = 100;
  options.regression = Regression::lwr;
  options.derivatives = Derivatives::interpolate;
  return options;
}

/// Every axis ends elsewhere than it starts, as every scaling needs it.
inline PoseDemonstration pose_with_goal_apart(int count, double duration) {
  return pose(count, duration, 1.3);
}

/// Spring and damper alone, from y0 to g at rest.
inline Dmp spring(double y0, double g, double duration, double alpha = 25.0, double beta = 6.25) {
  DmpParameters p;
  p.options.basis_count = 5;
  p.options.alpha = alpha;
  p.options.beta = beta;
  p.duration = duration;
  p.start = Eigen::VectorXd::Constant(1, y0);
  p.goal = Eigen::VectorXd::Constant(1, g);
  p.start_velocity = Eigen::VectorXd::Zero(1);
  p.amplitude = Eigen::VectorXd::Constant(1, std::abs(g - y0));
  p.weights = RowMatrix::Zero(5, 1);
  return Dmp(p);
}

inline double rmse(const RowMatrix& a, const RowMatrix& b) {
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(a.rows()));
}

inline double largest(const RowMatrix& a, const RowMatrix& b) { return (a - b).rowwise().norm().maxCoeff(); }

struct AngleErrors {
  double rmse;
  double largest;
};
inline AngleErrors angles(const Rotations& a, const Rotations& b) {
  double sum = 0.0;
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double angle = so3::distance(a[k], b[k]);
    sum += angle * angle;
    most = std::max(most, angle);
  }
  return {std::sqrt(sum / static_cast<double>(a.size())), most};
}

}  // namespace motions
