#pragma once

#include <dmp/pose_dmp.hpp>
#include <dmp/product.hpp>

#include <Eigen/Core>
#include <type_traits>

#include "primitive/ends.hpp"

namespace dmp::detail {

/// How a space that is made of two comes apart: its points, views and demonstrations.
template <class Space>
struct Parts;

template <class A, class B>
struct Parts<Product<A, B>> {
  using Space = Product<A, B>;
  using First = A;
  using Second = B;
  static const typename A::Point& first(const typename Space::Point& point) noexcept { return point.first; }
  static const typename B::Point& second(const typename Space::Point& point) noexcept { return point.second; }
  static const auto& first(const typename Space::Demonstration& both) { return both.first(); }
  static const auto& second(const typename Space::Demonstration& both) { return both.second(); }
  static typename Space::Point join(const typename A::Point& first, const typename B::Point& second) {
    return {first, second};
  }
  static typename Space::PointView view(typename A::PointView first, typename B::PointView second) noexcept {
    return {first, second};
  }
};

template <>
struct Parts<PoseSpace> {
  using First = VectorSpace;
  using Second = RotationSpace;
  static Eigen::Vector3d first(const Eigen::Matrix4d& pose) noexcept { return pose.topRightCorner<3, 1>(); }
  static Eigen::Matrix3d second(const Eigen::Matrix4d& pose) noexcept { return pose.topLeftCorner<3, 3>(); }
  static const auto& first(const PoseDemonstration& both) { return both.position(); }
  static const auto& second(const PoseDemonstration& both) { return both.orientation(); }
  static Eigen::Matrix4d join(const Eigen::VectorXd& position, const Eigen::Matrix3d& rotation) {
    return pose_of(rotation, position);
  }
  static Eigen::Matrix4d view(const Eigen::VectorXd& position, const Eigen::Matrix3d& rotation) noexcept {
    return pose_of(rotation, position);
  }
};

/// The axes d of a point or a demonstration.
template <class Space, class Thing>
Eigen::Index dimension_of(const Thing& thing) {
  if constexpr (std::is_same_v<Thing, Demonstration>) {
    return thing.dimension();
  } else if constexpr (std::is_same_v<Space, VectorSpace>) {
    return thing.size();
  } else if constexpr (std::is_same_v<Space, RotationSpace>) {
    return 3;
  } else {
    using P = Parts<Space>;
    return dimension_of<typename P::First>(P::first(thing)) +
           dimension_of<typename P::Second>(P::second(thing));
  }
}

/// How many vectors and rotations a point is made of.
template <class Space>
constexpr int parts_of() {
  if constexpr (std::is_same_v<Space, VectorSpace> || std::is_same_v<Space, RotationSpace>) {
    return 1;
  } else {
    return parts_of<typename Parts<Space>::First>() + parts_of<typename Parts<Space>::Second>();
  }
}

/// How many rotations a point has.
template <class Space>
constexpr int rotations_in() {
  if constexpr (std::is_same_v<Space, VectorSpace>) {
    return 0;
  } else if constexpr (std::is_same_v<Space, RotationSpace>) {
    return 1;
  } else {
    return rotations_in<typename Parts<Space>::First>() + rotations_in<typename Parts<Space>::Second>();
  }
}

template <class Space>
Ends<typename Parts<Space>::First> first_of(const Ends<Space>& ends) {
  using P = Parts<Space>;
  const Eigen::Index n = dimension_of<typename P::First>(P::first(ends.start));
  return {P::first(ends.start),   P::first(ends.goal),
          ends.z.head(n),         ends.displacement.head(n),
          ends.amplitude.head(n), rotations_in<typename P::First>() > 0 ? ends.reference : RowMatrix()};
}
template <class Space>
Ends<typename Parts<Space>::Second> second_of(const Ends<Space>& ends) {
  using P = Parts<Space>;
  const Eigen::Index n = dimension_of<typename P::Second>(P::second(ends.start));
  return {P::second(ends.start),  P::second(ends.goal),
          ends.z.tail(n),         ends.displacement.tail(n),
          ends.amplitude.tail(n), rotations_in<typename P::Second>() > 0 ? ends.reference : RowMatrix()};
}
template <class Space>
Ends<Space> joined(const Ends<typename Parts<Space>::First>& first,
                   const Ends<typename Parts<Space>::Second>& second) {
  using P = Parts<Space>;
  const auto side_by_side = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    Eigen::VectorXd both(a.size() + b.size());
    both << a, b;
    return both;
  };
  return {P::join(first.start, second.start),
          P::join(first.goal, second.goal),
          side_by_side(first.z, second.z),
          side_by_side(first.displacement, second.displacement),
          side_by_side(first.amplitude, second.amplitude),
          first.reference.rows() > 0 ? first.reference : second.reference};
}

}  // namespace dmp::detail
