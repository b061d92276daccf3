#include "joint_spline.hpp"

#include <vector>

namespace dmp::detail {
namespace {

// Second derivatives at the inner knots of four or more: one tridiagonal system, all joints at once. The
// not-a-knot ends, (M1 - M0) / h0 = (M2 - M1) / h1 and its mirror image, are substituted into the first and
// the last row.
RowMatrix inner_curvatures(const Eigen::VectorXd& h, const RowMatrix& slope) {
  const Eigen::Index rows = h.size() - 1;
  Eigen::VectorXd below(rows), diagonal(rows), above(rows);
  RowMatrix curvature(rows, slope.cols());
  for (Eigen::Index i = 0; i < rows; ++i) {
    below[i] = h[i];
    diagonal[i] = 2.0 * (h[i] + h[i + 1]);
    above[i] = h[i + 1];
    curvature.row(i) = 6.0 * (slope.row(i + 1) - slope.row(i));
  }
  const double first = h[0] / h[1], last = h[rows] / h[rows - 1];
  diagonal[0] += h[0] * (1.0 + first);
  above[0] -= h[0] * first;
  diagonal[rows - 1] += h[rows] * (1.0 + last);
  below[rows - 1] -= h[rows] * last;
  for (Eigen::Index i = 1; i < rows; ++i) {
    const double factor = below[i] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    curvature.row(i) -= factor * curvature.row(i - 1);
  }
  curvature.row(rows - 1) /= diagonal[rows - 1];
  for (Eigen::Index i = rows - 2; i >= 0; --i)
    curvature.row(i) = (curvature.row(i) - above[i] * curvature.row(i + 1)) / diagonal[i];
  return curvature;
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

}  // namespace

void differentiate(JointTrajectory& joints) {
  const Eigen::Index count = joints.position.rows(), n = joints.position.cols();
  joints.velocity.setZero(count, n);
  joints.acceleration.setZero(count, n);
  if (count < 2) return;
  const Eigen::VectorXd h = joints.time.tail(count - 1) - joints.time.head(count - 1);
  const RowMatrix slope = h.cwiseInverse().asDiagonal() *
                          (joints.position.bottomRows(count - 1) - joints.position.topRows(count - 1));
  joints.acceleration = curvatures(h, slope);
  const RowMatrix& m = joints.acceleration;
  for (Eigen::Index i = 0; i + 1 < count; ++i)
    joints.velocity.row(i) = slope.row(i) - h[i] / 6.0 * (2.0 * m.row(i) + m.row(i + 1));
  joints.velocity.row(count - 1) =
      slope.row(count - 2) + h[count - 2] / 6.0 * (2.0 * m.row(count - 1) + m.row(count - 2));
}

}  // namespace dmp::detail
