#include "primitive/distribution_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace dmp::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kLeastNoise = 1e-10;      // variance, of the squared extent
constexpr double kLeastSpread = 1e-12;     // variance of a weight, of the squared extent
constexpr double kStartSpread = 1e-6;      // added to the first covariance, of its mean diagonal
constexpr double kRidge = 1e-9;            // of the mean diagonal of B^T B
constexpr double kSpreadRounding = 1e-10;  // of the mean diagonal of the covariance
constexpr double kSettled = 1e-3;          // change of covariance and noise in a pass
// Samples per control point that count in full: what splines leave of a motion is not white, so that more
// samples of it say no more.
constexpr double kSamples = 4.0;

/// Of one demonstration, in units of the extents.
struct Example {
  double samples;  // that count
  SplineSums sums;
  VectorXd least;  // (n) weights by least squares
  RowMatrix left;  // (1 x d) squares that they leave
  Index like;      // the first example with the same B^T B
};

VectorXd flattened(const RowMatrix& by_point) {
  return Eigen::Map<const VectorXd>(by_point.data(), by_point.size());
}

Example example_of(const ControlPoints& points, const Deviation& scaled) {
  const auto samples = static_cast<double>(scaled.phase.size());
  const double share = std::min(1.0, kSamples * static_cast<double>(points.count()) / samples);
  Example example{share * samples, sums_of(points, scaled), {}, {}, 0};
  example.sums.gram *= share;
  example.sums.moment *= share;
  MatrixXd ridged = example.sums.gram;
  ridged.diagonal().array() += kRidge * ridged.diagonal().mean();
  const RowMatrix weights = ridged.ldlt().solve(example.sums.moment);
  example.least = flattened(weights);
  example.left = RowMatrix::Zero(1, scaled.value.cols());
  for (Index k = 0; k < scaled.phase.size(); ++k) {
    const Eigen::RowVectorXd again =
        value_of(points.at(scaled.phase[k]), example.least, scaled.value.cols()).transpose();
    example.left += share * (scaled.value.row(k) - again).cwiseAbs2();
  }
  return example;
}

/// a^T (gram x diagonal of an axis) a, axis by axis.
Eigen::RowVectorXd squares_by_axis(const MatrixXd& gram, const VectorXd& weights, Index axes) {
  const Eigen::Map<const RowMatrix> table(weights.data(), gram.rows(), axes);
  return (table.cwiseProduct(gram * table)).colwise().sum();
}

/// tr(gram x block of each axis of C).
Eigen::RowVectorXd traces_by_axis(const MatrixXd& gram, const MatrixXd& covariance, Index axes) {
  Eigen::RowVectorXd traces = Eigen::RowVectorXd::Zero(axes);
  for (Index i = 0; i < gram.rows(); ++i)
    for (Index j = std::max<Index>(0, i - 3); j < std::min(gram.rows(), i + 4); ++j)
      for (Index a = 0; a < axes; ++a) traces[a] += gram(i, j) * covariance(j * axes + a, i * axes + a);
  return traces;
}

/// The covariance of one control point's axes; those of different control points apart.
MatrixXd blocks_of(const MatrixXd& covariance, Index axes) {
  MatrixXd blocks = MatrixXd::Zero(covariance.rows(), covariance.cols());
  for (Index i = 0; i < covariance.rows(); i += axes)
    blocks.block(i, i, axes, axes) = covariance.block(i, i, axes, axes);
  return blocks;
}

/// (F^-T F^-1 + A)^-1, A the information of B^T B and the variances (d) of noise: halves of what is
/// symmetric.
MatrixXd left_open(const MatrixXd& gram, const VectorXd& variance, const MatrixXd& factor) {
  const Index axes = variance.size();
  const VectorXd weight = variance.cwiseInverse();
  MatrixXd seen = MatrixXd::Zero(factor.rows(), factor.cols());
  for (Index i = 0; i < gram.rows(); ++i)
    for (Index j = std::max<Index>(0, i - 3); j < std::min(gram.rows(), i + 4); ++j)
      seen.middleRows(i * axes, axes) +=
          (gram(i, j) * weight).asDiagonal() * factor.middleRows(j * axes, axes);
  MatrixXd inner(factor.rows(), factor.cols());
  inner.triangularView<Eigen::Lower>() = factor.transpose() * seen;
  inner.diagonal().array() += 1.0;
  const MatrixXd half = Eigen::LLT<MatrixXd>(inner).matrixL().solve(MatrixXd(factor.transpose()));
  MatrixXd open = MatrixXd::Zero(factor.rows(), factor.cols());
  open.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose());
  open.triangularView<Eigen::StrictlyUpper>() = open.transpose();
  return open;
}

class Expectation {
 public:
  Expectation(std::vector<Example> examples, std::vector<Index> parts, const DistributionOptions& options)
      : examples_(std::move(examples)), parts_(std::move(parts)), options_(options) {
    for (const Index part : parts_) axes_ += part;
    start();
  }

  WeightFit run() {
    for (int k = 0; k < options_.iterations && !iterate(); ++k) {
    }
    return {{mean_, MatrixXd(covariance_.llt().matrixL())}, noise_.cwiseSqrt()};
  }

 private:
  double count() const { return static_cast<double>(examples_.size()); }

  void start() {
    mean_ = VectorXd::Zero(examples_.front().least.size());
    for (const Example& example : examples_) mean_ += example.least / count();
    covariance_ = MatrixXd::Zero(mean_.size(), mean_.size());
    Eigen::RowVectorXd left = Eigen::RowVectorXd::Zero(axes_);
    for (const Example& example : examples_) {
      const VectorXd away = example.least - mean_;
      covariance_ += away * away.transpose() / count();
      left += example.left;
    }
    covariance_.diagonal().array() += kStartSpread * covariance_.diagonal().mean() + kLeastSpread;
    set_noise(left);
  }

