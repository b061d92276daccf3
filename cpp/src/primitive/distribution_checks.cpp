#include "primitive/distribution_checks.hpp"

#include <dmp/error.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace dmp {
namespace detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double kSmallest = 1e-100;  // squares and ratios of what lies between stay finite
constexpr double kLargest = 1e100;
}  // namespace

void require_options(const DistributionOptions& options) {
  if (options.control_points < 4 || options.control_points > 200)
    throw InvalidArgument("control_points: " + std::to_string(options.control_points) +
                          ", expected 4 to 200.");
  if (!(options.prior >= 0.1 && options.prior <= 1000.0))
    throw InvalidArgument("prior: " + number(options.prior) + ", expected 0.1 to 1000 demonstrations.");
  if (options.iterations < 1 || options.iterations > 1000)
    throw InvalidArgument("iterations: " + std::to_string(options.iterations) + ", expected 1 to 1000.");
}

void require_phase(double phase, const std::string& name) {
  if (!(phase >= 0.0 && phase <= 1.0))
    throw InvalidArgument(name + ": " + number(phase) + ", expected a phase from 0 to 1.");
}

void require_positive(const VectorXd& values, Index size, const std::string& name) {
  if (values.size() != size)
    throw InvalidArgument(name + ": " + std::to_string(values.size()) + " numbers, expected " +
                          std::to_string(size) + ".");
  for (Index i = 0; i < size; ++i)
    if (!(values[i] >= kSmallest && values[i] <= kLargest))
      throw InvalidArgument(indexed(name, i) + ": " + number(values[i]) +
                            ", expected a positive number, 1e-100 to 1e100.");
}

const VectorXd& require_noise(const VectorXd& noise, const std::vector<Index>& parts) {
  require_positive(noise, static_cast<Index>(parts.size()), "noise");
  return noise;
}

MatrixXd deviation_from(const std::optional<MatrixXd>& covariance, const std::vector<Index>& axes, Index all,
                        const std::string& name) {
  const auto count = static_cast<Index>(axes.size());
  if (!covariance) return MatrixXd::Zero(count, count);
  const std::string size = std::to_string(all) + " x " + std::to_string(all);
  if (covariance->rows() != all || covariance->cols() != all)
    throw InvalidArgument(name + ": " + std::to_string(covariance->rows()) + " x " +
                          std::to_string(covariance->cols()) + ", expected " + size + ".");
  MatrixXd chosen(count, count);
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j)
      chosen(i, j) = (*covariance)(axes[static_cast<std::size_t>(i)], axes[static_cast<std::size_t>(j)]);
  const Eigen::LLT<MatrixXd> llt(chosen);
  const double asymmetry = (chosen - chosen.transpose()).cwiseAbs().maxCoeff();
  if (!chosen.allFinite() || !(asymmetry <= 1e-9 * chosen.cwiseAbs().maxCoeff()) ||
      llt.info() != Eigen::Success)
    throw InvalidArgument(name + ": not symmetric and positive definite, expected a covariance, " + size +
                          ". Leave it out for what is known exactly.");
  return llt.matrixL();
}

std::vector<Index> axes_from(const std::vector<Index>& given, Index all, const std::string& name) {
  std::vector<Index> axes = given;
  std::sort(axes.begin(), axes.end());
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i] < 0 || axes[i] >= all || (i > 0 && axes[i] == axes[i - 1]))
      throw InvalidArgument(name + ": " + std::to_string(axes[i]) + ", expected different axes from 0 to " +
                            std::to_string(all - 1) + ".");
  for (Index i = 0; given.empty() && i < all; ++i) axes.push_back(i);
  return axes;
}

VectorXd phases_of(const VectorXd& time, double whole, double phase) {
  if (!(whole > 0.0 && std::isfinite(whole)))
    throw InvalidArgument("duration: " + number(whole) + ", expected a positive number of seconds.");
  require_phase(phase, "phase");
  VectorXd phases = time / whole;
  phases.array() += phase;
  const double last = phases[phases.size() - 1];
  if (!(last <= 1.0 + 1e-9))
    throw InvalidArgument("part: ends at " + number(last) + " of the motion's " + number(whole) +
                          " s, expected 1 at most. State the duration of the whole motion, or cut the "
                          "recording.");
  return phases.cwiseMin(1.0);
}

