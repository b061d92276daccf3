#include "spline/end_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr Index kFewest = 12;  // samples; with fewer, those of both ends would be the same
constexpr Index kNear = 9;     // samples that three differences of sixth order need

/// The divided difference of `order` of the samples first, first + step, .. (step 1 or -1), times order!.
RowVectorXd divided_difference(const VectorXd& times, const RowMatrix& values, Index first, Index step,
                               int order) {
  RowMatrix table(order + 1, values.cols());
  for (Index k = 0; k <= order; ++k) table.row(k) = values.row(first + step * k);
  for (int m = 1; m <= order; ++m)
    for (Index k = 0; k <= order - m; ++k)
      table.row(k) =
          m * (table.row(k + 1) - table.row(k)) / (times[first + step * (k + m)] - times[first + step * k]);
  return table.row(0);
}

/// The RMS of the three differences of `order` nearest to an end, in the unit of the values.
double roughness(const VectorXd& times, const RowMatrix& values, bool at_begin, int order) {
  const Index end = at_begin ? 0 : times.size() - 1;
  const Index step = at_begin ? 1 : -1;
  const double mean_step = std::abs(times[end + step * (kNear - 1)] - times[end]) / (kNear - 1);
  double squares = 0.0;
  for (Index k = 0; k < 3; ++k)
    squares += divided_difference(times, values, end + step * k, step, order).squaredNorm();
  return std::sqrt(squares / 3.0) * std::pow(mean_step, order);
}

EndCondition condition_at(const VectorXd& times, const RowMatrix& values, bool at_begin) {
  const double third = roughness(times, values, at_begin, 3);
  const double fourth = roughness(times, values, at_begin, 4);
  const double sixth = roughness(times, values, at_begin, 6);
  // Differences of exact samples carry their rounding, 2^order times as large.
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
  if (sixth <= std::max(std::min(third, fourth), rounding)) return EndCondition::not_a_knot;
  return fourth <= third ? EndCondition::third_difference : EndCondition::natural;
}

}  // namespace

std::array<EndCondition, 2> end_conditions(const VectorXd& times, const RowMatrix& values) {
  if (times.size() < kFewest) return {EndCondition::not_a_knot, EndCondition::not_a_knot};
  return {condition_at(times, values, true), condition_at(times, values, false)};
}

/// At a clamped end a derivative is the outermost coefficient of the spline that is the derivative (de Boor
/// 1978, chapter X): differences of the coefficients, over and over.
EndDerivative::EndDerivative(const Knots& knots, int order, bool at_begin)
    : first(at_begin ? 0 : knots.count() - 1 - order) {
  for (int c = 0; c <= order; ++c) {
    std::array<double, 6> unit{};
    unit[static_cast<std::size_t>(c)] = 1.0;
    for (int d = 1; d <= order; ++d) {
      const int degree = knots.degree() - d + 1;
      for (int i = 0; i <= order - d; ++i) {
        const auto k = static_cast<std::size_t>(i);
        unit[k] = degree * knots.inverse_span(degree, first + i + d) * (unit[k + 1] - unit[k]);
      }
    }
    weights[static_cast<std::size_t>(c)] = unit[0];
  }
  double largest = 0.0;
  for (const double weight : weights) largest = std::max(largest, std::abs(weight));
  scale = 1.0 / largest;
  for (double& weight : weights) weight *= scale;
}

RowMatrix with_end_conditions(const RowMatrix& values, const VectorXd& times, const Knots& knots,
                              const std::array<EndCondition, 2>& ends) {
  if (ends[0] == EndCondition::not_a_knot && ends[1] == EndCondition::not_a_knot) return values;
  const Index n = values.rows();
  const Index before = ends[0] == EndCondition::not_a_knot ? 0 : 2;
  const Index after = ends[1] == EndCondition::not_a_knot ? 0 : 2;
  RowMatrix all = RowMatrix::Zero(n + before + after, values.cols());
  all.row(0) = values.row(0);
  all.middleRows(1 + before, n - 2) = values.middleRows(1, n - 2);
  all.row(all.rows() - 1) = values.row(n - 1);
  if (ends[0] == EndCondition::third_difference)
    all.row(1) = EndDerivative(knots, 3, true).scale * divided_difference(times, values, 0, 1, 3);
  if (ends[1] == EndCondition::third_difference)
    all.row(all.rows() - 2) =
        EndDerivative(knots, 3, false).scale * divided_difference(times, values, n - 1, -1, 3);
  return all;
}

}  // namespace dmp::detail
