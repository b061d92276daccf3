#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// A symmetric band matrix of half width 5: element (i, k) is that of row i + k and column i.
using Band = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// c^T A c, summed over the columns of c.
double quadratic_form(const Band& a, const RowMatrix& c);

/// A = L D L^T of a symmetric band matrix, and what smoothing needs of it.
class BandCholesky {
 public:
  /// The elements of the last rows of `a` that lie beyond it are 0.
  explicit BandCholesky(const Band& a);

  bool positive() const noexcept { return positive_; }
  /// The solution of A x = b, columns at once.
  RowMatrix solve(const RowMatrix& b) const;
  /// trace(A^-1 M) for a band matrix M: only the band of the inverse is needed (Hutchinson and de Hoog 1985,
  /// Numerische Mathematik 47).
  double trace_of_inverse_times(const Band& m) const;

 private:
  Band l_;  // column 0: 1 / D
  Eigen::Index rows_;
  bool positive_ = true;
};

}  // namespace dmp::detail
