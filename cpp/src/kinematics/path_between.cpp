#include "kinematics/path_between.hpp"

#include <algorithm>
#include <dmp/so3.hpp>

namespace dmp::detail {
namespace {

using Eigen::Index;

// The cubic of a C2 spline, `s` behind sample k.
Eigen::VectorXd cubic(const JointTrajectory& spline, Index k, double s) {
  const double h = spline.time[k + 1] - spline.time[k];
  return spline.position.row(k) + s * spline.velocity.row(k) + 0.5 * s * s * spline.acceleration.row(k) +
         s * s * s / (6.0 * h) * (spline.acceleration.row(k + 1) - spline.acceleration.row(k));
}

}  // namespace

PathBetween::PathBetween(const Eigen::VectorXd& times, const Poses& poses) : poses_(poses) {
  RowMatrix positions(times.size(), 3);
  for (Index k = 0; k < times.size(); ++k)
    positions.row(k) = poses[static_cast<std::size_t>(k)].topRightCorner<3, 1>().transpose();
  way_ = JointTrajectory::through(times, positions);
}

std::pair<Index, double> PathBetween::place(double t) const {
  const Index last = way_.time.size() - 2;
  const double* const begin = way_.time.data();
  const Index k = std::clamp<Index>(std::upper_bound(begin, begin + last + 2, t) - begin - 1, 0, last);
  return {k, std::min(t, way_.time[last + 1]) - way_.time[k]};
}

Frame PathBetween::at(double t) const {
  const auto [k, s] = place(t);
  const auto sample = static_cast<std::size_t>(k);
  const Eigen::Matrix3d from = poses_[sample].topLeftCorner<3, 3>(),
                        to = poses_[sample + 1].topLeftCorner<3, 3>();
  const Eigen::Vector3d turn = so3::log(Eigen::Matrix3d(to * from.transpose()));
  const double share = s / (way_.time[k + 1] - way_.time[k]);
  return {so3::exp(Eigen::Vector3d(share * turn)) * from, cubic(way_, k, s)};
}

Eigen::VectorXd PathBetween::joints_at(const JointTrajectory& joints, double t) const {
  const auto [k, s] = place(t);
  return cubic(joints, k, s);
}

double PathBetween::value_at(const Eigen::VectorXd& of_samples, double t) const {
  const auto [k, s] = place(t);
  const double share = s / (way_.time[k + 1] - way_.time[k]);
  return (1.0 - share) * of_samples[k] + share * of_samples[k + 1];
}

}  // namespace dmp::detail
