#include "primitive/weight_gaussian.hpp"

#include <Eigen/Cholesky>

namespace dmp::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kOpen =
    1e-12;  // of the largest variance that such rows could have: what is less is rounding

/// I + F^T A F as its Cholesky factor.
Eigen::LLT<MatrixXd> gain_of(const MatrixXd& factor, const MatrixXd& information) {
  MatrixXd inner = factor.transpose() * (information * factor);
  inner.diagonal().array() += 1.0;
  return inner.llt();
}

}  // namespace

bool condition(WeightGaussian& weights, const LinearObservation& seen) {
  const MatrixXd v = weights.factor.transpose() * seen.rows.transpose();
  const MatrixXd g = v.transpose() * v + seen.deviation * seen.deviation.transpose();
  const double largest = weights.factor.rowwise().squaredNorm().maxCoeff();
  const VectorXd scale = (kOpen * largest * seen.rows.rowwise().squaredNorm()).cwiseSqrt();
  const MatrixXd root = g.llt().matrixL();
  for (Index i = 0; i < root.rows(); ++i)
    if (!(root(i, i) > scale[i])) return false;
  const MatrixXd gain = weights.factor * v;  // F F^T H^T
  const VectorXd away = seen.value - seen.rows * weights.mean;
  const auto lower = root.triangularView<Eigen::Lower>();
  weights.mean += gain * lower.transpose().solve(lower.solve(away));
  const MatrixXd sum = root + seen.deviation;  // lower, too
  const MatrixXd inner = sum.triangularView<Eigen::Lower>().solve(v.transpose());
  weights.factor -= gain * lower.transpose().solve(inner);
  return true;
}

void condition(WeightGaussian& weights, const Information& seen) {
  const auto gain = gain_of(weights.factor, seen.matrix);
  weights.factor = gain.matrixL().solve(weights.factor.transpose()).transpose().eval();
  const VectorXd away = seen.vector - seen.matrix * weights.mean;
  weights.mean += weights.factor * (weights.factor.transpose() * away);
}

double deviance_change(const MatrixXd& factor, const Information& seen) {
  const auto gain = gain_of(factor, seen.matrix);
  const VectorXd inner = gain.matrixL().solve(factor.transpose() * seen.vector);
  return 2.0 * gain.matrixLLT().diagonal().array().log().sum() - inner.squaredNorm();
}

}  // namespace dmp::detail
