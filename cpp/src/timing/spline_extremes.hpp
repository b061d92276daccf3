#pragma once

#include <dmp/joint_trajectory.hpp>

#include <string>

namespace dmp::detail {

/// InvalidArgument unless `limit` is `count` values > 0.
void check_limit(const Eigen::VectorXd& limit, Eigen::Index count, const std::string& name);

/// (T) For each sample and the way to the next one: the square of the smallest factor on the time with which
/// the joints' spline stays within the limits there, max(|qd| / velocity_limit)^2 and |qdd| /
/// acceleration_limit.
Eigen::VectorXd squared_factors(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit,
                                const Eigen::VectorXd& acceleration_limit);

/// The largest step / time between the samples / velocity limit of its joint.
double largest_step_ratio(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit);

}  // namespace dmp::detail
