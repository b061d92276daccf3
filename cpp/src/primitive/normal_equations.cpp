#include "primitive/normal_equations.hpp"

#include <dmp/error.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// How much of the phase each sample stands for, 1 in all: a demonstration counts alike however often it was
/// sampled.
VectorXd shares(const VectorXd& s) {
  const Index n = s.size();
  VectorXd share = VectorXd::Ones(n);
  for (Index k = 1; k + 1 < n; ++k) share[k] = 0.5 * (s[k + 1] - s[k - 1]);
  if (n > 1) {
    share[0] = s[1] - s[0];
    share[n - 1] = s[n - 1] - s[n - 2];
  }
  return share / share.sum();
}

constexpr Index kMostForRidge = 4000;  // its matrix is solved in full

/// out[a] += sum_q weight[q] psi_q[a] for the rows psi_0 .. psi_3 of a block, `stride` apart.
void add_four(const double* __restrict psi, Index stride, const double* __restrict weight, Index count,
              double* __restrict out) noexcept {
  const double w0 = weight[0], w1 = weight[1], w2 = weight[2], w3 = weight[3];
  const double* const p1 = psi + stride;
  const double* const p2 = p1 + stride;
  const double* const p3 = p2 + stride;
  for (Index a = 0; a < count; ++a) out[a] += w0 * psi[a] + w1 * p1[a] + w2 * p2[a] + w3 * p3[a];
}

/// The symmetric band times the weights, diagonal by diagonal: long vectors instead of many short ones.
Eigen::MatrixXd times(const Eigen::MatrixXd& diagonals, const Eigen::MatrixXd& weights) {
  const Index n = weights.rows();
  Eigen::MatrixXd product(n, weights.cols());
  for (Index d = 0; d < weights.cols(); ++d) {
    const auto w = weights.col(d);
    auto p = product.col(d);
    p = diagonals.col(0).cwiseProduct(w);
    for (Index k = 1; k < std::min(diagonals.cols(), n); ++k) {
      const auto g = diagonals.col(k).head(n - k);
      p.head(n - k) += g.cwiseProduct(w.tail(n - k));
      p.tail(n - k) += g.cwiseProduct(w.head(n - k));
    }
  }
  return product;
}

}  // namespace

NormalEquations::Phases::Phases(const GaussianBasis& basis)
    : gram(RowMatrix::Zero(basis.count(), basis.window_capacity())), norm(VectorXd::Zero(basis.count())) {}

NormalEquations::Block::Block(Index kernels, Index axes)
    : scratch(kernels), psi(kMost, kernels), gram(kMost), norm(kMost), value(axes, kMost) {}

bool NormalEquations::Block::takes(const GaussianBasis::Window& next) const noexcept {
  return size == 0 || (size < kMost && next.first == window.first && next.count == window.count);
}

void NormalEquations::Block::add(const GaussianBasis::Window& at, double gram_weight, double norm_weight,
                                 double value_weight, const double* f) noexcept {
  window = at;
  std::copy_n(scratch.data(), at.count, psi.row(size).data());
  gram[size] = gram_weight;
  norm[size] = norm_weight;
  for (Index d = 0; d < value.rows(); ++d) value(d, size) = value_weight * f[d];
  ++size;
}

void NormalEquations::Block::fill_up() noexcept {
  for (; size % 4 != 0; ++size) {
    psi.row(size).setZero();
    gram[size] = norm[size] = 0.0;
    value.col(size).setZero();
  }
}

NormalEquations::NormalEquations(const GaussianBasis& basis, Index axes, bool local)
    : basis_(basis),
      local_(local),
      block_(basis.window_capacity(), axes),
      grid_(basis),
      all_(basis),
      right_(Eigen::MatrixXd::Zero(basis.count(), axes)) {}

void NormalEquations::clear() {
  all_.gram.setZero();
  all_.norm.setZero();
  right_.setZero();
}

