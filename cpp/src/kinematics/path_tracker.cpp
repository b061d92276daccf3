#include "kinematics/path_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/box_step.hpp"
#include "kinematics/singularity.hpp"

namespace dmp::detail {
namespace {

constexpr double to_the_last_digits = 1e-11;  // m and rad
constexpr int iterations_each = 60;
constexpr double least_damping = 1e-12;
constexpr double no_wish = 1e-12;      // m^2 or m rad, a gradient of 0
constexpr double at_a_side = 1e-9;     // rad or m
constexpr double run_up = 0.2;         // s, in which a joint may come from rest to its velocity limit
constexpr double near_a_limit = 0.05;  // rad or m, from where on a smaller margin counts against a route
constexpr double abrupt = 0.5;   // of the drift, by which a step may differ from it without a second look
constexpr double clearly = 0.5;  // of a difference, below which another counts as smaller

double largest(const Joints& way) { return way.cwiseAbs().maxCoeff(); }

// The step to sample `to` that would go on as the joints came in the direction; zero where they begin.
Joints drift_to(const TargetPath& path, const std::vector<Joints>& joints, std::size_t to, int direction) {
  const std::size_t from = direction > 0 ? to - 1 : to + 1;
  const bool begins = direction > 0 ? from == 0 : from + 1 == joints.size();
  const std::size_t before = begins ? from : direction > 0 ? from - 1 : from + 1;
  if (begins || joints[before].size() == 0) return Joints::Zero(joints[from].size());
  const double pace = (path.time[to] - path.time[from]) / (path.time[from] - path.time[before]);
  return pace * (joints[from] - joints[before]);
}

}  // namespace

bool Route::better_than(const Route& other) const {
  if (miss != other.miss) return miss < other.miss;
  const auto burden = [](const Route& route) {
    return std::max(route.velocity_ratio, std::sqrt(route.acceleration_ratio)) *
           (2.0 - std::min(route.margin / near_a_limit, 1.0));
  };
  return burden(*this) < burden(other);
}

PathTracker::PathTracker(const ChainModel& model, const Tolerances& tolerances)
    : range_(model),
      velocity_limit_(model.velocity_limit),
      tolerances_(tolerances),
      lm_(model, {to_the_last_digits, to_the_last_digits, tolerances.goal}, iterations_each) {}

bool PathTracker::met(const Vector6& error) const {
  return error.head<3>().norm() <= tolerances_.position && error.tail<3>().norm() <= tolerances_.angle;
}

double PathTracker::miss(const Frame& target, const Vector6& error) const {
  return met(error) ? 0.0 : lm_.goal().distance(target, error);
}

std::optional<Joints> PathTracker::meet(const Frame& target, const Joints& near, const Joints& lower,
                                        const Joints& upper) const {
  const Descent end = lm_.descend(target, near, lower, upper, iterations_each);
  if (!met(end.error)) return std::nullopt;
  return end.joints;
}

bool PathTracker::meets(const Frame& target, const Joints& joints) const {
  return met(lm_.goal().error(target, lm_.chain().forward(joints)));
}

// Where the null space leads from `at` within the box, away from the limits, while the tip goes to the
// target.
Joints PathTracker::pulled(const Descent& at, const Frame& target, const Box& box, double pull) const {
  Vector6 error = lm_.goal().error(target, at.tip);
  const double motion = lm_.goal().distance(target, error);
  Joints away(at.joints.size());
  for (Eigen::Index i = 0; i < away.size(); ++i) {
    const double reach = range_.upper[i] - range_.lower[i];
    const double offset =
        std::isfinite(reach) ? (2.0 * at.joints[i] - range_.lower[i] - range_.upper[i]) / reach : 0.0;
    away[i] = -pull * motion * offset * offset * offset;
  }
  away = away.cwiseMax(box.lower).cwiseMin(box.upper);
  error -= at.jacobian * away;
  const Jacobian rows = lm_.goal().weighted(target, at.jacobian);
  return away + box_step(rows, lm_.goal().weighted(target, error), least_damping,
                         {box.lower - away, box.upper - away});
}

Descent PathTracker::nearest(const Descent& at, const Frame& target, const Joints& lower, const Joints& upper,
                             double pull) const {
  if (!(pull > 0.0) || !met(at.error)) return lm_.descend_from(at, target, lower, upper, iterations_each);
  const Joints way = pulled(at, target, {lower - at.joints, upper - at.joints}, pull);
  const Joints start = (at.joints + way).cwiseMax(lower).cwiseMin(upper);
  return lm_.descend(target, start, lower, upper, iterations_each);
}

Descent PathTracker::advance(const Descent& at, const Frame& target, const Joints& step, const Joints& drift,
                             double pull) const {
  const Joints lower = range_.lower.cwiseMax(at.joints - step),
               upper = range_.upper.cwiseMin(at.joints + step);
  const Joints straight = at.joints + drift;
  const auto beyond = [&] {
    return lm_.descend(target, straight.cwiseMax(lower).cwiseMin(upper), lower, upper, iterations_each);
  };
  const bool drifts = met(at.error) && !drift.isZero(0.0);
  if (drifts && !has_null_space()) {
    const Descent next = beyond();
    if (next.converged) return next;
  }
  const Descent next = nearest(at, target, lower, upper, pull);
  const double jump = largest(next.joints - straight);
  if (!drifts || !has_null_space() || !(jump > abrupt * largest(drift))) return next;
  const Descent other = beyond();
  return other.converged && largest(other.joints - straight) < clearly * jump ? other : next;
}

IkStatus PathTracker::verdict(const Descent& at, const Descent& next, const Frame& target,
                              const Joints& step) const {
  if (met(next.error)) return IkStatus::ok;
  if (!next.stalled && !next.converged) return IkStatus::budget;
  if (is_singular(goal(), target, next.jacobian, next.error)) return IkStatus::singular;
  const Joints wish = goal().wish(target, next.jacobian, next.error);
  IkStatus status = IkStatus::out_of_reach;
  for (Eigen::Index i = 0; i < wish.size(); ++i) {
    if (std::abs(wish[i]) < no_wish) continue;
    const double room = wish[i] > 0.0 ? range_.upper[i] - next.joints[i] : next.joints[i] - range_.lower[i];
    if (std::abs(next.joints[i] - at.joints[i]) > step[i] - at_a_side) return IkStatus::step_limited;
    if (room < at_a_side) status = IkStatus::limit_blocked;
  }
  return status;
}

Descent PathTracker::standing_at(const Joints& q) const {
  Descent here;
  here.joints = q;
  here.tip = lm_.chain().forward(q, here.jacobian);
  here.error.setZero();
  here.converged = true;
  return here;
}

void PathTracker::walk(const TargetPath& path, Descent at, std::size_t from, int direction, double pull,
                       std::vector<Joints>& joints, double& missed) const {
  const auto count = static_cast<std::ptrdiff_t>(path.target.size());
  for (std::ptrdiff_t k = static_cast<std::ptrdiff_t>(from) + direction; k >= 0 && k < count;
       k += direction) {
    const auto now = static_cast<std::size_t>(k);
    const Joints& step = path.step[direction > 0 ? now - 1 : now];
    at = advance(at, path.target[now], step, drift_to(path, joints, now, direction), pull);
    joints[now] = at.joints;
    missed += miss(path.target[now], at.error);
  }
}

void PathTracker::rate(const TargetPath& path, Route& route) const {
  route.margin = range_.margin(route.joints.front());
  Joints before;
  for (std::size_t k = 1; k < route.joints.size(); ++k) {
    const Joints speed = (route.joints[k] - route.joints[k - 1]) / (path.time[k] - path.time[k - 1]);
    const Joints share = speed.cwiseQuotient(velocity_limit_);
    route.velocity_ratio = std::max(route.velocity_ratio, largest(share));
    route.margin = std::min(route.margin, range_.margin(route.joints[k]));
    if (k > 1)
      route.acceleration_ratio =
          std::max(route.acceleration_ratio,
                   run_up * largest(share - before) / (0.5 * (path.time[k] - path.time[k - 2])));
    before = share;
  }
}

Route PathTracker::track(const TargetPath& path, std::size_t anchor, const Joints& joints,
                         double pull) const {
  Route route;
  route.joints.resize(path.target.size());
  const Descent at = lm_.descend(path.target[anchor], joints, range_.lower, range_.upper, iterations_each);
  route.joints[anchor] = at.joints;
  route.miss = miss(path.target[anchor], at.error);
  walk(path, at, anchor, 1, pull, route.joints, route.miss);
  walk(path, at, anchor, -1, pull, route.joints, route.miss);
  rate(path, route);
  return route;
}

Route PathTracker::track_from(const TargetPath& path, const Joints& start, double pull) const {
  Route route;
  route.joints.resize(path.target.size());
  const Joints lower = range_.lower.cwiseMax(start - path.step.front());
  const Joints upper = range_.upper.cwiseMin(start + path.step.front());
  const Descent at = lm_.descend(path.target.front(), start, lower, upper, iterations_each);
  route.joints.front() = at.joints;
  route.miss = miss(path.target.front(), at.error);
  walk(path, at, 0, 1, pull, route.joints, route.miss);
  rate(path, route);
  return route;
}

}  // namespace dmp::detail
