#include "timing/path_timing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmp::detail {
namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double flat = 1e-12;    // of b, below which a row does not depend on w
constexpr int most_corners = 50;  // of the feasible polygon that the search may pass; a few are usual
}  // namespace

PathTiming::PathTiming(const Eigen::VectorXd& u, const Eigen::VectorXd& largest) : u_(u), largest_(largest) {
  first_.reserve(static_cast<std::size_t>(u.size()) + 1);
}

void PathTiming::limit(double a, double b, double lower, double upper) {
  if (std::abs(a) <= flat * std::abs(b)) {
    const double most = b > 0.0 ? upper / b : b < 0.0 ? lower / b : infinity;
    double& largest = largest_[static_cast<Eigen::Index>(first_.size()) - 1];
    largest = std::min(largest, most);
    return;
  }
  const double low = lower / a, high = upper / a;
  rows_.push_back({b / a, std::min(low, high), std::max(low, high)});
}

PathTiming::Range PathTiming::range(Eigen::Index k, double x, double scale) const {
  Range range = {{-infinity, 0.0}, {infinity, 0.0}};
  const auto knot = static_cast<std::size_t>(k);
  const std::size_t end = knot + 1 < first_.size() ? first_[knot + 1] : rows_.size();
  for (std::size_t i = first_[knot]; i < end; ++i) {
    const Row& row = rows_[i];
    const double low = scale * row.lower - row.slope * x, high = scale * row.upper - row.slope * x;
    if (low > range.low.value) range.low = {low, -row.slope};
    if (high < range.high.value) range.high = {high, -row.slope};
  }
  return range;
}

// The largest x at knot k from which a w leads to at most `next` at the next knot. The room between the
// highest and the lowest w is a concave, piecewise linear function of x: Newton's method comes down on its
// zero from above, corner by corner.
double PathTiming::controllable(Eigen::Index k, double next, double scale) const {
  const double two_steps = 2.0 * (u_[k + 1] - u_[k]);
  double x = scale * largest_[k];
  for (int i = 0; i < most_corners; ++i) {
    Range r = range(k, x, scale);
    const double to_next = (next - x) / two_steps;
    if (to_next < r.high.value) r.high = {to_next, -1.0 / two_steps};
    if (-x / two_steps > r.low.value) r.low = {-x / two_steps, -1.0 / two_steps};
    const double gap = r.low.value - r.high.value;
    if (gap <= 1e-12 * (std::abs(r.low.value) + 1.0)) return x;
    const double closing = r.low.slope - r.high.slope;
    if (!(closing > 0.0)) return 0.0;
    x = std::max(x - gap / closing, 0.0);
    if (x == 0.0) return 0.0;
  }
  return x;
}

Eigen::VectorXd PathTiming::fastest(const Eigen::VectorXd& scale) const {
  const Eigen::Index last = u_.size() - 1;
  Eigen::VectorXd x(last + 1);
  x[last] = 0.0;
  for (Eigen::Index k = last - 1; k >= 0; --k) x[k] = controllable(k, x[k + 1], scale[k]);
  x[0] = 0.0;
  for (Eigen::Index k = 0; k < last; ++k) {
    const Range r = range(k, x[k], scale[k]);
    const double two_steps = 2.0 * (u_[k + 1] - u_[k]);
    x[k + 1] = std::min(x[k + 1], std::max(x[k] + two_steps * r.high.value, 0.0));
  }
  return x;
}

}  // namespace dmp::detail
