#include "kinematics/bordered_band.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace dmp::detail {
namespace {
using Eigen::Index;
constexpr double smallest_scale = 1e-6;  // so that an unknown that nothing asks for is damped too
}  // namespace

BorderedBand::BorderedBand(Index count, Index below, Index border)
    : band(count, below + 1),
      edge(count, border),
      corner(border, border),
      right(count),
      right_end(border),
      factor_(count + below, below + 1),
      sides_(count + below, border + 1) {
  set_zero();
}

void BorderedBand::set_zero() {
  band.setZero();
  edge.setZero();
  corner.setZero();
  right.setZero();
  right_end.setZero();
}

// Column by column; rows of zeros follow the last one, so that no loop ends early.
bool BorderedBand::factorise(double damping) {
  const Index count = band.rows(), width = band.cols();
  factor_.topRows(count) = band;
  factor_.bottomRows(width - 1).setZero();
  factor_.col(0).head(count) += damping * (band.col(0).array() + smallest_scale).matrix();
  for (Index j = 0; j < count; ++j) {
    double* const column = factor_.data() + j * width;
    if (!(column[0] > 0.0)) return false;
    const double inverse = 1.0 / std::sqrt(column[0]);
    column[0] = inverse;
    for (Index k = 1; k < width; ++k) column[k] *= inverse;
    for (Index k = 1; k < width; ++k) {
      const double share = column[k];
      if (share == 0.0) continue;
      double* const other = factor_.data() + (j + k) * width;
      for (Index i = k; i < width; ++i) other[i - k] -= share * column[i];
    }
  }
  return true;
}

bool BorderedBand::solve(double damping, Eigen::VectorXd& step, Eigen::VectorXd& step_end) {
  if (!factorise(damping)) return false;
  const Index count = band.rows(), width = band.cols(), border = edge.cols(), sides = border + 1;
  sides_.setZero();
  sides_.topLeftCorner(count, border) = edge;
  sides_.col(border).head(count) = right;
  for (Index j = 0; j < count; ++j) {  // L [Y X] = [E g]
    const double* const column = factor_.data() + j * width;
    double* const row = sides_.data() + j * sides;
    for (Index c = 0; c < sides; ++c) row[c] *= column[0];
    for (Index k = 1; k < width; ++k) {
      double* const below = row + k * sides;
      for (Index c = 0; c < sides; ++c) below[c] -= column[k] * row[c];
    }
  }
  step = sides_.col(border).head(count);
  step_end.resize(border);
  if (border > 0) {
    const auto y = sides_.topLeftCorner(count, border);
    Eigen::MatrixXd small = corner;
    small.diagonal() += damping * (corner.diagonal().array() + smallest_scale).matrix();
    small.noalias() -= y.transpose() * y;
    const Eigen::LLT<Eigen::MatrixXd> solver(small);
    if (solver.info() != Eigen::Success) return false;
    step_end = solver.solve(right_end - y.transpose() * step);
    step.noalias() -= y * step_end;
  }
  for (Index j = count - 1; j >= 0; --j) {  // L^T x = X - Y y
    const double* const column = factor_.data() + j * width;
    double sum = step[j];
    const Index last = std::min(width - 1, count - 1 - j);
    for (Index k = 1; k <= last; ++k) sum -= column[k] * step[j + k];
    step[j] = sum * column[0];
  }
  return step.allFinite() && step_end.allFinite();
}

}  // namespace dmp::detail