void NormalEquations::add(const ForcingTarget& target, Index first, double scale) {
  const bool known = grid_.s.size() == target.s.size() && grid_.s == target.s;
  if (!known) {
    grid_ = Phases(basis_);
    grid_.s = target.s;
    share_ = shares(target.s);
  }
  for (Index k = 0; k < target.s.size(); ++k) {
    const GaussianBasis::Window window = basis_.proportional(target.s[k], block_.scratch.data());
    if (!block_.takes(window)) flush(!known);
    const double total = block_.scratch.head(window.count).sum();
    const double x = basis_.gate(target.s[k]);
    // Kernels are known up to a factor, which cancels wherever they are divided by their sum.
    const double weight = local_ ? share_[k] * window.factor() : share_[k] / total;
    block_.add(window, weight * x * x / total, weight * x * x, weight * x * scale,
               target.value.row(k).data() + first);
  }
  flush(!known);
  all_.gram += scale * scale * grid_.gram;
  all_.norm += scale * scale * grid_.norm;
}

RowMatrix NormalEquations::solve_lwr(int passes) const {
  const Eigen::MatrixXd gram = all_.gram;
  const VectorXd step = (all_.norm.array() > 0.0).select(all_.norm.cwiseInverse(), 0.0);
  Eigen::MatrixXd weights = step.asDiagonal() * right_;
  for (int pass = 1; pass < passes; ++pass) weights += step.asDiagonal() * (right_ - times(gram, weights));
  return weights;
}

RowMatrix NormalEquations::solve_ridge(double ridge) const {
  if (all_.gram.col(0).sum() == 0.0) return RowMatrix::Zero(right_.rows(), right_.cols());
  if (all_.gram.rows() > kMostForRidge)
    throw InvalidArgument("options.basis_count: " + std::to_string(all_.gram.rows()) +
                          " kernels, expected at most 4000 for ridge regression. Use Regression::lwr.");
  const Eigen::LLT<Eigen::MatrixXd, Eigen::Lower> cholesky(with_ridge(ridge));
  if (cholesky.info() != Eigen::Success)
    throw InvalidArgument(
        "options.ridge: too small for these kernels and samples, whose matrix is singular. Raise it (1e-9), "
        "or "
        "take fewer kernels.");
  return cholesky.solve(right_);
}

double NormalEquations::condition(double ridge) const {
  Eigen::MatrixXd full = with_ridge(local_ ? 0.0 : ridge);
  if (local_) {
    const VectorXd scale = (all_.norm.array() > 0.0).select(all_.norm.cwiseSqrt().cwiseInverse(), 0.0);
    full = scale.asDiagonal() * full * scale.asDiagonal();
  }
  const VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full, Eigen::EigenvaluesOnly).eigenvalues();
  constexpr double kSmallest = std::numeric_limits<double>::epsilon();
  return values.maxCoeff() / std::max(values.minCoeff(), kSmallest * values.maxCoeff());
}

void NormalEquations::flush(bool new_phases) noexcept {
  block_.fill_up();
  for (Index q = 0; q < block_.size; q += 4) {
    if (new_phases) add_phases(q);
    add_values(q);
  }
  block_.size = 0;
}

void NormalEquations::add_phases(Index q) noexcept {
  const Index count = block_.window.count;
  const Index stride = block_.psi.cols();
  const double* const psi = block_.psi.row(q).data();
  const double* const weight = block_.gram.data() + q;
  for (Index a = 0; a < count; ++a) {
    const double row[4] = {weight[0] * psi[a], weight[1] * psi[a + stride], weight[2] * psi[a + 2 * stride],
                           weight[3] * psi[a + 3 * stride]};
    add_four(psi + a, stride, row, count - a, grid_.gram.row(block_.window.first + a).data());
  }
  add_four(psi, stride, block_.norm.data() + q, count, grid_.norm.data() + block_.window.first);
}

void NormalEquations::add_values(Index q) noexcept {
  for (Index d = 0; d < right_.cols(); ++d)
    add_four(block_.psi.row(q).data(), block_.psi.cols(), block_.value.row(d).data() + q, block_.window.count,
             right_.col(d).data() + block_.window.first);
}

Eigen::MatrixXd NormalEquations::with_ridge(double ridge) const {
  const RowMatrix& gram = all_.gram;
  const Index n = gram.rows();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < std::min(gram.cols(), n - i); ++k) full(i + k, i) = gram(i, k);
  full.diagonal().array() += ridge * full.diagonal().sum() / static_cast<double>(n);
  return full;
}

}  // namespace dmp::detail
