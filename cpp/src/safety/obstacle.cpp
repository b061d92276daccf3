#include <dmp/error.hpp>
#include <dmp/obstacle.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "geometry/pose.hpp"
#include "safety/approach.hpp"

namespace dmp {
namespace {

using Eigen::Vector3d;

/// The nearest point of a shape, but for its radius: the way from there and the directions in which the
/// surface bends.
struct Foot {
  double distance;
  Vector3d normal;
  double radius_of_curvature = 0.0;  ///< from the centre of curvature to the point; 0 where nothing bends
  Eigen::Matrix3d bending = Eigen::Matrix3d::Zero();  ///< projector on the directions that bend
};

Foot around(const Vector3d& from_center, double radius, const Eigen::Matrix3d& bending,
            const Vector3d& any_way_out) noexcept {
  const double length = from_center.norm();
  if (length < 1e-12) return {-radius, any_way_out};
  return {length - radius, from_center / length, length, bending};
}

Foot foot(const Sphere& sphere, const Vector3d& point) noexcept {
  return around(point - sphere.center, sphere.radius, Eigen::Matrix3d::Identity(), Vector3d::UnitZ());
}

Foot foot(const Capsule& capsule, const Vector3d& point) noexcept {
  const Vector3d axis = capsule.end - capsule.start;
  const double length2 = axis.squaredNorm();
  const double share = length2 > 0.0 ? (point - capsule.start).dot(axis) / length2 : 0.0;
  const double along = std::clamp(share, 0.0, 1.0);
  Eigen::Matrix3d bending = Eigen::Matrix3d::Identity();
  if (along == share && length2 > 0.0) bending -= axis * axis.transpose() / length2;
  return around(point - capsule.start - along * axis, capsule.radius, bending, axis.unitOrthogonal());
}

Foot foot(const Box& box, const Vector3d& point) noexcept {
  const Eigen::Matrix3d rotation = box.pose.topLeftCorner<3, 3>();
  const Vector3d local = rotation.transpose() * (point - box.pose.topRightCorner<3, 1>());
  const Vector3d beyond = local.cwiseAbs() - box.half_sizes;
  Eigen::Index nearest = 0;
  const double inside = beyond.maxCoeff(&nearest);
  if (inside <= 0.0) {  // behind a face
    const double side = local[nearest] < 0.0 ? -1.0 : 1.0;
    return {inside, side * rotation.col(nearest)};
  }
  const Vector3d out = beyond.cwiseMax(0.0);
  const double distance = out.norm();
  const Vector3d signs = local.cwiseSign();
  const Vector3d normal = rotation * (signs.cwiseProduct(out) / distance);
  const Vector3d bends = (out.array() > 0.0).cast<double>().matrix();
  if (bends.sum() < 1.5) return {distance, normal};  // before a face
  return {distance, normal, distance, rotation * bends.asDiagonal() * rotation.transpose()};
}

Foot foot(const Plane& plane, const Vector3d& point) noexcept {
  const Vector3d normal = plane.normal.normalized();
  return {normal.dot(point - plane.point), normal};
}

void shift(Sphere& sphere, const Vector3d& by) noexcept { sphere.center += by; }
void shift(Box& box, const Vector3d& by) noexcept { box.pose.topRightCorner<3, 1>() += by; }
void shift(Plane& plane, const Vector3d& by) noexcept { plane.point += by; }
void shift(Capsule& capsule, const Vector3d& by) noexcept {
  capsule.start += by;
  capsule.end += by;
}

/// Lengths that are none of a robot's would overflow in their squares.
constexpr double kFar = 1e9;
bool are_near(const Vector3d& values) noexcept { return (values.array().abs() <= kFar).all(); }
bool is_radius(double radius) noexcept { return radius >= 0.0 && radius <= kFar; }

/// Calls refuse(field, expected) for the first field that cannot be used.
template <class Refuse>
bool check(const Sphere& s, Refuse refuse) {
  if (!are_near(s.center)) return refuse("center", "three numbers in m, none beyond 1e9");
  if (!is_radius(s.radius)) return refuse("radius", "a length in m, 0 to 1e9");
  return true;
}
template <class Refuse>
bool check(const Box& b, Refuse refuse) {
  if (!(detail::is_pose(b.pose) && are_near(b.pose.topRightCorner<3, 1>())))
    return refuse("pose", "[R p; 0 1] with a rotation R");
  if (!((b.half_sizes.array() >= 0.0).all() && are_near(b.half_sizes)))
    return refuse("half_sizes", "three lengths in m, 0 to 1e9");
  return true;
}
template <class Refuse>
bool check(const Capsule& c, Refuse refuse) {
  if (!are_near(c.start)) return refuse("start", "three numbers in m, none beyond 1e9");
  if (!are_near(c.end)) return refuse("end", "three numbers in m, none beyond 1e9");
  if (!is_radius(c.radius)) return refuse("radius", "a length in m, 0 to 1e9");
  return true;
}
template <class Refuse>
bool check(const Plane& p, Refuse refuse) {
  if (!are_near(p.point)) return refuse("point", "three numbers in m, none beyond 1e9");
  if (!(are_near(p.normal) && p.normal.norm() > 1e-9)) return refuse("normal", "a direction, not 0 0 0");
  return true;
}
template <class Refuse>
bool check_all(const Obstacle& obstacle, Refuse refuse) {
  return std::visit(
      [&](const auto& shape) {
        if (!are_near(shape.velocity)) return refuse("velocity", "three numbers in m/s, none beyond 1e9");
        return check(shape, refuse);
      },
      obstacle);
}

}  // namespace

Nearness nearness(const Obstacle& obstacle, const Vector3d& point) noexcept {
  const Foot found = std::visit([&](const auto& shape) noexcept { return foot(shape, point); }, obstacle);
  return {found.distance, found.normal};
}

void require_obstacle(const Obstacle& obstacle, const char* name) {
  check_all(obstacle, [&](const char* field, const char* expected) -> bool {
    throw InvalidArgument(std::string(name) + "." + field + ": expected " + expected + ".");
  });
}

bool is_obstacle(const Obstacle& obstacle) noexcept {
  return check_all(obstacle, [](const char*, const char*) noexcept { return false; });
}

namespace detail {

Approach approach(const Obstacle& obstacle, const Vector3d& point, const Vector3d& velocity) noexcept {
  const Foot found = std::visit([&](const auto& shape) noexcept { return foot(shape, point); }, obstacle);
  const Vector3d relative = velocity - velocity_of(obstacle);
  const double out = found.normal.dot(relative);
  double bend = 0.0;
  if (found.radius_of_curvature > 0.0)
    bend = std::max(0.0, (found.bending * relative).squaredNorm() - out * out) / found.radius_of_curvature;
  return {{found.distance, found.normal}, -out, bend};
}

const Vector3d& velocity_of(const Obstacle& obstacle) noexcept {
  return std::visit([](const auto& shape) noexcept -> const Vector3d& { return shape.velocity; }, obstacle);
}

void move_on(Obstacle& obstacle, double seconds) noexcept {
  std::visit([&](auto& shape) noexcept { shift(shape, seconds * shape.velocity); }, obstacle);
}

}  // namespace detail
}  // namespace dmp
