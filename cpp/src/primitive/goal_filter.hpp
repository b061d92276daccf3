#pragma once

#include <dmp/so3.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace dmp::detail {

// How a goal approaches its target, and when it has arrived but for rounding: the only part of the filter
// that depends on the space.

/// Leaves `share` of the way.
inline void approach(Eigen::VectorXd& goal, const Eigen::VectorXd& target, double share) noexcept {
  goal = target + share * (goal - target);
}
inline void approach(Eigen::Quaterniond& goal, const Eigen::Quaterniond& target, double share) noexcept {
  const Eigen::Vector3d way = so3::log(Eigen::Quaterniond(target * goal.conjugate()));
  goal = so3::exp_quaternion((1.0 - share) * way) * goal;
}

inline bool arrived(const Eigen::VectorXd& goal, const Eigen::VectorXd& target) noexcept {
  return ((goal - target).array().abs() <= 1e-15 * target.array().abs() + 1e-300).all();
}
inline bool arrived(const Eigen::Quaterniond& goal, const Eigen::Quaterniond& target) noexcept {
  return (target * goal.conjugate()).vec().norm() < 1e-15;
}

/// The goal g of a motion, which approaches the one that was set, g*: tau gd = alpha_g (g* - g). No
/// allocation once constructed.
template <class Point>
class GoalFilter {
 public:
  /// `rate` is alpha_g; 0 jumps.
  GoalFilter(double rate, const Point& goal) : rate_(rate), goal_(goal), target_(goal) {}

  const Point& goal() const noexcept { return goal_; }
  const Point& target() const noexcept { return target_; }
  /// The goal is the target.
  bool settled() const noexcept { return settled_; }

  template <class Given>
  void set(const Given& target) noexcept {
    target_ = target;
    settled_ = rate_ == 0.0;
    if (settled_) goal_ = target_;
  }
  void jump() noexcept {
    goal_ = target_;
    settled_ = true;
  }
  /// The share of its way that the goal has left after `step` of the phase.
  double left_after(double step) const noexcept { return std::exp(-rate_ * step); }
  Point after(double step) const noexcept {
    Point goal = goal_;
    approach(goal, target_, left_after(step));
    return goal;
  }
  void move_to(const Point& goal) noexcept { goal_ = goal; }
  void advance(double share_left) noexcept { approach(goal_, target_, share_left); }
  /// Ends the way where what is left of it is rounding; whether the goal is the target now.
  bool settle() noexcept {
    if (!settled_ && arrived(goal_, target_)) jump();
    return settled_;
  }

 private:
  double rate_;
  Point goal_;
  Point target_;
  bool settled_ = true;
};

}  // namespace dmp::detail
