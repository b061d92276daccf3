#include "kinematics/fit_penalties.hpp"

#include <cmath>

namespace dmp::detail {
namespace {

constexpr double weak_pull = 0.02;    // to the middle of the dead zone
constexpr double strong_pull = 20.0;  // back to its edge
constexpr double smoothness = 0.02;   // of velocity and acceleration, always
constexpr double limit_room = 0.02;   // rad or m from a joint limit, in which joints are pushed back
constexpr double limit_pull = 3.0;
constexpr double floor_room = 0.01;  // m
constexpr double floor_pull = 2.0;

}  // namespace

double dead_zone(const Eigen::Vector3d& e, Eigen::Vector3d& residual, Eigen::Matrix3d& slope) {
  const double size = e.norm(), pull = weak_pull + (size > 1.0 ? strong_pull * (1.0 - 1.0 / size) : 0.0);
  residual = pull * e;
  slope = pull * Eigen::Matrix3d::Identity();
  if (size > 1.0) slope += strong_pull / (size * size * size) * e * e.transpose();
  return residual.squaredNorm();
}

Penalty rate_penalty(double x, double most, double aim) {
  Penalty penalty;
  penalty.add(smoothness * x / most, smoothness / most);
  const double over = std::abs(x) / (aim * most) - 1.0;
  if (over > 0.0) penalty.add(steep * over, std::copysign(steep / (aim * most), x));
  return penalty;
}

Penalty limit_penalty(double beyond) {
  Penalty penalty;
  const double over = beyond / limit_room + 1.0;
  if (over > 0.0) penalty.add(limit_pull * over, limit_pull / limit_room);
  return penalty;
}

Penalty floor_penalty(double below) {
  Penalty penalty;
  if (below > 0.0) penalty.add(floor_pull * below / floor_room, floor_pull / floor_room);
  return penalty;
}

}  // namespace dmp::detail
