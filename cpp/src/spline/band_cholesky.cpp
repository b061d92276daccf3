#include "spline/band_cholesky.hpp"

#include <algorithm>
#include <type_traits>

namespace dmp::detail {
namespace {

using Eigen::Index;

constexpr Index kWidth = 6;
constexpr Index kBelow = kWidth - 1;

/// Calls work(n) with the number of columns known when this is compiled, for those of positions and
/// quaternions.
template <class Work>
void for_columns(Index columns, Work work) {
  if (columns == 3) return work(std::integral_constant<Index, 3>{});
  if (columns == 4) return work(std::integral_constant<Index, 4>{});
  work(columns);
}

template <class Columns>
void subtract(double factor, const double* from, double* to, Columns columns) {
  for (Index c = 0; c < columns; ++c) to[c] -= factor * from[c];
}

}  // namespace

double quadratic_form(const Band& a, const RowMatrix& c) {
  double sum = 0.0;
  for_columns(c.cols(), [&](auto columns) {
    for (Index i = 0; i < a.rows(); ++i) {
      const double* const row = c.row(i).data();
      const Index last = std::min(kBelow, a.rows() - 1 - i);
      for (Index d = 0; d < columns; ++d) {
        double along = 0.0;
        for (Index k = 1; k <= last; ++k) along += a(i, k) * row[k * columns + d];
        sum += row[d] * (a(i, 0) * row[d] + 2.0 * along);
      }
    }
  });
  return sum;
}

// Five rows of zeros follow the last one, so that no loop ends early.

BandCholesky::BandCholesky(const Band& a) : l_(a.rows() + kBelow, kWidth), rows_(a.rows()) {
  l_.topRows(rows_) = a;
  l_.bottomRows(kBelow).setZero();
  for (Index j = 0; j < rows_; ++j) {
    double* const row = l_.data() + j * kWidth;
    positive_ = positive_ && row[0] > 0.0;
    const double inverse = 1.0 / row[0];
    for (Index k = 1; k < kWidth; ++k) {
      const double factor = row[k] * inverse;
      for (Index i = k; i < kWidth; ++i) row[k * kWidth + i - k] -= factor * row[i];
    }
    row[0] = inverse;
    for (Index k = 1; k < kWidth; ++k) row[k] *= inverse;
  }
}

RowMatrix BandCholesky::solve(const RowMatrix& b) const {
  RowMatrix x(rows_ + kBelow, b.cols());
  x.topRows(rows_) = b;
  x.bottomRows(kBelow).setZero();
  for_columns(b.cols(), [&](auto columns) {
    for (Index j = 0; j < rows_; ++j) {
      double* const row = x.data() + j * columns;
      for (Index k = 1; k < kWidth; ++k) subtract(l_(j, k), row, row + k * columns, columns);
    }
    x.bottomRows(kBelow).setZero();
    for (Index j = rows_ - 1; j >= 0; --j) {
      double* const row = x.data() + j * columns;
      for (Index c = 0; c < columns; ++c) row[c] *= l_(j, 0);
      for (Index k = 1; k < kWidth; ++k) subtract(l_(j, k), row + k * columns, row, columns);
    }
  });
  return x.topRows(rows_);
}

double BandCholesky::trace_of_inverse_times(const Band& m) const {
  Band z = Band::Zero(rows_ + kBelow, kWidth);  // the band of the inverse
  double trace = 0.0;
  for (Index j = rows_ - 1; j >= 0; --j) {
    double* const row = z.data() + j * kWidth;
    const double* const l = l_.data() + j * kWidth;
    for (Index i = 1; i < kWidth; ++i)
      for (Index k = 1; k < kWidth; ++k) {
        const Index low = std::min(i, k);
        row[i] -= l[k] * row[low * kWidth + std::max(i, k) - low];
      }
    row[0] = l[0];
    for (Index k = 1; k < kWidth; ++k) row[0] -= l[k] * row[k];
    const double* const of_m = m.data() + j * kWidth;
    double along = 0.0;
    for (Index i = 1; i < kWidth; ++i) along += row[i] * of_m[i];
    trace += row[0] * of_m[0] + 2.0 * along;
  }
  return trace;
}

}  // namespace dmp::detail
