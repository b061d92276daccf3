#include <dmp/error.hpp>
#include <dmp/forcing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "primitive/forcing_fit.hpp"
#include "primitive/gaussian_place.hpp"
#include "primitive/learning.hpp"
#include "primitive/normal_equations.hpp"

namespace dmp {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

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
    : basis_(basis), weights_(weights) {
  if (weights.rows() != basis.count())
    throw InvalidArgument("weights: " + std::to_string(weights.rows()) +
                          " rows, expected one for each of the " + std::to_string(basis.count()) +
                          " kernels.");
  if (weights.cols() == 0 || !weights.allFinite())
    throw InvalidArgument("weights: empty or not finite, expected finite numbers (N x dims).");
  if (!basis.is_periodic()) return;
  const Index n = weights.rows();
  const Index reach = basis.reach_;
  round_.resize(n + 1 + 2 * reach, weights.cols());
  for (Index k = 0; k < round_.rows(); ++k) round_.row(k) = weights.row((k + n - reach) % n);
}

/// The kernels equal in time, generated while they are summed up, for two phases side by side that are
/// nearest to the same kernel: one phase in either half of a register, the number of axes known when this is
/// compiled.
template <int Axes>
void ForcingTerm::evaluate_side_by_side(const GaussianBasis::Place& at, double s, double next, double* f,
                                        double* f_next) const noexcept {
  using Pair = Eigen::Array2d;
  const GaussianBasis::PhasePair pair = basis_.pair(s, next, at.middle);
  const Pair up = pair.ratio;
  const Pair down = up.inverse();
  const double* const table = basis_.table_.data();
  const double* const middle = weights_.data() + at.middle * Axes;
  std::array<Pair, Axes> sum;
  for (int d = 0; d < Axes; ++d) sum[d] = Pair::Constant(middle[d]);
  Pair total = Pair::Ones();
  Pair up_power = up;
  Pair down_power = down;
  int k = 1;
  for (; k <= std::min(at.above, at.below); ++k, up_power *= up, down_power *= down) {
    const Pair psi_above = up_power * table[k];
    const Pair psi_below = down_power * table[k];
    total += psi_above + psi_below;
    for (int d = 0; d < Axes; ++d)
      sum[d] += psi_above * middle[k * Axes + d] + psi_below * middle[-k * Axes + d];
  }
  // Near the ends one side reaches farther.
  const bool is_up = at.above > at.below;
  const Pair ratio = is_up ? up : down;
  Pair power = is_up ? up_power : down_power;
  for (; k <= std::max(at.above, at.below); ++k, power *= ratio) {
    const Pair psi = power * table[k];
    total += psi;
    for (int d = 0; d < Axes; ++d) sum[d] += psi * middle[(is_up ? k : -k) * Axes + d];
  }
  const Pair factor = pair.x / total;
  for (int d = 0; d < Axes; ++d) {
    f[d] = factor[0] * sum[d][0];
    f_next[d] = factor[1] * sum[d][1];
  }
}

template <int Axes>
void ForcingTerm::evaluate_equal_in_time(double s, double next, double* f, double* f_next) const noexcept {
  const GaussianBasis::Place at = basis_.place(s);
  const GaussianBasis::Place at_next = basis_.place(next);
  if (at.middle == at_next.middle) return evaluate_side_by_side<Axes>(at, s, next, f, f_next);
  evaluate_side_by_side<Axes>(at, s, s, f, f);
  evaluate_side_by_side<Axes>(at_next, next, next, f_next, f_next);
}

void ForcingTerm::evaluate(double s, double next, double* psi, double* f, double* f_next) const noexcept {
  if (basis_.overlap_ > 0.0) {
    switch (dimension()) {
      case 1:
        return evaluate_equal_in_time<1>(s, next, f, f_next);
      case 2:
        return evaluate_equal_in_time<2>(s, next, f, f_next);
      case 3:
        return evaluate_equal_in_time<3>(s, next, f, f_next);
      case 4:
        return evaluate_equal_in_time<4>(s, next, f, f_next);
      case 5:
        return evaluate_equal_in_time<5>(s, next, f, f_next);
      case 6:
        return evaluate_equal_in_time<6>(s, next, f, f_next);
      case 7:
        return evaluate_equal_in_time<7>(s, next, f, f_next);
      case 8:
        return evaluate_equal_in_time<8>(s, next, f, f_next);
      case 9:
        return evaluate_equal_in_time<9>(s, next, f, f_next);
      case 10:
        return evaluate_equal_in_time<10>(s, next, f, f_next);
    }
  }
  evaluate_window(s, psi, f);
  evaluate_window(next, psi, f_next);
}

void ForcingTerm::evaluate(double s, double* psi, double* f) const noexcept { evaluate(s, s, psi, f, f); }

[[gnu::noinline]] void ForcingTerm::evaluate_window(double s, double* psi, double* f) const noexcept {
  const GaussianBasis::Window window = basis_.proportional(s, psi);
  weighted_mean(psi, window.count, row(window.first), dimension(), basis_.gate(s), f);
}

RowMatrix ForcingTerm::evaluate(const VectorXd& s) const {
  GaussianBasis::require_phases(s);
  RowMatrix values(s.size(), dimension());
  VectorXd psi(basis_.window_capacity());
  for (Index k = 0; k < s.size(); ++k) evaluate(s[k], psi.data(), values.row(k).data());
  return values;
}

RowMatrix fit_forcing(const GaussianBasis& basis, const std::vector<ForcingTarget>& targets,
                      const DmpOptions& options) {
  const Index dimension = targets.empty() ? 0 : targets.front().value.cols();
  RowMatrix weights = detail::ForcingFit(basis, options, dimension).weights(targets);
  if (!weights.allFinite())
    throw InvalidArgument(
        "targets: phases that lie too close together or values that are too large for a regression.");
  return weights;
}

double regression_condition(const DmpOptions& options) {
  // Eigenvalues cost the cube of the kernels, and more of them with the same overlap change nothing.
  constexpr int kEnough = 300;
  DmpOptions looked_at = options.resolved();
  looked_at.basis_count = std::min(options.basis_count > 0 ? options.basis_count : kEnough, kEnough);
  const GaussianBasis basis = detail::basis_of(looked_at);
  if (basis.is_periodic()) return detail::round_condition(basis, options.ridge);
  const Index samples = 10 * basis.count() + 1;
  const ForcingTarget even{VectorXd::LinSpaced(samples, 0.0, 1.0), RowMatrix::Zero(samples, 1),
                           VectorXd::Ones(1)};
  detail::NormalEquations equations(basis, 1, options.regression == Regression::lwr);
  equations.add(even, 0, 1.0);
  return equations.condition(options.ridge);
}

}  // namespace dmp