void require_weights(const VectorXd& weights, std::size_t count) {
  if (count == 0) throw InvalidArgument("distributions: none, expected at least one.");
  require_positive(weights, static_cast<Index>(count), "weights");
}

void require_fields(const DistributionOptions& options, Index demonstrations, double duration,
                    const VectorXd& mean, const RowMatrix& factor, const VectorXd& noise, Index axes,
                    Index parts) {
  require_options(options);
  const Index n = options.control_points * axes;
  const std::string size = std::to_string(n);
  if (demonstrations < 2)
    throw InvalidArgument("demonstrations: " + std::to_string(demonstrations) + ", expected 2 or more.");
  if (!(duration > 0.0 && std::isfinite(duration)))
    throw InvalidArgument("duration: " + number(duration) + ", expected a positive number.");
  if (mean.size() != n || !mean.allFinite())
    throw InvalidArgument("mean: expected " + size + " finite numbers, one for each control point and axis.");
  if (factor.rows() != n || factor.cols() != n || !factor.allFinite())
    throw InvalidArgument("factor: expected " + size + " x " + size + " finite numbers.");
  require_positive(noise, parts, "noise");
}

double share_of_samples(const VectorXd& phases, const ControlPoints& points) {
  const double spans = static_cast<double>(points.count() - 3);
  const double covered = std::max(1.0, (phases[phases.size() - 1] - phases[0]) * spans);
  return kMisfit * std::max(1.0, static_cast<double>(phases.size()) / covered);
}

double widening(std::size_t demonstrations) {
  const double count = static_cast<double>(demonstrations);
  const double freedom = std::max(count - 1.0, 3.0);  // below that the quantile says that nothing is known
  const double quantile = 2.0 + 2.5 / freedom + 3.0625 / (freedom * freedom);
  return 0.5 * quantile * std::sqrt((count + 1.0) / (count - 1.0));
}

Information no_information(Index weights) {
  return {MatrixXd::Zero(weights, weights), VectorXd::Zero(weights)};
}

void add(Information& seen, const SplineRow& row, const VectorXd& value, const VectorXd& variance) {
  const Index axes = value.size();
  for (std::size_t i = 0; i < 4; ++i) {
    const Index from = (row.first + static_cast<Index>(i)) * axes;
    seen.vector.segment(from, axes) += row.value[i] * value.cwiseQuotient(variance);
    for (std::size_t j = 0; j < 4; ++j)
      seen.matrix.block(from, (row.first + static_cast<Index>(j)) * axes, axes, axes).diagonal() +=
          row.value[i] * row.value[j] * variance.cwiseInverse();
  }
}

MatrixXd precision_of(const MatrixXd& factor, std::size_t j) {
  const MatrixXd covariance = factor * factor.transpose();
  const VectorXd scale = covariance.diagonal().cwiseSqrt();
  const auto refuse = [&] {
    throw InvalidArgument(indexed("distributions", static_cast<long>(j)) +
                          ": leaves nothing open somewhere, because it was conditioned exactly. Blend "
                          "first, or condition with a covariance.");
  };
  if (!(scale.minCoeff() > 0.0)) refuse();
  const VectorXd inverse = scale.cwiseInverse();
  const Eigen::LLT<MatrixXd> llt(MatrixXd(inverse.asDiagonal() * covariance * inverse.asDiagonal()));
  if (llt.info() != Eigen::Success || !(llt.rcond() > 1e-13)) refuse();
  return inverse.asDiagonal() * llt.solve(MatrixXd::Identity(factor.rows(), factor.rows())) *
         inverse.asDiagonal();
}

}  // namespace detail

Eigen::MatrixXd damping_of(const Eigen::MatrixXd& stiffness, double zeta) {
  detail::require_positive(Eigen::VectorXd::Constant(1, zeta), 1, "zeta");
  if (stiffness.rows() != stiffness.cols() || stiffness.size() == 0 || !stiffness.allFinite() ||
      !stiffness.isApprox(stiffness.transpose(), 1e-9))
    throw InvalidArgument("stiffness: expected a symmetric matrix of finite numbers.");
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(stiffness);
  if (!(eigen.eigenvalues().minCoeff() > 0.0))
    throw InvalidArgument("stiffness: not positive definite, expected what Distribution::stiffness gives.");
  return 2.0 * zeta * eigen.operatorSqrt();
}

}  // namespace dmp
