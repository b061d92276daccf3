#pragma once

#include <dmp/joint_trajectory.hpp>
#include <dmp/trajectory.hpp>

#include <utility>

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// A path of poses between its samples: positions on their C2 spline, rotations on the shortest turn.
class PathBetween {
 public:
  /// The poses must outlive it.
  PathBetween(const Eigen::VectorXd& times, const Poses& poses);

  Frame at(double t) const;
  /// Joints at the same samples, on their C2 spline.
  Eigen::VectorXd joints_at(const JointTrajectory& joints, double t) const;
  /// One value a sample, linearly.
  double value_at(const Eigen::VectorXd& of_samples, double t) const;

 private:
  /// The sample before t, and the time since.
  std::pair<Eigen::Index, double> place(double t) const;

  const Poses& poses_;
  JointTrajectory way_;
};

}  // namespace dmp::detail
