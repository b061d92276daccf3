#include "path_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "box_step.hpp"
#include "pose_error.hpp"

namespace dmp::detail {
namespace {

constexpr double to_the_last_digits = 1e-11;  // m and rad
constexpr int iterations_each = 60;
constexpr double least_damping = 1e-12;
constexpr double near_a_limit = 0.05;  // rad or m, from where on a smaller margin counts against a route

}  // namespace

bool Route::better_than(const Route& other) const {
  if (miss != other.miss) return miss < other.miss;
  const auto burden = [](const Route& route) {
    return route.velocity_ratio * (2.0 - std::min(route.margin / near_a_limit, 1.0));
  };
  return burden(*this) < burden(other);
}

PathTracker::PathTracker(const ChainModel& model, const Tolerances& tolerances)
    : range_(model),
      velocity_limit_(model.velocity_limit),
      tolerances_(tolerances),
      lm_(model, {to_the_last_digits, to_the_last_digits, tolerances.angle_weight}, iterations_each) {}

double PathTracker::miss(const Vector6& error) const {
  const double position = error.head<3>().norm(), angle = error.tail<3>().norm();
  const bool met = position <= tolerances_.position && angle <= tolerances_.angle;
  return met ? 0.0 : position + tolerances_.angle_weight * angle;
}

std::optional<Joints> PathTracker::meet(const Frame& target, const Joints& near, const Joints& lower,
                                        const Joints& upper) const {
  const Descent end = lm_.descend(target, near, lower, upper, iterations_each);
  if (miss(end.error) > 0.0) return std::nullopt;
  return end.joints;
}

bool PathTracker::meets(const Frame& target, const Joints& joints) const {
  return miss(pose_error(target, lm_.chain().forward(joints))) == 0.0;
}

Descent PathTracker::advance(const Descent& at, const Frame& target, const Joints& step, double pull) const {
  const Joints lower = range_.lower.cwiseMax(at.joints - step),
               upper = range_.upper.cwiseMin(at.joints + step);
  Joints start = at.joints;
  if (pull > 0.0 && miss(at.error) == 0.0) {
    Vector6 error = pose_error(target, at.tip);
    const double motion = error.head<3>().norm() + tolerances_.angle_weight * error.tail<3>().norm();
    Joints away(start.size());
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      const double reach = range_.upper[i] - range_.lower[i];
      const double offset =
          std::isfinite(reach) ? (2.0 * start[i] - range_.lower[i] - range_.upper[i]) / reach : 0.0;
      away[i] = -pull * motion * offset * offset * offset;
    }
    away = (start + away).cwiseMax(lower).cwiseMin(upper) - start;
    error -= at.jacobian * away;
    const Joints from = start + away;
    start = (from + box_step(at.jacobian, error, least_damping, {lower - from, upper - from}))
                .cwiseMax(lower)
                .cwiseMin(upper);
  }
  return lm_.descend(target, start, lower, upper, iterations_each);
}

void PathTracker::walk(const TargetPath& path, Descent at, std::size_t from, int direction, double pull,
                       std::vector<Joints>& joints, double& missed) const {
  const auto count = static_cast<std::ptrdiff_t>(path.target.size());
  for (std::ptrdiff_t k = static_cast<std::ptrdiff_t>(from) + direction; k >= 0 && k < count;
       k += direction) {
    const auto now = static_cast<std::size_t>(k);
    const Joints& step = path.step[direction > 0 ? now - 1 : now];
    at = advance(at, path.target[now], step, pull);
    joints[now] = at.joints;
    missed += miss(at.error);
  }
}

void PathTracker::rate(const TargetPath& path, Route& route) const {
  route.margin = range_.margin(route.joints.front());
  for (std::size_t k = 1; k < route.joints.size(); ++k) {
    const Joints speed = (route.joints[k] - route.joints[k - 1]) / (path.time[k] - path.time[k - 1]);
    route.velocity_ratio =
        std::max(route.velocity_ratio, speed.cwiseAbs().cwiseQuotient(velocity_limit_).maxCoeff());
    route.margin = std::min(route.margin, range_.margin(route.joints[k]));
  }
}

Route PathTracker::track(const TargetPath& path, std::size_t anchor, const Joints& joints,
                         double pull) const {
  Route route;
  route.joints.resize(path.target.size());
  const Descent at = lm_.descend(path.target[anchor], joints, range_.lower, range_.upper, iterations_each);
  route.joints[anchor] = at.joints;
  route.miss = miss(at.error);
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
  route.miss = miss(at.error);
  walk(path, at, 0, 1, pull, route.joints, route.miss);
  rate(path, route);
  return route;
}

}  // namespace dmp::detail
