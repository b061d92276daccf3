#include "kinematics/box_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dmp::detail {
namespace {

constexpr int size = 6;
using Lower = std::array<std::array<double, size>, size>;  // [column][row], rows >= column

constexpr double least_pivot = 1e-15;  // of the largest; rounding may leave less, or a negative one
using OnSide = std::array<bool, joint_capacity>;

// J J^T + damping I over the joints that are free to move.
Lower damped_square(const Jacobian& jacobian, const OnSide& on_side, double damping) {
  Lower square{};
  for (int c = 0; c < size; ++c) square[c][c] = damping;
  for (Eigen::Index i = 0; i < jacobian.cols(); ++i) {
    if (on_side[i]) continue;
    const double* const v = jacobian.col(i).data();
    for (int c = 0; c < size; ++c)
      for (int r = c; r < size; ++r) square[c][r] += v[c] * v[r];
  }
  return square;
}

// Solves system x = b for a positive definite system (Cholesky). By hand and of fixed size, because this is
// where the solver's time goes: three times as fast as Eigen's LLT here.
Vector6 solve(Lower l, Vector6 x) {
  std::array<double, size> inverse;
  double largest = std::numeric_limits<double>::min();
  for (int c = 0; c < size; ++c) largest = std::max(largest, l[c][c]);
  for (int c = 0; c < size; ++c) {
    inverse[c] = 1.0 / std::sqrt(std::max(l[c][c], least_pivot * largest));
    for (int r = c; r < size; ++r) l[c][r] *= inverse[c];
    for (int k = c + 1; k < size; ++k)
      for (int r = k; r < size; ++r) l[k][r] -= l[c][k] * l[c][r];
    x[c] *= inverse[c];
    for (int r = c + 1; r < size; ++r) x[r] -= l[c][r] * x[c];
  }
  for (int c = size - 1; c >= 0; --c) {
    for (int r = c + 1; r < size; ++r) x[c] -= l[c][r] * x[r];
    x[c] *= inverse[c];
  }
  return x;
}

}  // namespace

Joints box_step(const Jacobian& jacobian, const Vector6& error, double damping, const Box& box) {
  const Eigen::Index n = jacobian.cols();
  Joints step(n);
  OnSide on_side{};
  Vector6 left = error;
  for (bool inside = false; !inside;) {
    inside = true;
    const Vector6 multiplier = solve(damped_square(jacobian, on_side, damping), left);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (on_side[i]) continue;
      const double wanted = jacobian.col(i).dot(multiplier);
      step[i] = std::clamp(wanted, box.lower[i], box.upper[i]);
      if (step[i] == wanted) continue;
      inside = false;
      on_side[i] = true;
      left -= jacobian.col(i) * step[i];
    }
  }
  return step;
}

}  // namespace dmp::detail
