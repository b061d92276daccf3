#include <dmp/error.hpp>
#include <dmp/forcing.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "detail/learning.hpp"

namespace dmp {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Index padded(Index dimension) { return (dimension + 1) / 2 * 2; }

/// f = x (sum psi_k rows_k) / (sum psi_k), rows of a number of columns known when this is compiled.
template <int Columns>
void weighted_mean(const double* psi, int count, const double* rows, double x, double* f) noexcept {
  double sum[Columns] = {};  // of its own, so that it stays in registers: f might alias the rows
  double total = 0.0;
  for (int k = 0; k < count; ++k) {
    total += psi[k];
    for (int d = 0; d < Columns; ++d) sum[d] += psi[k] * rows[k * Columns + d];
  }
  const double factor = x / total;
  for (int d = 0; d < Columns; ++d) f[d] = factor * sum[d];
}

/// The same for any number of columns.
void weighted_mean(const double* psi, int count, const double* rows, Index columns, double x,
                   double* f) noexcept {
  std::fill_n(f, columns, 0.0);
  double total = 0.0;
  for (int k = 0; k < count; ++k) {
    total += psi[k];
    for (Index d = 0; d < columns; ++d) f[d] += psi[k] * rows[k * columns + d];
  }
  for (Index d = 0; d < columns; ++d) f[d] *= x / total;
}

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

/// The sums that both regressions need, for axes that share their scales.
class NormalEquations {
 public:
  NormalEquations(const GaussianBasis& basis, Index axes, bool local)
      : basis_(basis),
        local_(local),
        gram_(RowMatrix::Zero(basis.count(), basis.window_capacity())),
        right_(RowMatrix::Zero(basis.count(), axes)),
        norm_(VectorXd::Zero(basis.count())) {}

  /// Adds the samples of one demonstration; axes first .. first + axes - 1 of the target, all with one scale.
  void add(const ForcingTarget& target, Index first, double scale) {
    const VectorXd share = shares(target.s);
    Group group(basis_.window_capacity(), right_.cols());
    for (Index k = 0; k < target.s.size(); ++k) {
      const GaussianBasis::Window window = basis_.activations(target.s[k], group.scratch.data());
      if (!group.takes(window)) flush(group);
      const double total = group.scratch.head(window.count).sum();
      if (total == 0.0) continue;
      const double x = std::exp(-basis_.alpha_x() * target.s[k]) * scale;
      const double weight = local_ ? share[k] : share[k] / total;
      group.add(window, weight * x * x / total, share[k] * x * x, weight * x,
                target.value.row(k).data() + first);
    }
    flush(group);
  }

  RowMatrix solve_lwr(int passes) const {
    const Eigen::MatrixXd gram = diagonals();
    const Eigen::MatrixXd right = right_;
    const VectorXd step = (norm_.array() > 0.0).select(norm_.cwiseInverse(), 0.0);
    Eigen::MatrixXd weights = step.asDiagonal() * right;
    for (int pass = 1; pass < passes; ++pass) weights += step.asDiagonal() * (right - times(gram, weights));
    return weights;
  }

  RowMatrix solve_ridge(double ridge) const {
    if (gram_.col(0).sum() == 0.0) return RowMatrix::Zero(right_.rows(), right_.cols());
    if (gram_.rows() > kMostForRidge)
      throw InvalidArgument("options.basis_count: " + std::to_string(gram_.rows()) +
                            " kernels, expected at most 4000 for ridge regression. Use Regression::lwr.");
    return with_ridge(ridge).selfadjointView<Eigen::Lower>().llt().solve(Eigen::MatrixXd(right_));
  }

  /// Largest over smallest eigenvalue of D^-1/2 G D^-1/2 (locally weighted regression, D the norms) or G +
  /// ridge.
  double condition(double ridge) const {
    Eigen::MatrixXd full = with_ridge(local_ ? 0.0 : ridge);
    if (local_) {
      const VectorXd scale = (norm_.array() > 0.0).select(norm_.cwiseSqrt().cwiseInverse(), 0.0);
      full = scale.asDiagonal() * full * scale.asDiagonal();
    }
    const VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full, Eigen::EigenvaluesOnly).eigenvalues();
    constexpr double kSmallest = std::numeric_limits<double>::epsilon();
    return values.maxCoeff() / std::max(values.minCoeff(), kSmallest * values.maxCoeff());
  }

