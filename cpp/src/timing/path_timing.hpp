#pragma once

#include <Eigen/Core>
#include <vector>

namespace dmp::detail {

/// The fastest way along a path, of which only the speed is free (Pham and Pham, "A new approach to
/// time-optimal path parameterization based on reachability analysis", IEEE Trans. Robotics 34(3), 2018).
///
/// With the path parameter u, x = (du/dt)^2 and w = d2u/dt2, every limit at a knot is a row
/// lower <= a w + b x <= upper. Backwards from rest at the end goes the largest x from which that rest can
/// still be reached, forwards from rest at the start the largest w that stays below it.
class PathTiming {
 public:
  /// Knots at u, strictly increasing; x at knot k is at most `largest[k]`.
  PathTiming(const Eigen::VectorXd& u, const Eigen::VectorXd& largest);

  /// Goes on to the next knot, the first at first: limit() adds to it.
  void next_knot() { first_.push_back(rows_.size()); }
  /// Adds the row lower <= a w + b x <= upper; lower <= 0 <= upper.
  void limit(double a, double b, double lower, double upper);
  /// (T) the largest x at every knot, 0 at both ends, with row bounds and largest x multiplied by scale[k].
  /// Every knot must have its rows.
  Eigen::VectorXd fastest(const Eigen::VectorXd& scale) const;

 private:
  /// One row, solved for w: lower - slope x <= w <= upper - slope x.
  struct Row {
    double slope, lower, upper;
  };
  struct Bound {
    double value, slope;
  };
  /// The lowest and the highest w that the rows of knot k allow at x.
  struct Range {
    Bound low, high;
  };
  Range range(Eigen::Index k, double x, double scale) const;
  double controllable(Eigen::Index k, double next, double scale) const;

  const Eigen::VectorXd& u_;
  Eigen::VectorXd largest_;
  std::vector<Row> rows_;           ///< of all knots, one after the other
  std::vector<std::size_t> first_;  ///< row of each knot
};

}  // namespace dmp::detail
