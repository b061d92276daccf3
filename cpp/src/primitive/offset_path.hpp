#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <vector>

namespace dmp::detail {

/// Reaches, and the distances of via-points from each other and from both ends of the phase, are this or
/// more: the acceleration that a way takes grows with one over its square.
inline constexpr double kLeastReach = 0.01;

/// What is added to a motion over the phase: value, rate and second derivative of d axes, piecewise quintic
/// and two times continuously differentiable; zero outside its pieces. docs/formulation.md, "Via-points". It
/// takes all its memory in the constructor.
class OffsetPath {
 public:
  /// What the offset passes.
  struct Aim {
    double phase;
    double rise;  ///< the part of the phase before it, as it was when the aim was set
    double fall;  ///< and behind
    bool with_rate;
  };

  /// Room for that many aims.
  OffsetPath(Eigen::Index axes, int aims);

  Eigen::Index axes() const noexcept { return axes_; }
  /// Whether there is anything to add, now or later.
  bool active() const noexcept { return active_; }
  /// Nothing, for ever.
  void clear() noexcept;
  /// From `phase` on, where it is `state` (3 d: value, rate, second), to nothing at `end`.
  void begin(double phase, const double* state, double end) noexcept;
  /// Value, rate and second derivative at a phase, (3 d); false, and nothing is written, where it is zero.
  bool at(double phase, double* state) const noexcept;

  /// From its present state at `now` through `count` aims in the order of their phases, with their values
  /// (count x d) and, of those with a rate, rates. What was under way and is taken over by no aim ends where
  /// it was to end, or, if that was not known, at `end`.
  void pass(double now, const std::vector<Aim>& aims, int first, int count, const RowMatrix& values,
            const RowMatrix& rates, double end) noexcept;
  /// The same with another value and rate for the aim next to come: its curvature and all behind stay.
  void correct(double now, const double* value, const double* rate) noexcept;
  /// Whether all of it lies behind.
  void leave_behind(double now) noexcept { active_ = active_ && now < phase_[last()]; }

 private:
  enum class Kind : char { known, zero, aim };
  /// One knot of a chain while its axis is solved: left x_{k-1} + middle x_k + right x_{k+1} = sum.
  struct Block {
    Eigen::Matrix2d left, middle, right;
    Eigen::Vector2d sum;
  };

  std::size_t last() const noexcept { return static_cast<std::size_t>(count_ - 1); }
  double* row(int knot) noexcept { return table_.data() + knot * table_.cols(); }
  const double* row(int knot) const noexcept { return table_.data() + knot * table_.cols(); }
  /// The piece that a phase lies in, by its first knot; -1 outside.
  int piece(double phase) const noexcept;
  void add(double phase, Kind kind) noexcept;
  void add_zero(double phase) noexcept;
  void add_aim(const Aim& aim, const double* value, const double* rate) noexcept;

  // The rates and curvatures that are left open.
  void close_chains() noexcept;
  void close_alone(int knot) noexcept;
  void close_chain(int first, int last) noexcept;
  void close_axis(int first, int last, Eigen::Index axis) noexcept;
  void assemble(int knot, Eigen::Index axis, Block& block) noexcept;
  void limit(int knot, Eigen::Index axis) noexcept;

  double& value(int knot, Eigen::Index axis) noexcept { return table_(knot, axis); }
  double& rate(int knot, Eigen::Index axis) noexcept { return table_(knot, axes_ + axis); }
  double& second(int knot, Eigen::Index axis) noexcept { return table_(knot, 2 * axes_ + axis); }
  double way_before(int knot) const noexcept;
  double way_behind(int knot) const noexcept;
  bool is_extreme(int knot, Eigen::Index axis) noexcept;

  Eigen::Index axes_;
  bool active_ = false;
  int count_ = 0;
  std::vector<double> phase_;  // of the knots
  std::vector<Kind> kind_;
  std::vector<Aim> aim_;         // of the knots that are aims
  RowMatrix table_;              // (knots x 3 d): value, rate, second
  std::vector<Block> blocks_;    // of the axis that is being solved
  std::vector<double> present_;  // (3 d)
};

}  // namespace dmp::detail
