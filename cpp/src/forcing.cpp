#include <dmp/error.hpp>
#include <dmp/forcing.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include "detail/forcing_fit.hpp"
#include "detail/gaussian_place.hpp"
#include "detail/learning.hpp"
#include "detail/normal_equations.hpp"

namespace dmp {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Index padded(Index dimension) { return (dimension + 1) / 2 * 2; }

/// f = x (sum psi_k rows_k) / (sum psi_k)
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

/// The kernels equal in time, generated while they are summed up: those above and below the nearest one side
/// by side, with a number of columns known when this is compiled.
template <int Columns>
void ForcingTerm::evaluate_equal_in_time(double s, double* f) const noexcept {
  using Row = Eigen::Array<double, Columns, 1>;
  using AlignedRow = Eigen::Map<const Row, Eigen::Aligned16>;
  const GaussianBasis::Place at = basis_.place(s);
  const double* const table = basis_.table_.data();
  const double* const middle = rows_.data() + at.middle * Columns;
  const Eigen::Array2d ratio(at.up, 1.0 / at.up);
  Eigen::Array2d power = ratio;
  Eigen::Array2d totals(1.0, 0.0);
  Row sum = AlignedRow(middle);
  int k = 1;
  for (; k <= std::min(at.above, at.below); ++k, power *= ratio) {
    const Eigen::Array2d psi = power * table[k];
    totals += psi;
    sum += psi[0] * AlignedRow(middle + k * Columns) + psi[1] * AlignedRow(middle - k * Columns);
  }
  const bool up = at.above > at.below;  // near the ends one side reaches farther
  const int step = up ? Columns : -Columns;
  for (double psi = up ? power[0] : power[1]; k <= std::max(at.above, at.below); ++k) {
    totals[0] += psi * table[k];
    sum += (psi * table[k]) * AlignedRow(middle + k * step);
    psi *= up ? ratio[0] : ratio[1];
  }
  Eigen::Map<Row> mean(f);
  mean = (basis_.x(s) / totals.sum()) * sum;
}

void ForcingTerm::evaluate(double s, double* psi, double* f) const noexcept {
  if (basis_.overlap_ > 0.0) {
    switch (rows_.cols()) {
      case 2:
        return evaluate_equal_in_time<2>(s, f);
      case 4:
        return evaluate_equal_in_time<4>(s, f);
      case 6:
        return evaluate_equal_in_time<6>(s, f);
    }
  }
  const GaussianBasis::Window window = basis_.proportional(s, psi);
  const double x = std::exp(-basis_.alpha_x_ * s);
  weighted_mean(psi, window.count, rows_.data() + window.first * rows_.cols(), rows_.cols(), x, f);
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
  const Index dimension = targets.empty() ? 0 : targets.front().value.cols();
  return detail::ForcingFit(basis, options, dimension).weights(targets);
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
  detail::NormalEquations equations(basis, 1, options.regression == Regression::lwr);
  equations.add(even, 0, 1.0);
  return equations.condition(options.ridge);
}

}  // namespace dmp
