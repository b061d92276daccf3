#include "spline/smoothing_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spline/local_basis.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kDecade = 10.0;

std::shared_ptr<const Knots> every_so_many(const VectorXd& times, Index every, int degree) {
  const Index n = times.size();
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, times[0]);
  for (Index k = every; k < n - every; k += every) knots.push_back(times[k]);
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, times[n - 1]);
  return std::make_shared<const Knots>(std::move(knots), degree);
}

}  // namespace

SmoothingKnots::SmoothingKnots(const VectorXd& times, const VectorXd& weights, Index every)
    : weights_(weights), knots_(every_so_many(times, every, kDegree)) {
  gram_ = Band::Zero(knots_->count(), kDegree + 1);
  roughness_ = Band::Zero(knots_->count(), kDegree + 1);
  add_samples(times);
  add_roughness();
}

void SmoothingKnots::add_samples(const VectorXd& times) {
  interval_.reserve(static_cast<std::size_t>(times.size()));
  row_.reserve(static_cast<std::size_t>(times.size()));
  Index at = kDegree;
  for (Index k = 0; k < times.size(); ++k) {
    at = knots_->interval(times[k], at);
    const Local row = LocalBasis(*knots_, at, times[k]).values[0];
    for (Index a = 0; a <= kDegree; ++a)
      for (Index b = a; b <= kDegree; ++b) gram_(at - kDegree + a, b - a) += weights_[k] * row[a] * row[b];
    interval_.push_back(at);
    row_.push_back(row);
  }
}

/// The third derivative is a sum of parabolas, of third differences of six coefficients.
SmoothingKnots::Differences SmoothingKnots::third_differences(Index interval) const {
  Differences rows{};
  std::array<double, 6> unit;
  for (int c = 0; c <= kDegree; ++c) {
    unit.fill(0.0);
    unit[static_cast<std::size_t>(c)] = 1.0;
    for (int d = 1; d <= 3; ++d)
      for (int i = std::max(c - d, 0); i <= std::min(c, kDegree - d); ++i) {
        const int degree = kDegree - d + 1;
        const double inverse = knots_->inverse_span(degree, interval - kDegree + i + d);
        const auto k = static_cast<std::size_t>(i);
        unit[k] = degree * inverse * (unit[k + 1] - unit[k]);
      }
    for (std::size_t i = 0; i < 3; ++i) rows[i][static_cast<std::size_t>(c)] = unit[i];
  }
  return rows;
}

