#include "primitive/vector_system.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "geometry/flush.hpp"

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

VectorSystem::VectorSystem(const DmpOptions& options, const Ends<VectorSpace>& ends)
    : integrator_(options.integrator),
      spring_(options.alpha, *options.beta),
      scale_(options, ends.displacement, ends.amplitude),
      goal_(options.goal_filter, ends.goal),
      start_(ends.start),
      y_(ends.start),
      z_(ends.z),
      away_(ends.displacement),
      next_{ends.start, VectorXd::Zero(ends.start.size()), VectorXd::Zero(ends.start.size())},
      outputs_(next_),
      held_(next_) {
  scale_.set(ends.displacement);
}

void VectorSystem::begin(VectorSpace::PointArgument y, VectorSpace::TangentArgument z) noexcept {
  start_ = y;
  y_ = y;
  z_ = z;
  goal_.jump();
  rescale();
}

void VectorSystem::set_goal(VectorSpace::PointArgument goal) noexcept {
  goal_.set(goal);
  rescale();
}

void VectorSystem::start_with_goal(VectorSpace::PointArgument goal) noexcept {
  goal_.set(goal);
  goal_.jump();
  rescale();
}

/// The scale follows the goal as filtered: the drive does not jump.
void VectorSystem::rescale() noexcept {
  if (scale_.is_fixed()) return;
  away_ = goal_.goal() - start_;
  scale_.set(away_);
}

void VectorSystem::follow_goal() noexcept {
  if (goal_.settled()) return;
  goal_.settle();
  rescale();
}

void VectorSystem::advance(double step, const Nodes& drive) noexcept {
  if (integrator_ == Integrator::semi_implicit_euler) return advance_euler(step, drive.end);
  spring_.prepare(step);
  if (!goal_.settled()) return advance_to_moving_goal(step, drive);
  advance_exactly(drive);
}

void VectorSystem::advance_exactly(const Nodes& drive) noexcept {
  for_axes(y_.size(), [&, y = y_.data(), z = z_.data(), goal = goal_.goal().data()](auto axes) {
    for (Index d = 0; d < axes; ++d) {
      double u = y[d] - goal[d];
      spring_.advance(u, z[d], drive.start[d], drive.middle[d], drive.end[d]);
      y[d] = goal[d] + u;
    }
  });
}

/// The way of the goal is a force on the spring around where it arrives.
void VectorSystem::advance_to_moving_goal(double step, const Nodes& drive) noexcept {
  const double half = goal_.left_after(0.5 * step);
  away_ = spring_.stiffness() * (goal_.goal() - goal_.target());
  goal_.advance(half * half);
  const VectorXd& goal = goal_.goal();
  for (Index d = 0; d < y_.size(); ++d) {
    const double pull_start = away_[d] * (1.0 - half * half);
    const double pull_middle = away_[d] * half * (1.0 - half);
    double u = y_[d] - goal[d];
    spring_.advance(u, z_[d], drive.start[d] + pull_start, drive.middle[d] + pull_middle, drive.end[d]);
    y_[d] = goal[d] + u;
  }
  follow_goal();
}

void VectorSystem::advance_euler(double step, const double* drive) noexcept {
  if (!goal_.settled()) goal_.advance(goal_.left_after(step));
  const double beta = spring_.stiffness() / spring_.alpha();
  const VectorXd& goal = goal_.goal();
  for (Index d = 0; d < y_.size(); ++d) {
    z_[d] = flushed(z_[d] + step * (spring_.alpha() * (beta * (goal[d] - y_[d]) - z_[d]) + drive[d]));
    y_[d] = goal[d] + flushed(y_[d] + step * z_[d] - goal[d]);
  }
  follow_goal();
}

bool VectorSystem::compute_outputs(double speed, double speed_rate, const double* drive) noexcept {
  const double stiffness = spring_.stiffness();
  const double alpha = spring_.alpha();
  const double squared = speed * speed;
  double sum = 0.0;  // of everything times 0: it is 0 if all are finite, not a number otherwise
  for_axes(
      y_.size(), [&, y = y_.data(), z = z_.data(), goal = goal_.goal().data(),
                  velocity = next_.velocity.data(), acceleration = next_.acceleration.data()](auto axes) {
        for (Index d = 0; d < axes; ++d) {
          const double zd = z[d];
          const double v = zd * speed;
          const double a = (stiffness * (goal[d] - y[d]) - alpha * zd + drive[d]) * squared + zd * speed_rate;
          sum += 0.0 * (y[d] + v + a);
          velocity[d] = v;
          acceleration[d] = a;
        }
      });
  return sum == 0.0;
}

// Copied, not swapped: whoever keeps a pointer to an output reads the newest.
void VectorSystem::publish() noexcept {
  for_axes(y_.size(), [&, y = y_.data(), v = next_.velocity.data(), a = next_.acceleration.data(),
                       position = outputs_.position.data(), velocity = outputs_.velocity.data(),
                       acceleration = outputs_.acceleration.data()](auto axes) {
    for (Index d = 0; d < axes; ++d) {
      position[d] = y[d];
      velocity[d] = v[d];
      acceleration[d] = a[d];
    }
  });
}

void VectorSystem::hold() noexcept {
  held_.position = outputs_.position;
  held_.velocity = outputs_.velocity;
}

void VectorSystem::reseat(VectorSpace::PointArgument y, VectorSpace::TangentArgument z) noexcept {
  y_ = y;
  z_ = z;
}

// The outputs are the own motion and what is displaced; that stays, so the own motion takes the difference.
bool VectorSystem::confine(SafetyStep& filter, Index first, bool place, double speed, double& pull) noexcept {
  next_.position = outputs_.position;  // as wanted
  next_.velocity = outputs_.velocity;
  const AxesStep step{y_.size(),
                      held_.position.data(),
                      held_.velocity.data(),
                      goal_.target().data(),
                      outputs_.position.data(),
                      outputs_.velocity.data(),
                      outputs_.acceleration.data()};
  if (!filter.keep(first, place, step)) return false;
  y_ += outputs_.position - next_.position;
  next_.velocity = (outputs_.velocity - next_.velocity) / speed;
  z_ += next_.velocity;
  pull = std::max(pull, next_.velocity.norm() / (filter.dt() * speed * spring_.stiffness()));
  return true;
}

void VectorSystem::velocity(double speed, double* out) const noexcept {
  for (Index d = 0; d < z_.size(); ++d) out[d] = z_[d] * speed;
}

}  // namespace dmp::detail
