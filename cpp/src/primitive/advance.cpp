#include "primitive/advance.hpp"

#include <cmath>

#include "primitive/learning.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kAcross = 0.1;     // rho: how much what goes across the way counts
constexpr double kSoft = 0.2;       // eps: below this share of the mean rate the advance eases off
constexpr double kBegins = 0.05;    // of the phase, within which it sets in
constexpr double kNothing = 1e-12;  // m or rad that rounding alone moves
constexpr double kNoWay = 1e-3;     // of the range: a way that is no direction

/// sigma' but for its scale.
VectorXd rate_along(const VectorXd& s, const RowMatrix& velocity, const VectorXd& way,
                    const VectorXd& range) {
  const VectorXd speed2 = velocity.rowwise().squaredNorm();
  VectorXd w2 = speed2;
  if (way.norm() > kNoWay * range.norm())
    w2 = (velocity * way.normalized()).array().square().matrix() + kAcross * kAcross * speed2;
  const double mean = w2.mean();
  if (range.norm() < kNothing || mean == 0.0)
    return 30.0 * (s.array() * (1.0 - s.array())).square();  // of minimum jerk
  VectorXd rate = w2.array() / (w2.array() + kSoft * kSoft * mean).sqrt();
  for (Index k = 0; k < s.size() && s[k] < kBegins; ++k) {
    const double u = s[k] / kBegins;
    rate[k] *= u * u * (3.0 - 2.0 * u);
  }
  return rate;
}

/// The integral of `rate` from the first sample on: Hermite's rule, of fourth order.
VectorXd integral(const VectorXd& s, const VectorXd& rate, const VectorXd& slope) {
  VectorXd sum = VectorXd::Zero(s.size());
  for (Index k = 1; k < s.size(); ++k) {
    const double h = s[k] - s[k - 1];
    sum[k] = sum[k - 1] + h / 2.0 * (rate[k - 1] + rate[k]) + h * h / 12.0 * (slope[k - 1] - slope[k]);
  }
  return sum;
}

}  // namespace

RowMatrix advance_along(const VectorXd& s, const RowMatrix& velocity, const VectorXd& way,
                        const VectorXd& range, const Gains& gains) {
  const VectorXd rate = rate_along(s, velocity, way, range);
  const VectorXd slope = s.size() < 3 ? VectorXd::Zero(s.size()) : VectorXd(gradient(s, rate).col(0));
  const VectorXd advanced = integral(s, rate, slope);
  const double whole = advanced[s.size() - 1];
  if (!(whole > 0.0)) return RowMatrix::Zero(s.size(), 1);  // two samples
  const VectorXd left = whole - advanced.array();
  return (slope + gains.alpha * rate - gains.alpha * gains.beta * left) / whole;
}

}  // namespace dmp::detail
