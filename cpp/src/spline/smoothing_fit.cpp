#include "spline/smoothing_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spline/local_basis.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// More knots than these would cost condition and time and no person's motion needs them.
constexpr double kKnotsPerSecond = 40.0;
constexpr Index kFewKnots = 200;

/// A knot at every sample, or at every second, third, .. of them where there are many.
Knots knots_at(const VectorXd& times, int degree) {
  const Index n = times.size();
  const double most = kFewKnots + kKnotsPerSecond * (times[n - 1] - times[0]);
  const Index every = std::max<Index>(1, static_cast<Index>(std::ceil(static_cast<double>(n) / most)));
  std::vector<double> knots(degree + 1, times[0]);
  for (Index k = every; k < n - every; k += every) knots.push_back(times[k]);
  knots.insert(knots.end(), degree + 1, times[n - 1]);
  return {std::move(knots), degree};
}

/// A = L D L^T of a symmetric band matrix, and what smoothing needs of it.
template <class Band>
class BandCholesky {
 public:
  explicit BandCholesky(const Band& a) : l_(a) {
    const Index n = a.rows();
    for (Index j = 0; j < n; ++j) {
      const Index last = std::min<Index>(width() - 1, n - 1 - j);
      for (Index k = 1; k <= last; ++k) {
        const double factor = l_(j, k) / l_(j, 0);
        for (Index i = k; i <= last; ++i) l_(j + k, i - k) -= factor * l_(j, i);
      }
      for (Index k = 1; k <= last; ++k) l_(j, k) /= l_(j, 0);
    }
  }

  bool positive() const { return (l_.col(0).array() > 0.0).all(); }

  RowMatrix solve(RowMatrix b) const {
    const Index n = l_.rows();
    for (Index j = 0; j < n; ++j)
      for (Index k = 1; k < std::min(width(), n - j); ++k) b.row(j + k) -= l_(j, k) * b.row(j);
    for (Index j = n - 1; j >= 0; --j) {
      b.row(j) /= l_(j, 0);
      for (Index k = 1; k < std::min(width(), n - j); ++k) b.row(j) -= l_(j, k) * b.row(j + k);
    }
    return b;
  }

  /// trace(A^-1 M) for a band matrix M: only the band of the inverse is needed (Hutchinson and de Hoog 1985,
  /// Numerische Mathematik 47).
  double trace_of_inverse_times(const Band& m) const {
    const Index n = l_.rows();
    Band z = Band::Zero(n, width());
    double trace = 0.0;
    for (Index j = n - 1; j >= 0; --j) {
      const Index last = std::min<Index>(width() - 1, n - 1 - j);
      for (Index i = last; i >= 0; --i) {
        double value = i == 0 ? 1.0 / l_(j, 0) : 0.0;
        for (Index k = 1; k <= last; ++k) {
          const Index low = std::min(i, k);
          value -= l_(j, k) * z(j + low, std::max(i, k) - low);
        }
        z(j, i) = value;
        // For i = 0 the sum above took z(j, k), which are known by then.
      }
      trace += z(j, 0) * m(j, 0);
      for (Index i = 1; i <= last; ++i) trace += 2.0 * z(j, i) * m(j, i);
    }
    return trace;
  }

 private:
  Index width() const { return l_.cols(); }
  Band l_;  // column 0: D
};

}  // namespace

SmoothingFit::SmoothingFit(const VectorXd& times) : samples_(times.size()), knots_(knots_at(times, kDegree)) {
  const Index count = knots_.count();
  gram_ = Band::Zero(count, kDegree + 1);
  roughness_ = Band::Zero(count, kDegree + 1);
  add_samples(times);
  add_roughness();
}

