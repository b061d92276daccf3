#include "primitive/control_points.hpp"

#include <algorithm>
#include <vector>

#include "spline/local_basis.hpp"

namespace dmp::detail {

using Eigen::Index;

namespace {

constexpr int kDegree = 3;

std::vector<double> clamped_knots(Index count) {
  std::vector<double> at(static_cast<std::size_t>(count + kDegree + 1), 0.0);
  const Index spans = count - kDegree;
  for (Index i = 0; i <= spans; ++i)
    at[static_cast<std::size_t>(kDegree + i)] = static_cast<double>(i) / static_cast<double>(spans);
  std::fill(at.end() - kDegree, at.end(), 1.0);
  return at;
}

/// From the splines of one degree less to the derivative of these (de Boor 1978, chapter X).
std::array<double, 4> raised(const std::array<double, 4>& lower, int degree, const Knots& knots,
                             Index interval) {
  std::array<double, 4> higher{};
  for (int r = 0; r < degree; ++r) {
    const double term =
        degree * lower[static_cast<std::size_t>(r)] * knots.inverse_span(degree, interval + 1 - degree + r);
    higher[static_cast<std::size_t>(r)] -= term;
    higher[static_cast<std::size_t>(r + 1)] += term;
  }
  return higher;
}

}  // namespace

ControlPoints::ControlPoints(Index count) : knots_(clamped_knots(count), kDegree) {}

SplineRow ControlPoints::at(double phase, int derivative) const noexcept {
  const double s = std::clamp(phase, 0.0, 1.0);
  const Index interval = knots_.interval(s);
  const LocalBasis basis(knots_, interval, s);
  const auto& lower = basis.values[static_cast<std::size_t>(derivative)];
  SplineRow row{interval - kDegree, {}};
  std::copy_n(lower.begin(), kDegree + 1 - derivative, row.value.begin());
  for (int degree = kDegree + 1 - derivative; degree <= kDegree; ++degree)
    row.value = raised(row.value, degree, knots_, interval);
  return row;
}

}  // namespace dmp::detail
