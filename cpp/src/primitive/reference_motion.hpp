#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "geometry/pose.hpp"
#include "primitive/offset_space.hpp"
#include "primitive/space.hpp"

namespace dmp::detail {

/// A motion at one moment.
template <class Space>
struct Moment {
  using P = Parts<Space>;
  Moment<typename P::First> first;
  Moment<typename P::Second> second;

  typename Space::Output view() const { return {first.view(), second.view()}; }
  void displace(const Shift& by) {
    first.displace(by);
    second.displace(by.from(OffsetIn<typename P::First>::axes(first.view())));
  }
  /// In another unit of time: velocities times `rate`.
  void quicken(double rate) {
    first.quicken(rate);
    second.quicken(rate);
  }
};

template <>
struct Moment<VectorSpace> {
  VectorSpace::Outputs outputs;
  VectorSpace::Output view() const { return outputs; }
  void displace(const Shift& by) { OffsetIn<VectorSpace>::displace(outputs, by); }
  void quicken(double rate) {
    outputs.velocity *= rate;
    outputs.acceleration *= rate * rate;
  }
};

template <>
struct Moment<RotationSpace> {
  RotationSpace::Outputs outputs;
  RotationSpace::Output view() const { return outputs; }
  void displace(const Shift& by) { OffsetIn<RotationSpace>::displace(outputs, by); }
  void quicken(double rate) {
    outputs.angular_velocity *= rate;
    outputs.angular_acceleration *= rate * rate;
  }
};

inline std::vector<Moment<VectorSpace>> moments_of(const Demonstration& motion, const Eigen::VectorXd& times,
                                                   VectorSpace*) {
  const Trajectory found = motion.at(times);
  std::vector<Moment<VectorSpace>> moments;
  for (Eigen::Index k = 0; k < times.size(); ++k)
    moments.push_back({{found.position.row(k), found.velocity.row(k), found.acceleration.row(k)}});
  return moments;
}

inline std::vector<Moment<RotationSpace>> moments_of(const OrientationDemonstration& motion,
                                                     const Eigen::VectorXd& times, RotationSpace*) {
  const OrientationTrajectory found = motion.at(times);
  std::vector<Moment<RotationSpace>> moments;
  for (Eigen::Index k = 0; k < times.size(); ++k)
    moments.push_back({{unit_quaternion(found.rotation[static_cast<std::size_t>(k)]),
                        found.angular_velocity.row(k), found.angular_acceleration.row(k)}});
  return moments;
}

/// Where a motion is at times, with velocities and accelerations.
template <class Space>
std::vector<Moment<Space>> moments_of(const typename Space::Demonstration& motion,
                                      const Eigen::VectorXd& times, Space*) {
  using P = Parts<Space>;
  auto first = moments_of(P::first(motion), times, static_cast<typename P::First*>(nullptr));
  auto second = moments_of(P::second(motion), times, static_cast<typename P::Second*>(nullptr));
  std::vector<Moment<Space>> moments;
  for (std::size_t k = 0; k < first.size(); ++k)
    moments.push_back({std::move(first[k]), std::move(second[k])});
  return moments;
}

/// Numbers of a point as a row of a table: vectors, and rotations as w x y z; -1: as many as there are.
template <class Space>
constexpr Eigen::Index fixed_columns() {
  if constexpr (std::is_same_v<Space, VectorSpace>) {
    return -1;
  } else if constexpr (std::is_same_v<Space, RotationSpace>) {
    return 4;
  } else if constexpr (std::is_same_v<Space, PoseSpace>) {
    return 7;
  } else {
    constexpr Eigen::Index first = fixed_columns<typename Parts<Space>::First>();
    constexpr Eigen::Index second = fixed_columns<typename Parts<Space>::Second>();
    return first < 0 || second < 0 ? -1 : first + second;
  }
}

template <class Space>
Eigen::VectorXd numbers_of(const typename Space::Point& point) {
  if constexpr (std::is_same_v<Space, VectorSpace>) {
    return point;
  } else if constexpr (std::is_same_v<Space, RotationSpace>) {
    const Eigen::Quaterniond q = unit_quaternion(point);
    return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  } else {
    using P = Parts<Space>;
    const Eigen::VectorXd first = numbers_of<typename P::First>(P::first(point));
    const Eigen::VectorXd second = numbers_of<typename P::Second>(P::second(point));
    Eigen::VectorXd both(first.size() + second.size());
    both << first, second;
    return both;
  }
}

template <class Space>
typename Space::Point point_from(const Eigen::VectorXd& numbers) {
  if constexpr (std::is_same_v<Space, VectorSpace>) {
    return numbers;
  } else if constexpr (std::is_same_v<Space, RotationSpace>) {
    return Eigen::Quaterniond(numbers[0], numbers[1], numbers[2], numbers[3]).normalized().toRotationMatrix();
  } else {
    using P = Parts<Space>;
    constexpr Eigen::Index second = fixed_columns<typename P::Second>();
    const Eigen::Index first = second >= 0 ? numbers.size() - second : fixed_columns<typename P::First>();
    return P::join(point_from<typename P::First>(numbers.head(first)),
                   point_from<typename P::Second>(numbers.tail(numbers.size() - first)));
  }
}

}  // namespace dmp::detail
