#pragma once

#include <dmp/eigen_abi.hpp>

#include <Eigen/Core>
#include <vector>

namespace dmp {

/// A table whose row k belongs to sample k.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Rotations = std::vector<Eigen::Matrix3d>;
using Poses = std::vector<Eigen::Matrix4d>;

/// Positions over time: what a Dmp's rollout returns.
struct Trajectory {
  Eigen::VectorXd time;    ///< (T) s
  RowMatrix position;      ///< (T x dims), the unit of the demonstration
  RowMatrix velocity;      ///< (T x dims), per s
  RowMatrix acceleration;  ///< (T x dims), per s^2
};

/// Orientations over time: what an OrientationDmp's rollout returns.
struct OrientationTrajectory {
  Eigen::VectorXd time;            ///< (T) s
  Rotations rotation;              ///< (T) body -> world
  RowMatrix angular_velocity;      ///< (T x 3) rad/s, world frame
  RowMatrix angular_acceleration;  ///< (T x 3) rad/s^2, world frame
};

/// Poses over time: what a PoseDmp's rollout returns.
struct PoseTrajectory {
  Eigen::VectorXd time;  ///< (T) s
  Poses pose;            ///< (T) [R p; 0 1], body -> world
  RowMatrix twist;  ///< (T x 6) linear velocity of the origin [m/s], angular velocity [rad/s]; world frame
  RowMatrix acceleration;  ///< (T x 6) the twist's rate: m/s^2, then rad/s^2
};

}  // namespace dmp
