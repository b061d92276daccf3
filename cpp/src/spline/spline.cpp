#include <dmp/error.hpp>
#include <dmp/spline.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "spline/collocation.hpp"
#include "spline/denoising.hpp"
#include "spline/end_conditions.hpp"
#include "spline/local_basis.hpp"

namespace dmp {
namespace {

using detail::LocalBasis;
using Eigen::Index;

/// row_c = sum_j basis_j coefficient_jc, rows of coefficients one behind the other; the number of columns is
/// known when this is compiled, unless 0.
template <int Columns>
void blend(const std::array<double, 6>& basis, int degree, const double* coefficient, Index given,
           double* row) {
  const Index columns = Columns > 0 ? Columns : given;
  for (Index c = 0; c < columns; ++c) {
    double sum = basis[0] * coefficient[c];
    for (int j = 1; j <= degree; ++j) sum += basis[j] * coefficient[j * columns + c];
    row[c] = sum;
  }
}

void require_finite(const RowMatrix& values) {
  for (Index k = 0; k < values.rows(); ++k)
    if (!values.row(k).allFinite())
      throw InvalidArgument("values[" + std::to_string(k) + "]: not finite, expected numbers.");
}

void require(const Eigen::VectorXd& times, const RowMatrix& values) {
  if (times.size() < 2 || times.size() != values.rows())
    throw InvalidArgument("times: " + std::to_string(times.size()) + " for " + std::to_string(values.rows()) +
                          " rows of values, expected one each and at least 2.");
  for (Index k = 0; k < times.size(); ++k)
    if (!std::isfinite(times[k]) || (k > 0 && !(times[k] > times[k - 1])))
      throw InvalidArgument("times[" + std::to_string(k) +
                            "]: not finite or not after the one before, expected increasing times.");
  require_finite(values);
}

}  // namespace

Spline::Spline(const Eigen::VectorXd& times, const RowMatrix& values) {
  require(times, values);
  const auto ends = detail::end_conditions(times, values);
  *this = {std::make_shared<const detail::Collocation>(times, ends), ends, values};
}

Spline::Spline(std::shared_ptr<const detail::Collocation> grid, const std::array<EndCondition, 2>& ends,
               const RowMatrix& values)
    : grid_(std::move(grid)), knots_(grid_, &grid_->knots()), ends_(ends) {
  coefficients_[0] = detail::with_end_conditions(values, grid_->times(), *knots_, ends);
  grid_->solve(coefficients_[0]);
  differentiate();
}

Spline::Spline(std::shared_ptr<const detail::Knots> knots, RowMatrix coefficients)
    : knots_(std::move(knots)) {
  coefficients_[0] = std::move(coefficients);
  differentiate();
}

Spline detail::spline_of(std::shared_ptr<const Knots> knots, RowMatrix coefficients) {
  return {std::move(knots), std::move(coefficients)};
}

Spline Spline::through(const RowMatrix& values) const {
  if (!grid_)
    throw InvalidArgument(
        "through: a smoothing spline does not go through its samples; make an interpolating one.");
  if (values.rows() != grid_->times().size())
    throw InvalidArgument("values: " + std::to_string(values.rows()) +
                          " rows, expected one for each sample of an interpolating spline.");
  require_finite(values);
  const auto ends = detail::end_conditions(grid_->times(), values);
  if (!grid_->serves(ends)) return {grid_->times(), values};
  return {grid_, ends, values};
}

Spline Spline::smoothing(const Eigen::VectorXd& times, const RowMatrix& values, Smoothing* report) {
  if (report) *report = {Eigen::VectorXd::Zero(values.cols()), Eigen::VectorXd::Zero(values.cols())};
  if (times.size() < 10) return {times, values};
  require(times, values);
  const Eigen::VectorXd weights = detail::measured_weights(
      {}, values.rows(), [&](Index k) { return values.row(k) == values.row(k - 1); });
  detail::SmoothingGrid grid(times, weights);
  detail::SmoothingFit fit(grid, values);
  const detail::SmoothingFit::Point best = fit.best();
  detail::SmoothingFit::Curve curve = fit.curve(best.lambda);
  Spline spline(std::move(curve.knots), std::move(curve.coefficients));
  if (report) {
    const RowMatrix residual = values - spline.sample(times).value;
    const auto squares = residual.array().square().colwise() * weights.array();
    report->removed = (squares.colwise().sum().transpose() / grid.measured()).sqrt();
    report->noise = report->removed * std::sqrt(grid.measured() / (grid.measured() - best.freedom));
  }
  return spline;
}

void Spline::differentiate() {
  const detail::Knots& knots = *knots_;
  for (int d = 1; d <= 2; ++d) {
    const RowMatrix& upper = coefficients_[d - 1];
    const int degree = knots.degree() - d + 1;
    RowMatrix lower = RowMatrix::Zero(std::max<Index>(upper.rows() - 1, 1), upper.cols());
    for (Index i = 0; degree > 0 && i + 1 < upper.rows(); ++i)
      lower.row(i) = degree * knots.inverse_span(degree, i + d) * (upper.row(i + 1) - upper.row(i));
    coefficients_[d] = std::move(lower);
  }
}

template <int Columns>
void Spline::sample(const Eigen::VectorXd& times, const std::array<double*, 3>& out) const {
  const int degree = knots_->degree();
  const Index columns = dimension();
  Index at = degree;
  for (Index k = 0; k < times.size(); ++k) {
    at = knots_->interval(times[k], at);
    const LocalBasis basis(*knots_, at, times[k]);
    for (int d = 0; d <= std::min(2, degree); ++d)
      blend<Columns>(basis.values[d], degree - d, coefficients_[d].row(at - degree).data(), columns,
                     out[d] + k * columns);
  }
}

Spline::Samples Spline::sample(const Eigen::VectorXd& times) const {
  for (Index k = 0; k < times.size(); ++k)
    if (!std::isfinite(times[k])) throw InvalidArgument("times[" + std::to_string(k) + "]: not finite.");
  const Index n = times.size();
  const Index dims = dimension();
  Samples samples{RowMatrix(n, dims), RowMatrix(n, dims), RowMatrix(n, dims)};
  const std::array<double*, 3> out{samples.value.data(), samples.first.data(), samples.second.data()};
  for (int d = knots_->degree() + 1; d <= 2; ++d) std::fill_n(out[d], n * dims, 0.0);
  switch (dims) {
    case 3:
      sample<3>(times, out);
      break;
    case 4:
      sample<4>(times, out);
      break;
    default:
      sample<0>(times, out);
  }
  if (!samples.value.allFinite() || !samples.first.allFinite() || !samples.second.allFinite())
    throw InvalidArgument("times: so far from the samples, or these so large, that the spline overflows.");
  return samples;
}

}  // namespace dmp
