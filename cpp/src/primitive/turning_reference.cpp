#include "primitive/turning_reference.hpp"

#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "spline/local_basis.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr int kDegree = 5;
constexpr int kMostSpans = 200;
constexpr double kShortest = 0.5;  // |c|
constexpr double kFarthest = 2.0;  // rad

std::shared_ptr<const Knots> even_knots(int spans) {
  std::vector<double> knots(kDegree + 1, 0.0);
  for (int i = 1; i < spans; ++i) knots.push_back(static_cast<double>(i) / spans);
  knots.insert(knots.end(), kDegree + 1, 1.0);
  return std::make_shared<const Knots>(std::move(knots), kDegree);
}

Quaterniond quaternion(const Vector4d& wxyz) { return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]}; }

/// With the ends repeated: standing still there.
RowMatrix all_of(const RowMatrix& distinct) {
  const Index n = distinct.rows();
  RowMatrix all(n + 4, 4);
  all.topRows<2>().rowwise() = distinct.row(0);
  all.middleRows(2, n) = distinct;
  all.bottomRows<2>().rowwise() = distinct.row(n - 1);
  return all;
}

RowMatrix derivative(const RowMatrix& upper, const Knots& knots, int order) {
  RowMatrix lower(upper.rows() - 1, 4);
  const int degree = kDegree - order + 1;
  for (Index i = 0; i < lower.rows(); ++i)
    lower.row(i) = degree * knots.inverse_span(degree, i + order) * (upper.row(i + 1) - upper.row(i));
  return lower;
}

/// Least squares over the phase for the coefficients between the ends, which are given.
RowMatrix least_squares(int spans, const std::vector<VectorXd>& phases,
                        const std::vector<RowMatrix>& quaternions, const Vector4d& first,
                        const Vector4d& last) {
  const std::shared_ptr<const Knots> knots = even_knots(spans);
  const Index count = knots->count();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
  RowMatrix right = RowMatrix::Zero(count, 4);
  for (std::size_t j = 0; j < phases.size(); ++j) {
    Index at = kDegree;
    for (Index k = 0; k < phases[j].size(); ++k) {
      at = knots->interval(phases[j][k], at);
      const auto basis = LocalBasis(*knots, at, phases[j][k]).values[0];
      const double share = 1.0 / static_cast<double>(phases[j].size());
      for (Index a = 0; a <= kDegree; ++a) {
        const double weight = share * basis[static_cast<std::size_t>(a)];
        right.row(at - kDegree + a) += weight * quaternions[j].row(k);
        for (Index b = 0; b <= kDegree; ++b)
          gram(at - kDegree + a, at - kDegree + b) += weight * basis[static_cast<std::size_t>(b)];
      }
    }
  }
  const Index free = count - 6;
  RowMatrix fixed(6, 4);
  fixed.topRows<3>().rowwise() = first.transpose();
  fixed.bottomRows<3>().rowwise() = last.transpose();
  const RowMatrix known = gram.block(3, 0, free, 3) * fixed.topRows<3>() +
                          gram.block(3, count - 3, free, 3) * fixed.bottomRows<3>();
  Eigen::MatrixXd inner = gram.block(3, 3, free, free);
  inner.diagonal().array() += 1e-9 * inner.diagonal().mean();  // few samples leave spans without any
  RowMatrix distinct(free + 2, 4);
  distinct.row(0) = first.transpose();
  distinct.middleRows(1, free) = inner.ldlt().solve(right.middleRows(3, free) - known);
  distinct.row(free + 1) = last.transpose();
  return distinct;
}

void require_round(const RowMatrix& reference) {
  const double turns = reference.row(1).tail<3>().norm();
  if (std::abs(reference.row(0).norm() - 1.0) > 1e-6 || reference(1, 0) != 0.0 ||
      std::abs(turns - std::round(turns)) > 1e-9)
    throw InvalidArgument(
        "reference: of a rhythmic motion expected a quaternion of length 1, then 0 and whole turns a cycle.");
}

