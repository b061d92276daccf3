#include "spline/collocation.hpp"

#include <algorithm>

#include "spline/end_conditions.hpp"
#include "spline/local_basis.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;

std::array<bool, 2> conditioned(const std::array<EndCondition, 2>& ends) {
  return {ends[0] != EndCondition::not_a_knot, ends[1] != EndCondition::not_a_knot};
}

/// A knot at every sample but for the ends; without a condition two more at either end are left out.
Knots knots_at(const Eigen::VectorXd& times, int degree, const std::array<bool, 2>& conditioned) {
  const Index n = times.size();
  const Index skipped = (degree + 1) / 2;
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, times[0]);
  if (n > degree + 1)
    for (Index i = conditioned[0] ? 1 : skipped; i < n - (conditioned[1] ? 1 : skipped); ++i)
      knots.push_back(times[i]);
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, times[n - 1]);
  return {std::move(knots), degree};
}

}  // namespace

Collocation::Collocation(const Eigen::VectorXd& times, const std::array<EndCondition, 2>& ends)
    : times_(times),
      conditioned_(conditioned(ends)),
      knots_(knots_at(times, static_cast<int>(std::min<Index>(kDegree, times.size() - 1)), conditioned_)),
      band_(static_cast<std::size_t>(knots_.count() * kWidth), 0.0) {
  extent_.reserve(static_cast<std::size_t>(knots_.count()));
  fill();
  factorise();
}

bool Collocation::serves(const std::array<EndCondition, 2>& ends) const noexcept {
  return conditioned(ends) == conditioned_;
}

/// The conditions stand next to the outermost samples, so that the matrix stays a band.
void Collocation::fill() {
  const Index last = times_.size() - 1;
  add_sample(times_[0]);
  if (conditioned_[0])
    for (const int order : {3, 4}) add_condition(order, true);
  for (Index i = 1; i < last; ++i) add_sample(times_[i]);
  if (conditioned_[1])
    for (const int order : {4, 3}) add_condition(order, false);
  add_sample(times_[last]);
}

void Collocation::add_sample(double time) {
  const int degree = knots_.degree();
  const Index row = static_cast<Index>(extent_.size());
  const Index at = knots_.interval(time, row + (degree + 1) / 2);
  const LocalBasis basis(knots_, at, time);
  int first = degree;
  int last = 0;
  for (int j = 0; j <= degree; ++j) {
    if (basis.values[0][j] == 0.0) continue;
    first = std::min(first, j);
    last = std::max(last, j);
    element(row, at - degree + j) = basis.values[0][j];
  }
  extent_.push_back({static_cast<int>(at) - degree + first, static_cast<int>(at) - degree + last});
}

void Collocation::add_condition(int order, bool at_begin) {
  const EndDerivative derivative(knots_, order, at_begin);
  const Index row = static_cast<Index>(extent_.size());
  for (int j = 0; j <= order; ++j)
    element(row, derivative.first + j) = derivative.weights[static_cast<std::size_t>(j)];
  extent_.push_back({static_cast<int>(derivative.first), static_cast<int>(derivative.first) + order});
}

/// Elimination without pivoting, which is stable for a B-spline collocation matrix (totally positive: de Boor
/// and Pinkus 1977). Most samples are knots, where only five B-splines are not zero: the extent of each row
/// saves the rest.
void Collocation::factorise() {
  const Index n = static_cast<Index>(extent_.size());
  for (Index i = 0; i < n; ++i) {
    Extent& pivot = extent_[static_cast<std::size_t>(i)];
    element(i, i) = 1.0 / element(i, i);
    for (Index r = i + 1; r <= std::min<Index>(i + kDegree, n - 1); ++r) {
      Extent& below = extent_[static_cast<std::size_t>(r)];
      if (below.first > i) continue;
      const double factor = element(r, i) *= element(i, i);
      for (Index c = i + 1; c <= pivot.last; ++c) element(r, c) -= factor * element(i, c);
      below.last = std::max(below.last, pivot.last);
    }
  }
}

template <int Columns>
void Collocation::substitute(double* values, Index given) const noexcept {
  const Index columns = Columns > 0 ? Columns : given;
  const Index n = static_cast<Index>(extent_.size());
  const auto subtract = [columns](double factor, const double* from, double* row) {
    for (Index c = 0; c < columns; ++c) row[c] -= factor * from[c];
  };
  const auto row_of = [this](Index i) { return band_.data() + i * (kWidth - 1) + kDegree; };  // [column]
  for (Index i = 1; i < n; ++i)
    for (Index c = extent_[static_cast<std::size_t>(i)].first; c < i; ++c)
      subtract(row_of(i)[c], values + c * columns, values + i * columns);
  for (Index i = n - 1; i >= 0; --i) {
    double* const row = values + i * columns;
    for (Index c = extent_[static_cast<std::size_t>(i)].last; c > i; --c)
      subtract(row_of(i)[c], values + c * columns, row);
    for (Index c = 0; c < columns; ++c) row[c] *= row_of(i)[i];
  }
}

void Collocation::solve(RowMatrix& values) const {
  switch (values.cols()) {
    case 3:
      return substitute<3>(values.data(), 3);
    case 4:
      return substitute<4>(values.data(), 4);
    default:
      return substitute<0>(values.data(), values.cols());
  }
}

}  // namespace dmp::detail
