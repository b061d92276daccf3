#include "kinematics/pose_goal.hpp"

#include <cmath>

#include "kinematics/pose_error.hpp"

namespace dmp::detail {
namespace {

bool are_equal(const Eigen::Vector3d& v) { return v[0] == v[1] && v[1] == v[2]; }

// The shortest turn that lays one unit vector onto another.
Eigen::Vector3d swing(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d normal = from.cross(to);
  const double sine = normal.norm(), angle = std::atan2(sine, from.dot(to));
  if (sine > 1e-12) return angle / sine * normal;
  return angle < 1.0 ? normal : Eigen::Vector3d(angle * from.unitOrthogonal());
}

}  // namespace

PoseGoal::PoseGoal(const Vector6& weight, double angle_weight)
    : weight_(weight),
      is_whole_((weight.array() > 0.0).all()),
      is_isotropic_(are_equal(weight.head<3>()) && are_equal(weight.tail<3>())),
      free_turns_(static_cast<int>((weight.tail<3>().array() == 0.0).count())) {
  weight_.tail<3>() *= angle_weight;
  if (free_turns_ == 1) weight_.tail<3>().minCoeff(&free_axis_);
}

Vector6 PoseGoal::whole_error(const Frame& target, const Frame& tip) { return pose_error(target, tip); }

Vector6 PoseGoal::partial_error(const Frame& target, const Frame& tip) const {
  Vector6 error = Vector6::Zero();
  Eigen::Vector3d way = target.rotation.transpose() * (target.position - tip.position);
  for (Eigen::Index i = 0; i < 3; ++i)
    if (weight_[i] == 0.0) way[i] = 0.0;
  error.head<3>() = target.rotation * way;
  if (free_turns_ == 0) error.tail<3>() = pose_error(target, tip).tail<3>();
  if (free_turns_ == 1)
    error.tail<3>() = swing(tip.rotation.col(free_axis_), target.rotation.col(free_axis_));
  return error;
}

}  // namespace dmp::detail