/// The rotations without the even turning, Exp(-2 pi s t) R.
Rotations unwound(const Rotations& cycle, const Vector3d& turns) {
  Rotations left;
  const double step = 2.0 * M_PI / static_cast<double>(cycle.size());
  for (std::size_t k = 0; k < cycle.size(); ++k)
    left.push_back(so3::exp(-step * static_cast<double>(k) * turns) * cycle[k]);
  return left;
}

/// The rotation with which the mean of Log(R M^T) is 0.
Eigen::Matrix3d middle_of(const Rotations& rotations) {
  Eigen::Matrix3d middle = so3::mean_rotation(rotations);
  for (int i = 0; i < 100; ++i) {
    Vector3d mean = Vector3d::Zero();
    for (const Eigen::Matrix3d& one : rotations) mean += so3::log(Eigen::Matrix3d(one * middle.transpose()));
    mean /= static_cast<double>(rotations.size());
    middle = so3::exp(mean) * middle;
    if (mean.norm() < 1e-14) break;
  }
  return middle;
}

/// The largest |p| along a cycle on the branch that is followed; beyond all where it does not close.
double farthest(const Rotations& cycle, const Vector3d& turns) {
  const Rotations left = unwound(cycle, turns);
  const Eigen::Matrix3d back = middle_of(left).transpose();
  Vector3d first = Vector3d::Zero(), p = Vector3d::Zero();
  double most = 0.0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    p = so3::lifted_log(Quaterniond(Eigen::Matrix3d(left[k] * back)), p);
    if (k == 0) first = p;
    most = std::max(most, p.norm());
  }
  p = so3::lifted_log(Quaterniond(Eigen::Matrix3d(left[0] * back)), p);
  return (p - first).norm() < 1.0 ? most : 1e9;
}

}  // namespace

TurningReference TurningReference::round(const Rotations& cycle) {
  Vector3d whole = Vector3d::Zero();
  for (std::size_t k = 0; k < cycle.size(); ++k)
    whole += so3::log(Eigen::Matrix3d(cycle[(k + 1) % cycle.size()] * cycle[k].transpose()));
  const double count = std::round(whole.norm() / (2.0 * M_PI));
  Vector3d turns = Vector3d::Zero();
  if (count > 0.0 && farthest(cycle, count * whole.normalized()) < farthest(cycle, turns))
    turns = count * whole.normalized();
  const Quaterniond middle(middle_of(unwound(cycle, turns)));
  RowMatrix rows(2, 4);
  rows << middle.w(), middle.x(), middle.y(), middle.z(), 0.0, turns.transpose();
  return TurningReference(rows);
}

TurningReference::State TurningReference::round_at(double s) const noexcept {
  const Vector3d velocity = 2.0 * M_PI * distinct_.row(1).tail<3>().transpose();
  const double within =
      s - 2.0 * std::floor(0.5 * s);  // of two cycles, after which the quaternion is the same
  const Quaterniond middle = quaternion(distinct_.row(0).transpose()).normalized();
  return {so3::exp_quaternion(within * velocity) * middle, velocity, Vector3d::Zero()};
}

TurningReference::TurningReference(const RowMatrix& coefficients) : distinct_(coefficients) {
  const Index spans = coefficients.rows() - 1;
  if (coefficients.rows() == 2 && coefficients.cols() == 4 && coefficients.allFinite()) {
    require_round(distinct_);
    return;
  }
  if (coefficients.cols() != 4 || spans < 2 || spans > kMostSpans || !coefficients.allFinite())
    throw InvalidArgument("reference: " + std::to_string(coefficients.rows()) + " x " +
                          std::to_string(coefficients.cols()) +
                          ", expected 3 to 201 rows of 4 finite numbers.");
  for (const Index end : {Index{0}, spans})
    if (std::abs(coefficients.row(end).norm() - 1.0) > 1e-6)
      throw InvalidArgument(indexed("reference", end) + ": of length " +
                            number(coefficients.row(end).norm()) + ", expected 1.");
  knots_ = even_knots(static_cast<int>(spans));
  coefficients_[0] = all_of(coefficients);
  for (int order = 1; order <= 2; ++order)
    coefficients_[static_cast<std::size_t>(order)] =
        derivative(coefficients_[static_cast<std::size_t>(order - 1)], *knots_, order);
  for (Index k = 0; k <= 8 * spans; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(8 * spans);
    if (!(value(s).norm() >= kShortest))
      throw InvalidArgument("reference: comes nearer to 0 than 0.5 at phase " + number(s) +
                            ", where it says no rotation.");
  }
}

