#include "primitive/forcing_fit.hpp"

#include <dmp/error.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace dmp::detail {
namespace {

using Eigen::Index;

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
        " of the demonstration ends where it starts, so (goal - start) cannot scale its forcing "
        "term. Use Scaling::none or Scaling::per_axis_relative.");
}

}  // namespace

ForcingFit::ForcingFit(const GaussianBasis& basis, const DmpOptions& options, Index dimension)
    : basis_(basis),
      options_(options),
      together_(basis, dimension, options.regression == Regression::lwr),
      alone_(basis, 1, options.regression == Regression::lwr) {}

RowMatrix ForcingFit::weights(const std::vector<ForcingTarget>& targets) {
  require_targets(targets);
  if (basis_.is_periodic()) return round(targets);
  for (Index axis = 0; axis < targets.front().value.cols(); ++axis) require_scale(targets, axis);
  const bool one_scale = std::all_of(targets.begin(), targets.end(), [](const ForcingTarget& t) {
    return (t.scale.array() == t.scale[0]).all();
  });
  if (one_scale) return solve(together_, targets, 0);
  const Index dimension = targets.front().value.cols();
  RowMatrix weights(together_.kernels(), dimension);
  for (Index axis = 0; axis < dimension; ++axis) weights.col(axis) = solve(alone_, targets, axis);
  return weights;
}

/// Round a cycle: least squares with the ridge, or passes of locally weighted regression, over all kernels.
RowMatrix ForcingFit::round(const std::vector<ForcingTarget>& targets) const {
  const Index count = basis_.count();
  const bool local = options_.regression == Regression::lwr;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
  RowMatrix right = RowMatrix::Zero(count, targets.front().value.cols());
  Eigen::VectorXd norm = Eigen::VectorXd::Zero(count);
  for (const ForcingTarget& target : targets) {
    const double share = 1.0 / static_cast<double>(target.s.size());
    const RowMatrix features = basis_.activations(target.s, true);
    const RowMatrix by = local ? basis_.activations(target.s, false) : features;
    gram += share * (by.transpose() * features);
    right += share * (by.transpose() * target.value);
    norm += share * by.colwise().sum().transpose();
  }
  if (!local) {
    gram.diagonal().array() += options_.ridge * gram.trace() / static_cast<double>(count);
    return gram.ldlt().solve(right);
  }
  RowMatrix weights = RowMatrix::Zero(count, right.cols());
  for (int pass = 0; pass < options_.passes; ++pass)
    weights += norm.cwiseInverse().asDiagonal() * (right - gram * weights);
  return weights;
}

double round_condition(const GaussianBasis& basis, double ridge) {
  const Index samples = 10 * basis.count();
  const RowMatrix features = basis.activations(Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0), true);
  Eigen::MatrixXd gram = features.transpose() * features;
  gram.diagonal().array() += ridge * gram.trace() / static_cast<double>(basis.count());
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
  return values.tail(1)[0] / std::max(values[0], 1e-300);
}

RowMatrix ForcingFit::solve(NormalEquations& equations, const std::vector<ForcingTarget>& targets,
                            Index first) const {
  double largest = 0.0;  // in whose unit the squares of tiny and huge scales stay within what a double holds
  for (const ForcingTarget& target : targets) largest = std::max(largest, std::abs(target.scale[first]));
  if (largest == 0.0) largest = 1.0;
  equations.clear();
  for (const ForcingTarget& target : targets) equations.add(target, first, target.scale[first] / largest);
  const bool local = options_.regression == Regression::lwr;
  return (local ? equations.solve_lwr(options_.passes) : equations.solve_ridge(options_.ridge)) / largest;
}

}  // namespace dmp::detail
