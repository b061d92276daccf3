#include <dmp/error.hpp>
#include <dmp/spline.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "detail/local_basis.hpp"
#include "detail/smoothing_fit.hpp"

namespace dmp {
namespace {

using detail::LocalBasis;
using Eigen::Index;

/// Solves the banded system in place by elimination without pivoting, which is stable for a B-spline
/// collocation matrix (totally positive: de Boor and Pinkus 1977). band(i, j - i + half) = A(i, j); b becomes
/// the solution.
void solve_banded(RowMatrix& band, RowMatrix& b, Index half) {
  const Index n = band.rows();
  const Index columns = b.cols();
  const auto subtract = [columns](double factor, const double* from, double* row) {
    for (Index c = 0; c < columns; ++c) row[c] -= factor * from[c];
  };
  for (Index i = 0; i < n; ++i) {
    const Index last = std::min(i + half, n - 1);
    for (Index r = i + 1; r <= last; ++r) {
      const double below = band(r, i - r + half);
      if (below == 0.0) continue;
      const double factor = below / band(i, half);
      for (Index c = i; c <= last; ++c) band(r, c - r + half) -= factor * band(i, c - i + half);
      subtract(factor, b.row(i).data(), b.row(r).data());
    }
  }
  for (Index i = n - 1; i >= 0; --i) {
    double* const row = b.row(i).data();
    for (Index c = i + 1; c <= std::min(i + half, n - 1); ++c)
      subtract(band(i, c - i + half), b.row(c).data(), row);
    for (Index c = 0; c < columns; ++c) row[c] /= band(i, half);
  }
}

/// row_c = sum_j basis_j coefficient_jc, rows of coefficients one behind the other.
void blend(const std::array<double, 6>& basis, int degree, const double* coefficient, Index dims,
           double* row) {
  for (Index c = 0; c < dims; ++c) {
    double sum = basis[0] * coefficient[c];
    for (int j = 1; j <= degree; ++j) sum += basis[j] * coefficient[j * dims + c];
    row[c] = sum;
  }
}

void require(const Eigen::VectorXd& times, const RowMatrix& values) {
  if (times.size() < 2 || times.size() != values.rows())
    throw InvalidArgument("times: " + std::to_string(times.size()) + " for " + std::to_string(values.rows()) +
                          " rows of values, expected one each and at least 2.");
  for (Index k = 1; k < times.size(); ++k)
    if (!(times[k] > times[k - 1]))
      throw InvalidArgument("times[" + std::to_string(k) +
                            "]: not after the one before, expected increasing times.");
}

std::vector<double> not_a_knot(const Eigen::VectorXd& times, int degree) {
  const Index n = times.size();
  const Index skipped = (degree + 1) / 2;  // samples at either end that are no knots
  std::vector<double> knots(degree + 1, times[0]);
  if (n > degree + 1)
    for (Index i = skipped; i < n - skipped; ++i) knots.push_back(times[i]);
  knots.insert(knots.end(), degree + 1, times[n - 1]);
  return knots;
}

}  // namespace

Spline::Spline(const Eigen::VectorXd& times, const RowMatrix& values)
    : degree_(static_cast<int>(std::min<Index>(kDegree, times.size() - 1))) {
  require(times, values);
  knots_ = not_a_knot(times, degree_);
  interpolate(times, values);
  differentiate();
}

Spline::Spline(std::vector<double> knots, RowMatrix coefficients)
    : degree_(kDegree), knots_(std::move(knots)) {
  coefficients_[0] = std::move(coefficients);
  differentiate();
}

Spline Spline::smoothing(const Eigen::VectorXd& times, const RowMatrix& values, Smoothing* report) {
  if (report) *report = {Eigen::VectorXd::Zero(values.cols()), Eigen::VectorXd::Zero(values.cols())};
  if (times.size() < 10) return {times, values};
  detail::SmoothingFit fit(times);
  Spline spline(fit.knots(), fit.solve(values));
  if (report) {
    const RowMatrix residual = values - spline.sample(times).value;
    report->removed = (residual.colwise().squaredNorm() / static_cast<double>(times.size())).cwiseSqrt();
    report->noise = report->removed * std::sqrt(static_cast<double>(times.size()) / fit.freedom());
  }
  return spline;
}

Index Spline::interval(double time) const noexcept { return detail::interval_of(knots_, degree_, time); }

void Spline::interpolate(const Eigen::VectorXd& times, const RowMatrix& values) {
  const Index n = times.size();
  const Index half = degree_;
  RowMatrix band = RowMatrix::Zero(n, 2 * half + 1);
  for (Index i = 0; i < n; ++i) {
    const Index at = interval(times[i]);
    const LocalBasis basis(knots_.data(), at, degree_, times[i]);
    for (Index j = 0; j <= degree_; ++j) band(i, at - degree_ + j - i + half) = basis.values[0][j];
  }
  coefficients_[0] = values;
  solve_banded(band, coefficients_[0], half);
}

void Spline::differentiate() {
  for (int d = 1; d <= 2; ++d) {
    const RowMatrix& upper = coefficients_[d - 1];
    const int degree = degree_ - d + 1;
    RowMatrix lower = RowMatrix::Zero(std::max<Index>(upper.rows() - 1, 1), upper.cols());
    for (Index i = 0; degree > 0 && i + 1 < upper.rows(); ++i) {
      const double span = knots_[i + degree_ + 1] - knots_[i + d];
      lower.row(i) = degree / span * (upper.row(i + 1) - upper.row(i));
    }
    coefficients_[d] = lower;
  }
}

Spline::Samples Spline::sample(const Eigen::VectorXd& times) const {
  const Index n = times.size();
  const Index dims = dimension();
  Samples samples{RowMatrix(n, dims), RowMatrix(n, dims), RowMatrix(n, dims)};
  std::array<RowMatrix*, 3> out{&samples.value, &samples.first, &samples.second};
  for (int d = degree_ + 1; d <= 2; ++d) out[d]->setZero();
  for (Index k = 0; k < n; ++k) {
    const Index at = interval(times[k]);
    const LocalBasis basis(knots_.data(), at, degree_, times[k]);
    for (int d = 0; d <= std::min(2, degree_); ++d)
      blend(basis.values[d], degree_ - d, coefficients_[d].row(at - degree_).data(), dims,
            out[d]->row(k).data());
  }
  return samples;
}

}  // namespace dmp
