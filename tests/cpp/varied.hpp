#pragma once
// Motions that vary, seeded, and what the tests hold a distribution against: splines by their definition and
// dense matrices.

#include <dmp/demonstration.hpp>
#include <dmp/distribution.hpp>

#include <cmath>
#include <random>
#include <vector>

#include "motions.hpp"

namespace varied {

using namespace dmp;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Curves in the plane that share a way and differ by smooth deviations of about `spread`, samples noisy.
inline std::vector<Demonstration> curves(int count, unsigned seed, double spread = .1, double noise = .005,
                                         int samples = 60) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Demonstration> all;
  for (int j = 0; j < count; ++j) {
    const VectorXd t = motions::grid(samples, 1.0 + .1 * j);
    const double a = spread * normal(random), b = spread * normal(random), c = spread * normal(random);
    RowMatrix y(samples, 2);
    for (int k = 0; k < samples; ++k) {
      const double s = t[k] / t[samples - 1];
      y.row(k) << std::sin(3 * s) + a + b * s + noise * normal(random),
          s * s + b * std::cos(3 * s) + c * std::sin(5 * s) + noise * normal(random);
    }
    all.emplace_back(t, y);
  }
  return all;
}

/// Poses that reach and turn (`turns` of them), differing in where and how they do.
inline std::vector<PoseDemonstration> poses(int count, unsigned seed, double turns = .5, int samples = 80) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<PoseDemonstration> all;
  for (int j = 0; j < count; ++j) {
    const VectorXd t = motions::grid(samples, 2.0);
    const Eigen::Vector3d aside(normal(random), normal(random), normal(random));
    const Eigen::Vector3d twist(normal(random), normal(random), normal(random));
    Poses path;
    for (int k = 0; k < samples; ++k) {
      const double s = motions::minimum_jerk(t[k] / 2.0);
      const Eigen::Vector3d p = Eigen::Vector3d(.3 * s, .2 * std::sin(3 * s), .1) + .03 * s * aside;
      const Eigen::Vector3d way = 2 * M_PI * turns * s * Eigen::Vector3d(1, 2, 2) / 3;
      path.push_back(pose_of(so3::exp(.1 * s * twist) * so3::exp(way), p));
    }
    all.emplace_back(t, path);
  }
  return all;
}

/// B-spline i of degree p on clamped even knots, by its definition.
inline double b_spline(Index i, int p, double s, Index count, int degree = 3) {
  const auto knot = [&](Index k) {
    return std::min(std::max(static_cast<double>(k - degree) / static_cast<double>(count - degree), 0.0),
                    1.0);
  };
  if (p == 0) {
    const bool last = s >= 1.0 && knot(i) < 1.0 && knot(i + 1) >= 1.0;
    return (knot(i) <= s && s < knot(i + 1)) || last ? 1.0 : 0.0;
  }
  double value = 0.0;
  if (knot(i + p) > knot(i))
    value += (s - knot(i)) / (knot(i + p) - knot(i)) * b_spline(i, p - 1, s, count, degree);
  if (knot(i + p + 1) > knot(i + 1))
    value +=
        (knot(i + p + 1) - s) / (knot(i + p + 1) - knot(i + 1)) * b_spline(i + 1, p - 1, s, count, degree);
  return value;
}

/// Rows (d x N d) of all axes at a phase.
inline MatrixXd rows_at(double s, Index count, Index axes) {
  MatrixXd rows = MatrixXd::Zero(axes, count * axes);
  for (Index i = 0; i < count; ++i)
    for (Index a = 0; a < axes; ++a) rows(a, i * axes + a) = b_spline(i, 3, s, count);
  return rows;
}

template <class Space>
MatrixXd covariance_of(const Distribution<Space>& distribution) {
  const RowMatrix& factor = distribution.parameters().factor;
  return factor * factor.transpose();
}

}  // namespace varied