 private:
  /// Neighbouring samples under the same kernels: their sums are products of small matrices.
  struct Group {
    Group(Index kernels, Index axes)
        : scratch(kernels), psi(kMost, kernels), gram(kMost), norm(kMost), value(kMost, axes) {}

    bool takes(const GaussianBasis::Window& next) const {
      return size == 0 || (size < kMost && next.first == window.first && next.count == window.count);
    }
    void add(const GaussianBasis::Window& at, double gram_weight, double norm_weight, double value_weight,
             const double* f) {
      window = at;
      psi.row(size).head(at.count) = scratch.head(at.count).transpose();
      gram[size] = gram_weight;
      norm[size] = norm_weight;
      for (Index d = 0; d < value.cols(); ++d) value(size, d) = value_weight * f[d];
      ++size;
    }

    static constexpr Index kMost = 64;
    VectorXd scratch;
    RowMatrix psi;
    VectorXd gram;
    VectorXd norm;
    RowMatrix value;
    GaussianBasis::Window window{0, 0};
    Index size = 0;
  };

  void flush(Group& group) {
    if (group.size == 0) return;
    const Index first = group.window.first;
    const Index count = group.window.count;
    const auto psi = group.psi.topLeftCorner(group.size, count);
    const RowMatrix weighted = group.gram.head(group.size).asDiagonal() * psi;
    const RowMatrix block = psi.transpose() * weighted;
    for (Index a = 0; a < count; ++a)
      for (Index b = a; b < count; ++b) gram_(first + a, b - a) += block(a, b);
    right_.middleRows(first, count).noalias() += psi.transpose() * group.value.topRows(group.size);
    norm_.segment(first, count).noalias() += psi.transpose() * group.norm.head(group.size);
    group.size = 0;
  }

  /// The lower triangle of the Gram matrix with the ridge on its diagonal.
  Eigen::MatrixXd with_ridge(double ridge) const {
    const Index n = gram_.rows();
    Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < std::min(gram_.cols(), n - i); ++k) full(i + k, i) = gram_(i, k);
    full.diagonal().array() += ridge * full.diagonal().sum() / static_cast<double>(n);
    return full;
  }

  /// (i, k) = G(i, i + k) for all i of a column, as long as i + k is a kernel.
  Eigen::MatrixXd diagonals() const { return gram_; }

  /// The symmetric band times the weights, diagonal by diagonal: long vectors instead of many short ones.
  static Eigen::MatrixXd times(const Eigen::MatrixXd& diagonals, const Eigen::MatrixXd& weights) {
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

  const GaussianBasis& basis_;
  bool local_;
  RowMatrix gram_;
  RowMatrix right_;
  VectorXd norm_;
};

void require_targets(const std::vector<ForcingTarget>& targets) {
  if (targets.empty()) throw InvalidArgument("targets: none, expected at least one.");
  for (const ForcingTarget& target : targets) {
    const Index dimension = targets.front().value.cols();
    if (target.s.size() == 0 || target.value.rows() != target.s.size() || target.value.cols() != dimension ||
        target.scale.size() != dimension)
      throw InvalidArgument(
          "targets: phases, values and scales of different sizes, expected (K), (K x dims) and (dims).");
    GaussianBasis::require_phases(target.s);
    if (!target.value.allFinite() || !target.scale.allFinite())
      throw InvalidArgument("targets: values or scales that are not finite.");
  }
}

bool one_scale(const std::vector<ForcingTarget>& targets) {
  return std::all_of(targets.begin(), targets.end(),
                     [](const ForcingTarget& t) { return (t.scale.array() == t.scale[0]).all(); });
}

