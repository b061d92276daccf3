#pragma once

#include <optional>

namespace dmp {

/// The parts of the phase over which a change sets in before its place and fades behind it, 0.01 to 1. Where
/// less is left, before or behind, that is what is used.
struct Reach {
  double rise = 0.2;
  double fall = 0.2;
  constexpr Reach() noexcept = default;
  constexpr Reach(double both) noexcept : rise(both), fall(both) {}
  constexpr Reach(double before, double behind) noexcept : rise(before), fall(behind) {}
};

/// A point or pose that a motion passes at a phase, with a velocity where it is given. The motion is changed
/// within the reach only, and its goal is kept: an offset is added to the learned motion that is zero, with
/// two derivatives, where the reach begins and ends (of rotations: a rotation from the left, world frame).
/// docs/formulation.md, "Via-points".
template <class Space>
struct Via {
  using Point = typename Space::Point;
  using Tangent = typename Space::Tangent;

  Via(double at, const Point& where, const std::optional<Tangent>& how_fast = {}, const Reach& within = {})
      : phase(at), point(where), velocity(how_fast), reach(within) {}

  double phase;                     ///< 0.01 to 0.99, 0.01 or more from the next one
  Point point;                      ///< position, rotation or pose
  std::optional<Tangent> velocity;  ///< (d) per s; rotations in rad/s, world frame
  Reach reach;
};

}  // namespace dmp
