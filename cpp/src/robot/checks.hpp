#pragma once

#include <dmp/arm.hpp>
#include <string>

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// InvalidArgument unless value > 0.
void check_positive(double value, const std::string& name);
/// InvalidArgument unless 0 < weight < infinity: an infinite one makes a NaN of an error of 0.
void check_angle_weight(double weight);
/// InvalidArgument unless the solvers' memory of fixed size holds the arm's joints.
void check_capacity(const Arm& arm);
/// InvalidArgument unless the weights are finite and >= 0, some of them > 0, and not just two turns free.
void check_weight(const Vector6& weight);

/// InvalidArgument unless all times are finite and increase.
void check_times(const Eigen::VectorXd& times);
/// InvalidArgument unless q is one finite value for each of `count` joints.
void check_joints(const Eigen::VectorXd& q, Eigen::Index count, const std::string& name);
/// rad or m that a joint may be read beyond its limits: encoders have noise, and hard stops give way.
inline constexpr double limit_tolerance = 1e-3;

/// The joints brought back onto the arm's limits. InvalidArgument, naming joint, value and limit, unless they
/// are n finite values at most limit_tolerance beyond.
Eigen::VectorXd brought_within_limits(const Eigen::VectorXd& q, const Arm& arm, const std::string& name);

/// The frame of a pose that is_pose accepts, with the nearest rotation.
Frame rigid_frame(const Eigen::Matrix4d& pose);

}  // namespace dmp::detail
