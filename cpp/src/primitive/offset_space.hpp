#pragma once

#include <dmp/so3.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <type_traits>

#include "geometry/exponential_rates.hpp"
#include "geometry/pose.hpp"
#include "primitive/parts.hpp"

namespace dmp::detail {

/// An offset and its first two derivatives, the axes of all parts side by side.
struct Shift {
  const double* value;
  const double* rate;
  const double* second;
  Shift from(Eigen::Index axis) const noexcept { return {value + axis, rate + axis, second + axis}; }
};

/// What an offset means in a space: it is added to vectors, and turns rotations from the left (world frame).
template <class Space>
struct OffsetIn;

template <>
struct OffsetIn<VectorSpace> {
  using Outputs = VectorSpace::Outputs;

  static Eigen::Index axes(const Outputs& motion) noexcept { return motion.position.size(); }
  /// From where a motion is to `point`, on the branch nearest to `near`.
  static void between(const Outputs& motion, VectorSpace::PointArgument point, const double* /*near*/,
                      double* value) noexcept {
    for (Eigen::Index d = 0; d < point.size(); ++d) value[d] = point[d] - motion.position[d];
  }
  /// The rate of the offset with which its motion has `velocity`.
  static void rate(const Outputs& motion, const double* /*value*/, const double* velocity,
                   double* rate) noexcept {
    for (Eigen::Index d = 0; d < axes(motion); ++d) rate[d] = velocity[d] - motion.velocity[d];
  }
  /// And its second derivative, with which it has `acceleration`.
  static void second(const Outputs& motion, const double* /*value*/, const double* /*rate*/,
                     const double* acceleration, double* second) noexcept {
    for (Eigen::Index d = 0; d < axes(motion); ++d) second[d] = acceleration[d] - motion.acceleration[d];
  }
  static void displace(Outputs& motion, const Shift& by) noexcept {
    for (Eigen::Index d = 0; d < axes(motion); ++d) {
      motion.position[d] += by.value[d];
      motion.velocity[d] += by.rate[d];
      motion.acceleration[d] += by.second[d];
    }
  }
  static void point(const Outputs& motion, Eigen::VectorXd& point) noexcept { point = motion.position; }
  static void velocity(const Outputs& motion, double factor, double* out) noexcept {
    for (Eigen::Index d = 0; d < axes(motion); ++d) out[d] = factor * motion.velocity[d];
  }
  static void acceleration(const Outputs& motion, double* out) noexcept {
    for (Eigen::Index d = 0; d < axes(motion); ++d) out[d] = motion.acceleration[d];
  }
};

template <>
struct OffsetIn<RotationSpace> {
  using Outputs = RotationSpace::Outputs;
  using Vector = Eigen::Vector3d;

  static constexpr Eigen::Index axes(const Outputs&) noexcept { return 3; }
  static void between(const Outputs& motion, const Eigen::Matrix3d& point, const double* near,
                      double* value) noexcept {
    const Eigen::Quaterniond turn = unit_quaternion(point) * motion.quaternion.conjugate();
    Vector::Map(value) = so3::lifted_log(turn, Vector::Map(near));
  }
  static void rate(const Outputs& motion, const double* value, const double* velocity,
                   double* rate) noexcept {
    const Vector turned = so3::exp_quaternion(Vector::Map(value)) * motion.angular_velocity;
    Vector::Map(rate) = so3::left_jacobian_inverse(Vector::Map(value)) * (Vector::Map(velocity) - turned);
  }
  /// Of alpha_out = Exp(v) alpha + w x Exp(v) omega + J_l v'' + J_l' v', w = J_l v'.
  static void second(const Outputs& motion, const double* value, const double* rate,
                     const double* acceleration, double* second) noexcept {
    const Vector v = Vector::Map(value);
    const Eigen::Quaterniond turn = so3::exp_quaternion(v);
    const ExponentialRates rates(v, turn);
    const Vector along = turn * motion.angular_velocity;
    const Vector w = rates.velocity(Vector::Map(rate));
    const Vector rest = turn * motion.angular_acceleration + w.cross(along) +
                        rates.acceleration(Vector::Map(rate), Vector::Zero());
    Vector::Map(second) = so3::left_jacobian_inverse(v) * (Vector::Map(acceleration) - rest);
  }
  static void displace(Outputs& motion, const Shift& by) noexcept {
    const Vector v = Vector::Map(by.value);
    const Vector rate = Vector::Map(by.rate);
    const Eigen::Quaterniond turn = so3::exp_quaternion(v);
    const ExponentialRates rates(v, turn);
    const Vector along = turn * motion.angular_velocity;
    const Vector w = rates.velocity(rate);
    motion.angular_acceleration = turn * motion.angular_acceleration + w.cross(along) +
                                  rates.acceleration(rate, Vector::Map(by.second));
    motion.angular_velocity = along + w;
    motion.quaternion = turn * motion.quaternion;
  }
  static void point(const Outputs& motion, Eigen::Matrix3d& point) noexcept {
    point = motion.quaternion.toRotationMatrix();
  }
  static void velocity(const Outputs& motion, double factor, double* out) noexcept {
    Vector::Map(out) = factor * motion.angular_velocity;
  }
  static void acceleration(const Outputs& motion, double* out) noexcept {
    Vector::Map(out) = motion.angular_acceleration;
  }
};

/// Part by part.
template <class Space>
struct OffsetIn {
  using P = Parts<Space>;
  using First = OffsetIn<typename P::First>;
  using Second = OffsetIn<typename P::Second>;
  using Output = typename Space::Output;

  static Eigen::Index axes(const Output& motion) noexcept {
    return First::axes(motion.first) + Second::axes(motion.second);
  }
  static void between(const Output& motion, const typename Space::Point& point, const double* near,
                      double* value) noexcept {
    const Eigen::Index n = First::axes(motion.first);
    First::between(motion.first, P::first(point), near, value);
    Second::between(motion.second, P::second(point), near + n, value + n);
  }
  static void rate(const Output& motion, const double* value, const double* velocity, double* rate) noexcept {
    const Eigen::Index n = First::axes(motion.first);
    First::rate(motion.first, value, velocity, rate);
    Second::rate(motion.second, value + n, velocity + n, rate + n);
  }
  static void second(const Output& motion, const double* value, const double* rate,
                     const double* acceleration, double* second) noexcept {
    const Eigen::Index n = First::axes(motion.first);
    First::second(motion.first, value, rate, acceleration, second);
    Second::second(motion.second, value + n, rate + n, acceleration + n, second + n);
  }
  static void velocity(const Output& motion, double factor, double* out) noexcept {
    First::velocity(motion.first, factor, out);
    Second::velocity(motion.second, factor, out + First::axes(motion.first));
  }
  static void acceleration(const Output& motion, double* out) noexcept {
    First::acceleration(motion.first, out);
    Second::acceleration(motion.second, out + First::axes(motion.first));
  }
  static void point(const Output& motion, typename Space::Point& point) noexcept {
    if constexpr (std::is_same_v<Space, PoseSpace>) {
      point = pose_in(motion);
    } else {
      First::point(motion.first, point.first);
      Second::point(motion.second, point.second);
    }
  }
};

}  // namespace dmp::detail
