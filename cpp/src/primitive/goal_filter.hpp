#pragma once

#include <dmp/so3.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace dmp::detail {

// Puts `goal` where `left` of the way from `from` to `target` is before it, and whether two points are the
// same: the only parts of the filter that depend on the space.

inline void put_on_way(Eigen::VectorXd& goal, const Eigen::VectorXd& from, const Eigen::VectorXd& target,
                       double left) noexcept {
  goal = target + left * (from - target);
}
inline void put_on_way(Eigen::Quaterniond& goal, const Eigen::Quaterniond& from,
                       const Eigen::Quaterniond& target, double left) noexcept {
  const Eigen::Vector3d way = so3::log(Eigen::Quaterniond(from * target.conjugate()));
  goal = so3::exp_quaternion(left * way) * target;
}

template <class Given>
bool same(const Eigen::MatrixBase<Given>& a, const Eigen::VectorXd& b) noexcept {
  return a == b;
}
template <class Given>
bool same(const Eigen::QuaternionBase<Given>& a, const Eigen::Quaterniond& b) noexcept {
  return a.coeffs() == b.coeffs();
}

/// The goal g of a motion, which approaches the one that was set, g*: tau gd = alpha_g (g* - g). The share of
/// the way that is left is kept, and not only the goal itself, so that it arrives where that share is
/// rounding. No allocation once constructed.
template <class Point>
class GoalFilter {
 public:
  /// `rate` is alpha_g; 0 jumps.
  GoalFilter(double rate, const Point& goal) : rate_(rate), from_(goal), goal_(goal), target_(goal) {}

  const Point& goal() const noexcept { return goal_; }
  const Point& target() const noexcept { return target_; }
  /// The goal is the target.
  bool settled() const noexcept { return left_ == 0.0; }

  /// Sets another target; the one that is approached already changes nothing.
  template <class Given>
  void set(const Given& target) noexcept {
    if (same(target, target_)) return;
    target_ = target;
    from_ = goal_;
    left_ = 1.0;
    if (rate_ == 0.0) jump();
  }
  void jump() noexcept {
    goal_ = target_;
    left_ = 0.0;
  }
  /// The share of its way that the goal has left after `step` of the phase.
  double left_after(double step) const noexcept { return std::exp(-rate_ * step); }
  Point after(double step) const noexcept {
    Point goal = goal_;
    put_on_way(goal, from_, target_, left_ * left_after(step));
    return goal;
  }
  void advance(double share_left) noexcept {
    left_ *= share_left;
    put_on_way(goal_, from_, target_, left_);
  }
  /// Ends the way where what is left of it is rounding; whether the goal is the target now.
  bool settle() noexcept {
    if (left_ < kRounding) jump();
    return settled();
  }

 private:
  static constexpr double kRounding = 1e-16;

  double rate_;
  Point from_;  // where the goal was when the target was set
  Point goal_;
  Point target_;
  double left_ = 0.0;  // share of the way from there to the target
};

}  // namespace dmp::detail