void SmoothingKnots::add_roughness() {
  // Gauss's rule of three points is exact for the product of two piecewise parabolas.
  constexpr std::array<double, 3> node{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  for (Index at = kDegree; at < knots_->count(); ++at) {
    const double span = (*knots_)[at + 1] - (*knots_)[at];
    const Differences differences = third_differences(at);
    for (std::size_t g = 0; g < 3; ++g) {
      const LocalBasis basis(*knots_, at, (*knots_)[at] + 0.5 * span * (1.0 + node[g]));
      Local third{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 6; ++c) third[c] += basis.values[3][i] * differences[i][c];
      for (Index a = 0; a <= kDegree; ++a)
        for (Index b = a; b <= kDegree; ++b)
          roughness_(at - kDegree + a, b - a) += span * weight[g] * third[a] * third[b];
    }
  }
}

RowMatrix SmoothingKnots::projected(const RowMatrix& values) const {
  const Index columns = values.cols();
  RowMatrix sum = RowMatrix::Zero(knots_->count(), columns);
  for (Index k = 0; k < values.rows(); ++k) {
    const Local& row = row_[static_cast<std::size_t>(k)];
    double* const to = sum.row(interval_[static_cast<std::size_t>(k)] - kDegree).data();
    for (Index j = 0; j <= kDegree; ++j)
      for (Index c = 0; c < columns; ++c) to[j * columns + c] += weights_[k] * row[j] * values(k, c);
  }
  return sum;
}

double SmoothingKnots::residual(const RowMatrix& coefficients, const RowMatrix& projected,
                                double squares) const {
  const double sum =
      squares - 2.0 * coefficients.cwiseProduct(projected).sum() + quadratic_form(gram_, coefficients);
  return std::max(sum, 0.0);
}

const SmoothingKnots::Factor& SmoothingKnots::factor(double lambda) {
  const auto known = factors_.find(lambda);
  if (known != factors_.end()) return known->second;
  constexpr Index kMostNumbers = 8'000'000;  // in all factors that are kept: 64 MB
  if (static_cast<Index>(factors_.size() + 1) * gram_.size() > kMostNumbers) factors_.clear();
  BandCholesky cholesky(gram_ + lambda * roughness_);
  const double freedom = cholesky.trace_of_inverse_times(gram_);
  return factors_.emplace(lambda, Factor{std::move(cholesky), freedom}).first->second;
}

SmoothingGrid::SmoothingGrid(const VectorXd& times, const VectorXd& weights)
    : times_(times), weights_(weights), measured_(weights.sum()) {
  step_ = (times[times.size() - 1] - times[0]) / std::max(measured_ - 1.0, 1.0);
  unit_ = std::pow(step_ / M_PI, 6.0) / step_;
}

/// How many samples lie between two knots: few knots do where the spline is stiff, and more of them would
/// cost digits, as the roughness outweighs the samples by the sixth power of their number.
Index SmoothingGrid::level_for(double lambda) const {
  const double freedom = 3.0 + 1.05 * measured_ * std::pow(std::max(lambda / unit_, 1e-6), -1.0 / 6.0);
  Index every = 1;
  while (static_cast<double>(times_.size()) / static_cast<double>(2 * every) > 5.0 * freedom + 20.0)
    every *= 2;
  return every;
}

SmoothingKnots& SmoothingGrid::knots_for(double lambda) {
  const Index every = level_for(lambda);
  const auto known = levels_.find(every);
  if (known != levels_.end()) return known->second;
  constexpr Index kMostSamples = 2'000'000;  // in all levels that are kept: 56 bytes each
  if (static_cast<Index>(levels_.size() + 1) * times_.size() > kMostSamples) levels_.clear();
  return levels_.try_emplace(every, times_, weights_, every).first->second;
}

SmoothingFit::SmoothingFit(SmoothingGrid& grid, const RowMatrix& values)
    : grid_(grid), values_(values), mean_(values.colwise().mean()) {
  values_.rowwise() -= mean_;
  squares_ = grid.weights().dot(values_.rowwise().squaredNorm());
}

const RowMatrix& SmoothingFit::projected(double lambda) {
  const Index level = grid_.level_for(lambda);
  const auto known = projected_.find(level);
  if (known != projected_.end()) return known->second;
  return projected_.emplace(level, grid_.knots_for(lambda).projected(values_)).first->second;
}

SmoothingFit::Point SmoothingFit::at(double lambda) {
  SmoothingKnots& knots = grid_.knots_for(lambda);
  const SmoothingKnots::Factor& factor = knots.factor(lambda);
  const RowMatrix& b = projected(lambda);
  return {lambda, factor.freedom, knots.residual(factor.cholesky.solve(b), b, squares_)};
}

SmoothingFit::Curve SmoothingFit::curve(double lambda) {
  SmoothingKnots& knots = grid_.knots_for(lambda);
  RowMatrix coefficients = knots.factor(lambda).cholesky.solve(projected(lambda));
  coefficients.rowwise() += mean_;  // B-splines sum up to 1
  return {knots.knots(), std::move(coefficients)};
}

double SmoothingFit::score(const Point& point) const {
  const double left = grid_.measured() - point.freedom;
  if (!(left > 1e-3 * grid_.measured())) return std::numeric_limits<double>::infinity();
  return point.residual / (left * left);
}

/// From hardly any smoothing to a parabola, by factors of 10^(3/4): a fifth to a third of the freedom each.
const std::vector<SmoothingFit::Point>& SmoothingFit::scan() {
  if (!scanned_.empty()) return scanned_;
  constexpr double kFactor = 5.623413251903491;
  constexpr int kMost = 60;
  double lambda = 0.1 * grid_.unit();
  for (int i = 0; i < kMost; ++i, lambda *= kFactor) {
    scanned_.push_back(at(lambda));
    if (scanned_.back().freedom < 3.1) break;
  }
  return scanned_;
}

SmoothingFit::Point SmoothingFit::best() {
  const std::vector<Point>& points = scan();
  std::size_t least = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (score(points[i]) < score(points[least])) least = i;
  if (least == 0 || least + 1 == points.size()) return points[least];
  Point best = points[least];
  double width = 0.75;  // decades to either neighbour
  for (int i = 0; i < 3; ++i) {
    const Point below = i == 0 ? points[least - 1] : at(best.lambda * std::pow(kDecade, -width));
    const Point above = i == 0 ? points[least + 1] : at(best.lambda * std::pow(kDecade, width));
    const double curvature = score(below) - 2.0 * score(best) + score(above);
    if (!(curvature > 0.0)) break;
    const double shift = std::clamp(0.5 * width * (score(below) - score(above)) / curvature, -width, width);
    const Point next = at(best.lambda * std::pow(kDecade, shift));
    if (score(next) <= score(best)) best = next;
    if (std::abs(shift) < 0.05 && i > 0) break;
    width /= 3.0;
  }
  return best;
}

SmoothingFit::Point SmoothingFit::with_freedom(double share) {
  const double wanted = share * grid_.measured();
  const std::vector<Point>& points = scan();
  std::size_t i = 1;
  while (i + 1 < points.size() && points[i].freedom > wanted) ++i;
  Point above = points[i - 1];
  Point below = points[i];
  for (int tries = 0; tries < 6; ++tries) {
    const double part = std::clamp((above.freedom - wanted) / (above.freedom - below.freedom), 0.05, 0.95);
    const Point middle = at(above.lambda * std::pow(below.lambda / above.lambda, part));
    if (std::abs(middle.freedom - wanted) < 0.005 * grid_.measured()) return middle;
    (middle.freedom > wanted ? above : below) = middle;
  }
  return below;
}

double SmoothingFit::lambda_of(double frequency) const {
  return 1.0 / (grid_.step() * std::pow(2.0 * M_PI * frequency, 6.0));
}

double SmoothingFit::frequency_of(double lambda) const {
  return std::pow(lambda * grid_.step(), -1.0 / 6.0) / (2.0 * M_PI);
}

}  // namespace dmp::detail