Vector4d TurningReference::value(double s) const noexcept {
  const Index at = knots_->interval(s);
  const LocalBasis basis(*knots_, at, s);
  Vector4d c = Vector4d::Zero();
  for (int j = 0; j <= kDegree; ++j)
    c += basis.values[0][static_cast<std::size_t>(j)] * coefficients_[0].row(at - kDegree + j).transpose();
  return c;
}

TurningReference::State TurningReference::at(double s) const noexcept {
  if (goes_round()) return round_at(s);
  if (!(s > 0.0 && s < 1.0)) {
    const Vector4d end = distinct_.row(s > 0.0 ? distinct_.rows() - 1 : 0).transpose();
    return {quaternion(end).normalized(), Vector3d::Zero(), Vector3d::Zero()};
  }
  const Index spans = distinct_.rows() - 1;
  const Index at = knots_->interval(s, kDegree + static_cast<Index>(s * static_cast<double>(spans)));
  const LocalBasis basis(*knots_, at, s);
  std::array<Vector4d, 3> c;
  for (int d = 0; d <= 2; ++d) {
    Vector4d& sum = c[static_cast<std::size_t>(d)];
    sum.setZero();
    for (int j = 0; j <= kDegree - d; ++j)
      sum += basis.values[static_cast<std::size_t>(d)][static_cast<std::size_t>(j)] *
             coefficients_[static_cast<std::size_t>(d)].row(at - kDegree + j).transpose();
  }
  const double squared = c[0].squaredNorm();
  const Quaterniond back = quaternion(c[0]).conjugate();
  const Vector3d velocity = 2.0 / squared * (quaternion(c[1]) * back).vec();
  const Vector3d acceleration = 2.0 / squared * ((quaternion(c[2]) * back).vec() - c[0].dot(c[1]) * velocity);
  return {Quaterniond(quaternion(c[0]).coeffs() / std::sqrt(squared)), velocity, acceleration};
}

std::optional<TurningReference> TurningReference::along(const std::vector<VectorXd>& phases,
                                                        const std::vector<RowMatrix>& quaternions) {
  Vector4d first = Vector4d::Zero();
  Vector4d last = Vector4d::Zero();
  for (const RowMatrix& table : quaternions) {
    first += table.row(0).transpose();
    last += table.row(table.rows() - 1).transpose();
  }
  if (first.norm() < kShortest || last.norm() < kShortest) return {};
  first.normalize();
  last.normalize();
  for (int spans = 2; spans <= kMostSpans; spans = std::max(spans + 1, spans * 6 / 5)) {
    const RowMatrix distinct = least_squares(spans, phases, quaternions, first, last);
    if (!distinct.allFinite()) continue;
    try {
      TurningReference reference(distinct);
      bool near = true;
      for (std::size_t j = 0; near && j < phases.size(); ++j)
        for (Index k = 0; near && k < phases[j].size(); ++k) {
          const Vector4d q = quaternions[j].row(k).transpose();
          const double cosine = std::abs(reference.value(phases[j][k]).normalized().dot(q));
          near = 2.0 * std::acos(std::min(cosine, 1.0)) <= kFarthest;
        }
      if (near) return reference;
    } catch (const InvalidArgument&) {  // too near to 0
    }
  }
  return {};
}

}  // namespace dmp::detail