  void set_noise(const Eigen::RowVectorXd& squares) {
    double samples = 0.0;
    for (const Example& example : examples_) samples += example.samples;
    noise_.resize(static_cast<Index>(parts_.size()));
    Index first = 0;
    for (std::size_t p = 0; p < parts_.size(); first += parts_[p++])
      noise_[static_cast<Index>(p)] = std::max(
          squares.segment(first, parts_[p]).sum() / (samples * static_cast<double>(parts_[p])), kLeastNoise);
  }

  /// True once nothing changes any more.
  bool iterate() {
    const MatrixXd covariance = covariance_;
    const VectorXd noise = noise_;
    const VectorXd variance = by_axis(noise_, parts_);
    const MatrixXd factor = covariance_.llt().matrixL();
    std::vector<VectorXd> found(examples_.size());
    std::vector<MatrixXd> spread(examples_.size());
    VectorXd mean = VectorXd::Zero(mean_.size());
    for (std::size_t m = 0; m < examples_.size(); ++m) {
      const Information seen = information_of(examples_[m].sums, variance);
      const auto like = static_cast<std::size_t>(examples_[m].like);
      if (like == m) spread[m] = left_open(examples_[m].sums.gram, variance, factor);
      found[m] = mean_ + spread[like] * (seen.vector - seen.matrix * mean_);
      mean += found[m] / count();
    }
    mean_ = mean;
    update(found, spread);
    return (covariance_ - covariance).norm() < kSettled * covariance.norm() &&
           (noise_ - noise).norm() < kSettled * noise.norm();
  }

  void update(const std::vector<VectorXd>& found, const std::vector<MatrixXd>& spread) {
    MatrixXd sum = MatrixXd::Zero(mean_.size(), mean_.size());
    Eigen::RowVectorXd squares = Eigen::RowVectorXd::Zero(axes_);
    for (std::size_t m = 0; m < examples_.size(); ++m) {
      const Example& example = examples_[m];
      const MatrixXd& own = spread[static_cast<std::size_t>(example.like)];
      const VectorXd away = found[m] - mean_;
      sum += away * away.transpose() + own;
      squares += example.left.row(0) + squares_by_axis(example.sums.gram, found[m] - example.least, axes_) +
                 traces_by_axis(example.sums.gram, own, axes_);
    }
    const MatrixXd blocks = blocks_of(sum / count(), axes_);
    covariance_ = (sum + options_.prior * blocks) / (count() + options_.prior);
    covariance_.diagonal().array() += kSpreadRounding * covariance_.diagonal().mean() + kLeastSpread;
    set_noise(squares);
  }

  std::vector<Example> examples_;
  std::vector<Index> parts_;
  DistributionOptions options_;
  Index axes_ = 0;
  VectorXd mean_;
  MatrixXd covariance_;
  VectorXd noise_;  // (parts) variance
};

}  // namespace

VectorXd by_axis(const VectorXd& of_parts, const std::vector<Index>& parts) {
  std::vector<double> values;
  for (std::size_t p = 0; p < parts.size(); ++p)
    values.insert(values.end(), static_cast<std::size_t>(parts[p]), of_parts[static_cast<Index>(p)]);
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

SplineSums sums_of(const ControlPoints& points, const Deviation& deviation) {
  SplineSums sums{MatrixXd::Zero(points.count(), points.count()),
                  RowMatrix::Zero(points.count(), deviation.value.cols())};
  for (Index k = 0; k < deviation.phase.size(); ++k) {
    const SplineRow row = points.at(deviation.phase[k]);
    const Eigen::Map<const Eigen::Vector4d> value(row.value.data());
    sums.gram.block<4, 4>(row.first, row.first) += value * value.transpose();
    sums.moment.middleRows<4>(row.first) += value * deviation.value.row(k);
  }
  return sums;
}

Information information_of(const SplineSums& sums, const VectorXd& variance) {
  const Index axes = variance.size();
  const Index count = sums.gram.rows();
  Information information{MatrixXd::Zero(count * axes, count * axes), VectorXd(count * axes)};
  for (Index i = 0; i < count; ++i) {
    for (Index j = std::max<Index>(0, i - 3); j < std::min(count, i + 4); ++j)
      for (Index a = 0; a < axes; ++a)
        information.matrix(i * axes + a, j * axes + a) = sums.gram(i, j) / variance[a];
    information.vector.segment(i * axes, axes) = sums.moment.row(i).transpose().cwiseQuotient(variance);
  }
  return information;
}

WeightFit fit_weights(const ControlPoints& points, const std::vector<Deviation>& deviations,
                      const std::vector<Index>& parts, const VectorXd& extent,
                      const DistributionOptions& options) {
  const VectorXd unit = by_axis(extent, parts);
  std::vector<Example> examples;
  for (std::size_t m = 0; m < deviations.size(); ++m) {
    Deviation scaled = deviations[m];
    scaled.value *= unit.cwiseInverse().asDiagonal();
    examples.push_back(example_of(points, scaled));
    Example& example = examples.back();
    while (examples[static_cast<std::size_t>(example.like)].sums.gram != example.sums.gram) ++example.like;
  }
  WeightFit fit = Expectation(std::move(examples), parts, options).run();
  const VectorXd units = unit.replicate(points.count(), 1);
  fit.weights.mean = units.asDiagonal() * fit.weights.mean;
  fit.weights.factor = units.asDiagonal() * fit.weights.factor;
  fit.noise = fit.noise.cwiseProduct(extent);
  return fit;
}

}  // namespace dmp::detail
