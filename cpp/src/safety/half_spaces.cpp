#include "safety/half_spaces.hpp"

#include <algorithm>
#include <cmath>

namespace dmp::detail {

using Eigen::Vector3d;

bool HalfSpaces::add(const Vector3d& normal, double bound) noexcept {
  constexpr double kHardly = 1e-6;
  const double square = normal.squaredNorm();
  if (square < kHardly || count_ == kMost) return false;
  rows_[static_cast<std::size_t>(count_++)] = {normal, bound, square};
  return true;
}

bool HalfSpaces::admits(const Vector3d& x, double tolerance) const noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const Interval& interval = box_[static_cast<std::size_t>(axis)];
    if (x[axis] < interval.low - tolerance || x[axis] > interval.high + tolerance) return false;
  }
  return std::all_of(rows_.begin(), rows_.begin() + count_,
                     [&](const Row& row) { return row.normal.dot(x) >= row.bound - tolerance; });
}

Vector3d HalfSpaces::clamped(const Vector3d& x) const noexcept {
  return {box_[0].clamp(x[0]), box_[1].clamp(x[1]), box_[2].clamp(x[2])};
}

Vector3d HalfSpaces::nearest(const Vector3d& wanted) const noexcept {
  constexpr int kSweeps = 200;
  Vector3d x = clamped(wanted);  // what cannot be reached would only take sweeps
  if (admits(x)) return x;
  Vector3d pull = Vector3d::Zero();         // of the intervals
  std::array<double, kMost> multipliers{};  // of the rows
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const Vector3d before = x;
    for (int j = 0; j < count_; ++j) {
      const Row& row = rows_[static_cast<std::size_t>(j)];
      double& multiplier = multipliers[static_cast<std::size_t>(j)];
      const double next = std::max(0.0, multiplier + (row.bound - row.normal.dot(x)) / row.square);
      x += (next - multiplier) * row.normal;
      multiplier = next;
    }
    const Vector3d free = x - pull;
    x = clamped(free);
    pull = x - free;
    if ((x - before).cwiseAbs().maxCoeff() < 1e-9 * (1.0 + x.cwiseAbs().maxCoeff())) break;
  }
  return x;
}

}  // namespace dmp::detail
