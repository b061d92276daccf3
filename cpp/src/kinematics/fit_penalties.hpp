#pragma once

#include <Eigen/Core>

namespace dmp::detail {

/// The dead zone: e in units of the zone, r = (weak + strong max(0, 1 - 1 / |e|)) e; the derivative by e goes
/// into `slope`. Returns |r|^2.
double dead_zone(const Eigen::Vector3d& e, Eigen::Vector3d& residual, Eigen::Matrix3d& slope);

/// A squared residual of one number and what it adds to the normal equations: weight = slope^2, right =
/// -slope residual.
struct Penalty {
  double cost = 0.0, weight = 0.0, right = 0.0;
  void add(double residual, double slope) {
    cost += residual * residual;
    weight += slope * slope;
    right -= slope * residual;
  }
};

/// A joint's velocity or acceleration x: a little of x / most always, and a steep rise beyond aim * most.
Penalty rate_penalty(double x, double most, double aim);
/// A joint that comes near a limit: `beyond` [rad or m] is positive outside; the derivative is by `beyond`.
Penalty limit_penalty(double beyond);
/// A height `below` [m] the floor; the derivative is by `below`.
Penalty floor_penalty(double below);

/// Slope of the penalties of rates, and half of it of effort.
inline constexpr double steep = 40.0;

}  // namespace dmp::detail
