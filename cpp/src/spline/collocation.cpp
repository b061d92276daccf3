#include "spline/collocation.hpp"

#include <algorithm>

#include "spline/local_basis.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;

Knots not_a_knot(const Eigen::VectorXd& times, int degree) {
  const Index n = times.size();
  const Index skipped = (degree + 1) / 2;  // samples at either end that are no knots
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, times[0]);
  if (n > degree + 1)
    for (Index i = skipped; i < n - skipped; ++i) knots.push_back(times[i]);
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, times[n - 1]);
  return {std::move(knots), degree};
}

}  // namespace

Collocation::Collocation(const Eigen::VectorXd& times)
    : knots_(not_a_knot(times, static_cast<int>(std::min<Index>(kDegree, times.size() - 1)))),
      band_(static_cast<std::size_t>(times.size() * kWidth), 0.0) {
  extent_.reserve(static_cast<std::size_t>(times.size()));
  fill(times);
  factorise();
}

void Collocation::fill(const Eigen::VectorXd& times) {
  const int degree = knots_.degree();
  Index at = degree;
  for (Index i = 0; i < times.size(); ++i) {
    at = knots_.interval(times[i], at);
    const LocalBasis basis(knots_, at, times[i]);
    int first = degree;
    int last = 0;
    for (int j = 0; j <= degree; ++j) {
      if (basis.values[0][j] == 0.0) continue;
      first = std::min(first, j);
      last = std::max(last, j);
      element(i, at - degree + j) = basis.values[0][j];
    }
    extent_.push_back({static_cast<int>(at) - degree + first, static_cast<int>(at) - degree + last});
  }
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
