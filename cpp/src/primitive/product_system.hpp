#pragma once

#include "primitive/parts.hpp"
#include "primitive/rotation_system.hpp"
#include "primitive/vector_system.hpp"

namespace dmp::detail {

template <class Space>
class ProductSystem;

template <class Space>
struct SystemOf {
  using type = ProductSystem<Space>;
};
template <>
struct SystemOf<VectorSpace> {
  using type = VectorSystem;
};
template <>
struct SystemOf<RotationSpace> {
  using type = RotationSystem;
};
template <class Space>
using System = typename SystemOf<Space>::type;

inline Eigen::Index place_axes_of(const VectorSystem& system) noexcept { return system.axes(); }
inline Eigen::Index place_axes_of(const RotationSystem&) noexcept { return 0; }
template <class Space>
Eigen::Index place_axes_of(const ProductSystem<Space>& system) noexcept {
  return system.place_axes();
}

/// Two transformation systems in the same steps; their axes lie side by side. The same interface as
/// VectorSystem.
template <class Space>
class ProductSystem {
  using P = Parts<Space>;
  using First = typename P::First;
  using Second = typename P::Second;

 public:
  ProductSystem(const DmpOptions& options, const Ends<Space>& ends)
      : first_(options, first_of(ends)), second_(options, second_of(ends)) {}

  Eigen::Index dimension() const noexcept { return first_.dimension() + second_.dimension(); }
  void begin(typename Space::PointArgument point, typename Space::TangentArgument z) noexcept {
    first_.begin(P::first(point), z.head(first_.dimension()));
    second_.begin(P::second(point), z.tail(second_.dimension()));
  }
  void set_goal(typename Space::PointArgument goal) noexcept {
    first_.set_goal(P::first(goal));
    second_.set_goal(P::second(goal));
  }
  void start_with_goal(typename Space::PointArgument goal) noexcept {
    first_.start_with_goal(P::first(goal));
    second_.start_with_goal(P::second(goal));
  }

  bool unscaled() const noexcept { return first_.unscaled() && second_.unscaled(); }
  bool advances() const noexcept { return first_.advances() || second_.advances(); }
  void scale(double* forcing, const double* advance) const noexcept {
    first_.scale(forcing, advance);
    second_.scale(forcing + first_.dimension(), advance + parts_of<First>());
  }
  void to_drive(double* tangent) const noexcept {
    first_.to_drive(tangent);
    second_.to_drive(tangent + first_.dimension());
  }

  void set_phase(double s) noexcept {
    first_.set_phase(s);
    second_.set_phase(s);
  }
  void advance(double step, const Nodes& drive) noexcept {
    first_.advance(step, drive);
    second_.advance(step, drive.from(first_.dimension()));
  }
  bool compute_outputs(double speed, double speed_rate, const double* drive) noexcept {
    return first_.compute_outputs(speed, speed_rate, drive) &&
           second_.compute_outputs(speed, speed_rate, drive + first_.dimension());
  }
  void publish() noexcept {
    first_.publish();
    second_.publish();
  }

  void displace(const Shift& by) noexcept {
    first_.displace(by);
    second_.displace(by.from(first_.dimension()));
  }

  void hold() noexcept {
    first_.hold();
    second_.hold();
  }
  bool confine(SafetyStep& filter, Eigen::Index first, bool place, double speed, double& pull) noexcept {
    const bool one = first_.confine(filter, first, place, speed, pull);
    const bool other = second_.confine(filter, first + first_.axes(), place && kSecondIsPlace, speed, pull);
    return one || other;
  }
  Eigen::Index axes() const noexcept { return first_.axes() + second_.axes(); }
  /// Axes of the places that obstacles are for: the first vectors of a motion, and every pose.
  Eigen::Index place_axes() const noexcept { return place_axes_of(first_); }

  typename Space::Output output() const noexcept { return {first_.output(), second_.output()}; }
  typename Space::PointView goal() const noexcept { return P::view(first_.goal(), second_.goal()); }
  typename Space::PointView point() const noexcept { return P::view(first_.point(), second_.point()); }
  void velocity(double speed, double* out) const noexcept {
    first_.velocity(speed, out);
    second_.velocity(speed, out + first_.dimension());
  }

 private:
  static constexpr bool kSecondIsPlace = std::is_same_v<Second, PoseSpace>;

  System<First> first_;
  System<Second> second_;
};

}  // namespace dmp::detail
