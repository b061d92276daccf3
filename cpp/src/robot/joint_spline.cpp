#include "robot/joint_spline.hpp"

#include <utility>

namespace dmp::detail {
namespace {

// One tridiagonal system for the second derivatives M of all joints at once.
struct System {
  Eigen::VectorXd below, diagonal, above;  // below[0] and the last of above play no part
  RowMatrix right;

  System(Eigen::Index rows, Eigen::Index columns)
      : below(rows), diagonal(rows), above(rows), right(rows, columns) {}

  // At every inner knot the velocity goes on without a jump; the first of them takes row `first`.
  void join(const Eigen::VectorXd& h, const RowMatrix& slope, Eigen::Index first) {
    for (Eigen::Index i = 0; i + 1 < h.size(); ++i) {
      below[first + i] = h[i];
      diagonal[first + i] = 2.0 * (h[i] + h[i + 1]);
      above[first + i] = h[i + 1];
      right.row(first + i) = 6.0 * (slope.row(i + 1) - slope.row(i));
    }
  }

  RowMatrix solve() {
    const Eigen::Index last = diagonal.size() - 1;
    for (Eigen::Index i = 1; i <= last; ++i) {
      const double factor = below[i] / diagonal[i - 1];
      diagonal[i] -= factor * above[i - 1];
      right.row(i) -= factor * right.row(i - 1);
    }
    right.row(last) /= diagonal[last];
    for (Eigen::Index i = last - 1; i >= 0; --i)
      right.row(i) = (right.row(i) - above[i] * right.row(i + 1)) / diagonal[i];
    return std::move(right);
  }
};

// At the inner knots of four or more. The not-a-knot ends, (M1 - M0) / h0 = (M2 - M1) / h1 and its mirror
// image, are substituted into the first and the last row.
RowMatrix inner_curvatures(const Eigen::VectorXd& h, const RowMatrix& slope) {
  const Eigen::Index rows = h.size() - 1;
  System system(rows, slope.cols());
  system.join(h, slope, 0);
  const double first = h[0] / h[1], last = h[rows] / h[rows - 1];
  system.diagonal[0] += h[0] * (1.0 + first);
  system.above[0] -= h[0] * first;
  system.diagonal[rows - 1] += h[rows] * (1.0 + last);
  system.below[rows - 1] -= h[rows] * last;
  return system.solve();
}

RowMatrix curvatures(const Eigen::VectorXd& h, const RowMatrix& slope) {
  const Eigen::Index count = h.size() + 1;
  if (count == 2) return RowMatrix::Zero(2, slope.cols());
  if (count == 3) {
    const Eigen::RowVectorXd constant = 2.0 * (slope.row(1) - slope.row(0)) / (h[0] + h[1]);
    return constant.replicate(3, 1);
  }
  RowMatrix all(count, slope.cols());
  all.middleRows(1, count - 2) = inner_curvatures(h, slope);
  const auto beyond = [&](Eigen::Index end, Eigen::Index one, Eigen::Index two, double ratio) {
    all.row(end) = all.row(one) + ratio * (all.row(one) - all.row(two));
  };
  beyond(0, 1, 2, h[0] / h[1]);
  beyond(count - 1, count - 2, count - 3, h[count - 2] / h[count - 3]);
  return all;
}

// With velocity zero at both ends: 2 M0 + M1 = 6 slope0 / h0 and its mirror image.
RowMatrix curvatures_at_rest(const Eigen::VectorXd& h, const RowMatrix& slope) {
  const Eigen::Index last = h.size();
  System system(last + 1, slope.cols());
  system.join(h, slope, 1);
  system.diagonal[0] = 2.0 * h[0];
  system.above[0] = h[0];
  system.right.row(0) = 6.0 * slope.row(0);
  system.below[last] = h[last - 1];
  system.diagonal[last] = 2.0 * h[last - 1];
  system.right.row(last) = -6.0 * slope.row(last - 1);
  return system.solve();
}

}  // namespace

void differentiate(JointTrajectory& joints, SplineEnds ends) {
  const bool at_rest = ends == SplineEnds::at_rest;
  const Eigen::Index count = joints.position.rows(), n = joints.position.cols();
  joints.velocity.setZero(count, n);
  joints.acceleration.setZero(count, n);
  if (count < 2) return;
  const Eigen::VectorXd h = joints.time.tail(count - 1) - joints.time.head(count - 1);
  const RowMatrix slope = h.cwiseInverse().asDiagonal() *
                          (joints.position.bottomRows(count - 1) - joints.position.topRows(count - 1));
  joints.acceleration = at_rest ? curvatures_at_rest(h, slope) : curvatures(h, slope);
  const RowMatrix& m = joints.acceleration;
  for (Eigen::Index i = 0; i + 1 < count; ++i)
    joints.velocity.row(i) = slope.row(i) - h[i] / 6.0 * (2.0 * m.row(i) + m.row(i + 1));
  joints.velocity.row(count - 1) =
      slope.row(count - 2) + h[count - 2] / 6.0 * (2.0 * m.row(count - 1) + m.row(count - 2));
  if (!at_rest) return;
  joints.velocity.row(0).setZero();  // exactly, not to rounding
  joints.velocity.row(count - 1).setZero();
}

}  // namespace dmp::detail