void require_scale(const std::vector<ForcingTarget>& targets, Index axis) {
  double scale = 0.0;
  double value = 0.0;
  for (const ForcingTarget& target : targets) {
    scale = std::max(scale, std::abs(target.scale[axis]));
    value = std::max(value, target.value.col(axis).cwiseAbs().maxCoeff());
  }
  if (scale < 1e-9 && value > 1e-9)
    throw InvalidArgument(
        "scaling: axis " + std::to_string(axis) +
        " of the demonstration ends where it starts, so (goal - start) can not scale its forcing "
        "term. Use Scaling::none or Scaling::per_axis_relative.");
}

/// Axes first .. first + axes - 1, which share their scales.
RowMatrix fit_axes(const GaussianBasis& basis, const std::vector<ForcingTarget>& targets,
                   const DmpOptions& options, Index first, Index axes) {
  const bool local = options.regression == Regression::lwr;
  NormalEquations equations(basis, axes, local);
  for (const ForcingTarget& target : targets) equations.add(target, first, target.scale[first]);
  return local ? equations.solve_lwr(options.passes) : equations.solve_ridge(options.ridge);
}

}  // namespace

ForcingTerm::ForcingTerm(const GaussianBasis& basis, const RowMatrix& weights)
    : basis_(basis),
      dimension_(weights.cols()),
      rows_(RowMatrix::Zero(weights.rows(), padded(weights.cols()))) {
  if (weights.rows() != basis.count())
    throw InvalidArgument("weights: " + std::to_string(weights.rows()) +
                          " rows, expected one for each of the " + std::to_string(basis.count()) +
                          " kernels.");
  if (weights.cols() == 0 || !weights.allFinite())
    throw InvalidArgument("weights: empty or not finite, expected finite numbers (N x dims).");
  rows_.leftCols(dimension_) = weights;
}

void ForcingTerm::evaluate(double s, double* psi, double* f) const noexcept {
  const GaussianBasis::Window window = basis_.proportional(s, psi);
  const double x = std::exp(-basis_.alpha_x() * s);
  const double* rows = rows_.data() + window.first * rows_.cols();
  switch (rows_.cols()) {
    case 2:
      return weighted_mean<2>(psi, window.count, rows, x, f);
    case 4:
      return weighted_mean<4>(psi, window.count, rows, x, f);
    case 6:
      return weighted_mean<6>(psi, window.count, rows, x, f);
    default:
      return weighted_mean(psi, window.count, rows, rows_.cols(), x, f);
  }
}

RowMatrix ForcingTerm::evaluate(const VectorXd& s) const {
  GaussianBasis::require_phases(s);
  RowMatrix values(s.size(), rows_.cols());
  VectorXd psi(basis_.window_capacity());
  for (Index k = 0; k < s.size(); ++k) evaluate(s[k], psi.data(), values.row(k).data());
  return values.leftCols(dimension_);
}

RowMatrix fit_forcing(const GaussianBasis& basis, const std::vector<ForcingTarget>& targets,
                      const DmpOptions& options) {
  require_targets(targets);
  const Index dimension = targets.front().value.cols();
  for (Index axis = 0; axis < dimension; ++axis) require_scale(targets, axis);
  if (one_scale(targets)) return fit_axes(basis, targets, options, 0, dimension);
  RowMatrix weights(basis.count(), dimension);
  for (Index axis = 0; axis < dimension; ++axis)
    weights.col(axis) = fit_axes(basis, targets, options, axis, 1);
  return weights;
}

double regression_condition(const DmpOptions& options) {
  // Eigenvalues cost the cube of the kernels, and more of them with the same overlap change nothing.
  constexpr int kEnough = 300;
  DmpOptions looked_at = options;
  looked_at.basis_count = std::min(options.basis_count, kEnough);
  const GaussianBasis basis = detail::basis_of(looked_at);
  const Index samples = 10 * basis.count() + 1;
  const ForcingTarget even{VectorXd::LinSpaced(samples, 0.0, 1.0), RowMatrix::Zero(samples, 1),
                           VectorXd::Ones(1)};
  NormalEquations equations(basis, 1, options.regression == Regression::lwr);
  equations.add(even, 0, 1.0);
  return equations.condition(options.ridge);
}

}  // namespace dmp
