#pragma once

#include <dmp/export.hpp>
#include <dmp/realtime.hpp>

#include <Eigen/Core>
#include <variant>

namespace dmp {

// What a motion must not touch, in m, in the frame of the motion. Each may move with a constant velocity
// (m/s).

struct DMP_EXPORT Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< 0 or more; 0 is a point
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

struct DMP_EXPORT Box {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();    ///< of its centre
  Eigen::Vector3d half_sizes = Eigen::Vector3d::Zero();  ///< along the axes of `pose`, 0 or more
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

/// All points within `radius` of the line from `start` to `end`.
struct DMP_EXPORT Capsule {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d end = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< 0 or more
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

/// A half-space: everything behind the plane through `point`; `normal`, of any length but 0, leads to the
/// free side.
struct DMP_EXPORT Plane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

using Obstacle = std::variant<Sphere, Box, Capsule, Plane>;

/// How an obstacle lies to a point.
struct DMP_EXPORT Nearness {
  double distance = 0.0;                              ///< to its surface, m; negative inside
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit gradient of the distance: the way out
};

/// The distance of a point (m) to the surface of an obstacle, and the way out of it. On the axis of a sphere
/// or capsule, where there is no way out, `normal` is any that leads out.
DMP_EXPORT Nearness nearness(const Obstacle& obstacle, const Eigen::Vector3d& point) noexcept DMP_REALTIME;

/// Throws InvalidArgument, naming `name` and the field, unless all numbers are finite, radii and half-sizes 0
/// or more, the pose a pose and the normal of a length.
DMP_EXPORT void require_obstacle(const Obstacle& obstacle, const char* name = "obstacle");
/// Whether it would not throw.
DMP_EXPORT bool is_obstacle(const Obstacle& obstacle) noexcept DMP_REALTIME;

}  // namespace dmp
