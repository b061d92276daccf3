#include "kinematics/calming.hpp"

#include <dmp/joint_trajectory.hpp>

namespace dmp::detail {
namespace {

constexpr std::size_t most_knots = 60;
constexpr int sweeps = 40;

using Knots = std::vector<std::size_t>;

Knots knots_of(std::size_t count) {
  const std::size_t used = std::min(count, most_knots);
  Knots knots;
  for (std::size_t i = 0; i < used; ++i) knots.push_back(i * (count - 1) / (used - 1));
  return knots;
}

// A limit shall not be reached where the band can keep off it.
struct Inner {
  explicit Inner(const JointRange& range) : lower(range.lower), upper(range.upper) {
    for (Eigen::Index i = 0; i < lower.size(); ++i) {
      const double width = upper[i] - lower[i];
      if (!(width < std::numeric_limits<double>::infinity())) continue;
      lower[i] += 0.02 * width;
      upper[i] -= 0.02 * width;
    }
  }
  Joints lower, upper;
};

void tighten(const PathTracker& tracker, const TargetPath& path, const JointRange& range, const Knots& knots,
             std::vector<Joints>& band) {
  const Inner inner(range);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < band.size(); ++i) {
      const Joints& before = band[i > 0 ? i - 1 : i];
      const Joints& after = band[i + 1 < band.size() ? i + 1 : i];
      const Joints middle = i == 0 ? after : i + 1 == band.size() ? before : Joints(0.5 * (before + after));
      const Joints lower = inner.lower.cwiseMin(band[i]), upper = inner.upper.cwiseMax(band[i]);
      const Joints wish = (band[i] + 0.7 * (middle - band[i])).cwiseMax(lower).cwiseMin(upper);
      const auto met = tracker.meet(path.target[knots[i]], wish, lower, upper);
      if (met) band[i] = *met;
    }
}

// The spline through the band at time t of the samples between knots i and i + 1 (Hermite form).
Joints between(const JointTrajectory& spline, Eigen::Index i, double t) {
  const double h = spline.time[i + 1] - spline.time[i], s = (t - spline.time[i]) / h;
  const double right = s * s * (3.0 - 2.0 * s), rise = h * s * (1.0 - s) * (1.0 - s),
               fall = -h * s * s * (1.0 - s);
  return ((1.0 - right) * spline.position.row(i) + right * spline.position.row(i + 1) +
          rise * spline.velocity.row(i) + fall * spline.velocity.row(i + 1))
      .transpose();
}

JointTrajectory spline_through(const TargetPath& path, const Knots& knots, const std::vector<Joints>& band) {
  const auto count = static_cast<Eigen::Index>(knots.size());
  Eigen::VectorXd times(count);
  RowMatrix positions(count, band.front().size());
  for (Eigen::Index i = 0; i < count; ++i) {
    times[i] = path.time[knots[static_cast<std::size_t>(i)]];
    positions.row(i) = band[static_cast<std::size_t>(i)].transpose();
  }
  return JointTrajectory::through(times, positions);
}

// Every pose met near the spline.
std::optional<Route> put_on(const PathTracker& tracker, const TargetPath& path, const JointRange& range,
                            const Knots& knots, const JointTrajectory& spline) {
  Route route;
  std::size_t knot = 0;
  for (std::size_t k = 0; k < path.target.size(); ++k) {
    while (knot + 2 < knots.size() && knots[knot + 1] <= k) ++knot;
    const Joints wish = between(spline, static_cast<Eigen::Index>(knot), path.time[k]);
    Joints lower = range.lower, upper = range.upper;
    if (k > 0) {
      lower = lower.cwiseMax(route.joints.back() - path.step[k - 1]);
      upper = upper.cwiseMin(route.joints.back() + path.step[k - 1]);
    }
    const auto met = tracker.meet(path.target[k], wish.cwiseMax(lower).cwiseMin(upper), lower, upper);
    if (!met) return std::nullopt;
    route.joints.push_back(*met);
  }
  tracker.rate(path, route);
  return route;
}

}  // namespace

std::optional<Route> calmed(const ChainModel& model, const PathTracker& tracker, const TargetPath& path,
                            const Route& route) {
  if (!tracker.has_null_space() || path.target.size() < 4) return std::nullopt;
  const JointRange range(model);
  const Knots knots = knots_of(path.target.size());
  std::vector<Joints> band;
  for (const std::size_t knot : knots) band.push_back(route.joints[knot]);
  tighten(tracker, path, range, knots, band);
  return put_on(tracker, path, range, knots, spline_through(path, knots, band));
}

}  // namespace dmp::detail