void SmoothingFit::add_samples(const VectorXd& times) {
  Index at = kDegree;
  for (Index k = 0; k < samples_; ++k) {
    at = knots_.interval(times[k], at);
    const Local row = LocalBasis(knots_, at, times[k]).values[0];
    for (Index a = 0; a <= kDegree; ++a)
      for (Index b = a; b <= kDegree; ++b) gram_(at - kDegree + a, b - a) += row[a] * row[b];
    interval_.push_back(at);
    row_.push_back(row);
  }
}

SmoothingFit::Local SmoothingFit::third_derivatives(Index interval, double time) const {
  const Local quadratic = LocalBasis(knots_, interval, time).values[3];
  Local weight{};
  for (int c = 0; c <= kDegree; ++c) {  // the third differences of the c-th unit vector of coefficients
    Local coefficient{};
    coefficient[c] = 1.0;
    for (int d = 1; d <= 3; ++d)
      for (int i = 0; i <= kDegree - d; ++i) {
        const Index first = interval - kDegree + i;
        const int degree = kDegree - d + 1;
        coefficient[i] =
            degree * knots_.inverse_span(degree, first + d) * (coefficient[i + 1] - coefficient[i]);
      }
    for (int i = 0; i <= kDegree - 3; ++i) weight[c] += quadratic[i] * coefficient[i];
  }
  return weight;
}

void SmoothingFit::add_roughness() {
  // Gauss's rule of three points is exact for the product of two piecewise parabolas.
  constexpr std::array<double, 3> node{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  for (Index at = kDegree; at < knots_.count(); ++at) {
    const double span = knots_[at + 1] - knots_[at];
    for (std::size_t g = 0; g < 3; ++g) {
      const Local third = third_derivatives(at, knots_[at] + 0.5 * span * (1.0 + node[g]));
      for (Index a = 0; a <= kDegree; ++a)
        for (Index b = a; b <= kDegree; ++b)
          roughness_(at - kDegree + a, b - a) += span * weight[g] * third[a] * third[b];
    }
  }
}

RowMatrix SmoothingFit::evaluated(const RowMatrix& coefficients) const {
  RowMatrix values = RowMatrix::Zero(samples_, coefficients.cols());
  for (Index k = 0; k < samples_; ++k)
    for (Index j = 0; j <= kDegree; ++j)
      values.row(k) += row_[k][j] * coefficients.row(interval_[k] - kDegree + j);
  return values;
}

double SmoothingFit::score(double lambda, const RowMatrix& projected, const RowMatrix& values) {
  const BandCholesky<Band> cholesky(gram_ + lambda * roughness_);
  if (!cholesky.positive()) return std::numeric_limits<double>::infinity();
  const double n = static_cast<double>(samples_);
  coefficients_ = cholesky.solve(projected);
  freedom_ = n - cholesky.trace_of_inverse_times(gram_);
  if (!(freedom_ > 1e-3 * n)) return std::numeric_limits<double>::infinity();
  return n * (values - evaluated(coefficients_)).squaredNorm() / (freedom_ * freedom_);
}

RowMatrix SmoothingFit::solve(const RowMatrix& values) {
  RowMatrix projected = RowMatrix::Zero(gram_.rows(), values.cols());
  for (Index k = 0; k < samples_; ++k)
    for (Index j = 0; j <= kDegree; ++j)
      projected.row(interval_[k] - kDegree + j) += row_[k][j] * values.row(k);
  const double scale = gram_.col(0).sum() / roughness_.col(0).sum();
  const auto at = [&](double exponent) { return score(scale * std::pow(10.0, exponent), projected, values); };
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (double exponent = -6.0; exponent <= 12.0; exponent += 0.5) {
    const double now = at(exponent);
    if (now < least) {
      least = now;
      best = exponent;
    }
  }
  double low = best - 0.5;
  double high = best + 0.5;
  constexpr double kGolden = 0.6180339887498949;
  while (high - low > 0.02) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    (at(left) < at(right) ? high : low) = at(left) < at(right) ? right : left;
  }
  at(0.5 * (low + high));
  return coefficients_;
}

}  // namespace dmp::detail
