#include "primitive/position_motion.hpp"

#include "geometry/flush.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace dmp::detail {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Calls work(n) with n known when this is compiled for the three axes of space, so that loops unroll.
template <class Work>
void for_axes(Index axes, Work work) noexcept {
  if (axes == 3) return work(std::integral_constant<Index, 3>{});
  work(axes);
}

}  // namespace

PositionMotion::PositionMotion(const DmpOptions& options, const VectorXd& start, const VectorXd& goal,
                               const VectorXd& z, const VectorXd& amplitude)
    : integrator_(options.integrator),
      unscaled_(options.scaling == Scaling::none),
      goal_filter_(options.goal_filter),
      spring_(options.alpha, *options.beta),
      scale_(options.scaling, goal - start, amplitude),
      start_(start),
      y_(start),
      z_(z),
      goal_(goal),
      target_(goal),
      scratch_(RowMatrix::Zero(3, start.size())),
      displacement_(goal - start),
      next_velocity_(VectorXd::Zero(start.size())),
      next_acceleration_(VectorXd::Zero(start.size())),
      position_(start),
      velocity_(VectorXd::Zero(start.size())),
      acceleration_(velocity_) {
  scale_.set(displacement_);
}

void PositionMotion::begin(const Eigen::Ref<const VectorXd>& y,
                           const Eigen::Ref<const VectorXd>& z) noexcept {
  start_ = y;
  y_ = y;
  z_ = z;
  jump_to_goal();
  set_goal(target_);
}

void PositionMotion::set_goal(const Eigen::Ref<const VectorXd>& goal) noexcept {
  target_ = goal;
  settled_ = goal_filter_ == 0.0 || goal_ == target_;
  if (settled_) goal_ = target_;
  rescale();
}

/// The scale follows the goal as filtered: the forcing term does not jump.
void PositionMotion::rescale() noexcept {
  if (unscaled_) return;
  displacement_ = goal_ - start_;
  scale_.set(displacement_);
}

void PositionMotion::start_with_goal(const Eigen::Ref<const VectorXd>& goal) noexcept {
  set_goal(goal);
  jump_to_goal();
}

void PositionMotion::jump_to_goal() noexcept {
  goal_ = target_;
  settled_ = true;
  rescale();
}

const double* PositionMotion::scaled(const double* forcing, int node) noexcept {
  if (unscaled_) return forcing;
  for (Index d = 0; d < scratch_.cols(); ++d) scratch_(node, d) = forcing[d];
  scale_.apply(scratch_.row(node).data());
  return scratch_.row(node).data();
}

void PositionMotion::advance(double step, const ForcingNodes& forcing) noexcept {
  const double* end = scaled(forcing.end, 2);
  if (integrator_ == Integrator::semi_implicit_euler) return advance_euler(step, end);
  advance_exactly(step, scaled(forcing.start, 0), scaled(forcing.middle, 1), end);
}

void PositionMotion::advance_exactly(double step, const double* start, const double* middle,
                                     const double* end) noexcept {
  spring_.prepare(step);
  if (settled_) {
    for_axes(y_.size(), [&, y = y_.data(), z = z_.data(), goal = goal_.data()](auto axes) {
      for (Index d = 0; d < axes; ++d) {
        double u = y[d] - goal[d];
        spring_.advance(u, z[d], start[d], middle[d], end[d]);
        y[d] = goal[d] + u;
      }
    });
    return;
  }
  advance_to_moving_goal(step, start, middle, end);
}

/// The way of the goal is a force on the spring around where it arrives.
void PositionMotion::advance_to_moving_goal(double step, const double* start, const double* middle,
                                            const double* end) noexcept {
  const double half_decay = std::exp(-0.5 * goal_filter_ * step);
  const double stiffness = spring_.stiffness();
  double farthest = 0.0;
  for (Index d = 0; d < y_.size(); ++d) {
    const double away = goal_[d] - target_[d];
    const double pull_start = stiffness * away * (1.0 - half_decay * half_decay);
    const double pull_middle = stiffness * away * half_decay * (1.0 - half_decay);
    farthest = std::fmax(farthest, approach(d, half_decay * half_decay));
    double u = y_[d] - goal_[d];
    spring_.advance(u, z_[d], start[d] + pull_start, middle[d] + pull_middle, end[d]);
    y_[d] = goal_[d] + u;
  }
  follow_goal(farthest);
}

void PositionMotion::advance_euler(double step, const double* end) noexcept {
  const double beta = spring_.stiffness() / spring_.alpha();
  const double decay = settled_ ? 0.0 : std::exp(-goal_filter_ * step);
  double farthest = 0.0;
  for (Index d = 0; d < y_.size(); ++d) {
    if (!settled_) farthest = std::fmax(farthest, approach(d, decay));
    z_[d] = flushed(z_[d] + step * (spring_.alpha() * (beta * (goal_[d] - y_[d]) - z_[d]) + end[d]));
    y_[d] = goal_[d] + flushed(y_[d] + step * z_[d] - goal_[d]);
  }
  follow_goal(farthest);
}

/// Leaves `share` of the goal's way; how far it is yet, beyond rounding.
double PositionMotion::approach(Index d, double share) noexcept {
  goal_[d] = target_[d] + share * (goal_[d] - target_[d]);
  return std::abs(goal_[d] - target_[d]) - 1e-15 * std::abs(target_[d]);
}

void PositionMotion::follow_goal(double farthest) noexcept {
  if (settled_) return;
  rescale();
  if (farthest < 1e-300) jump_to_goal();
}

bool PositionMotion::look(double speed, double speed_rate, const double* forcing) noexcept {
  const double* const force = scaled(forcing, 2);
  const double stiffness = spring_.stiffness();
  const double alpha = spring_.alpha();
  const double squared = speed * speed;
  double sum = 0.0;  // of everything times 0: it is 0 if all are finite, not a number otherwise
  for_axes(y_.size(), [&, y = y_.data(), z = z_.data(), goal = goal_.data(), velocity = next_velocity_.data(),
                       acceleration = next_acceleration_.data()](auto axes) {
    for (Index d = 0; d < axes; ++d) {
      const double zd = z[d];
      const double v = zd * speed;
      const double a = (stiffness * (goal[d] - y[d]) - alpha * zd + force[d]) * squared + zd * speed_rate;
      sum += 0.0 * (y[d] + v + a);
      velocity[d] = v;
      acceleration[d] = a;
    }
  });
  return sum == 0.0;
}

// Copied, not swapped: whoever keeps a pointer to an output reads the newest.
void PositionMotion::publish() noexcept {
  for_axes(y_.size(), [&, y = y_.data(), v = next_velocity_.data(), a = next_acceleration_.data(),
                       position = position_.data(), velocity = velocity_.data(),
                       acceleration = acceleration_.data()](auto axes) {
    for (Index d = 0; d < axes; ++d) {
      position[d] = y[d];
      velocity[d] = v[d];
      acceleration[d] = a[d];
    }
  });
}

}  // namespace dmp::detail
