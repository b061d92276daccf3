#pragma once

#include <dmp/obstacle.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// A point that moves past an obstacle.
struct Approach {
  Nearness near;
  double closing = 0.0;  ///< -d distance / dt
  double bend = 0.0;  ///< v^T H v of the distance: what the surface's curvature adds to its second derivative
};

/// `velocity` is that of the point; both are taken relative to the obstacle's.
Approach approach(const Obstacle& obstacle, const Eigen::Vector3d& point,
                  const Eigen::Vector3d& velocity) noexcept;

const Eigen::Vector3d& velocity_of(const Obstacle& obstacle) noexcept;
void move_on(Obstacle& obstacle, double seconds) noexcept;

}  // namespace dmp::detail
