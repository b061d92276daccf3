// What holds for every rotation, held against random ones: tiny, ordinary, near half a turn, and of many
// turns.
#include <doctest/doctest.h>
#include <dmp/so3.hpp>

#include <Eigen/Geometry>
#include <algorithm>

#include "cases.hpp"

using namespace dmp;
using cases::Random;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double kPi = 3.14159265358979323846;

double largest(const Matrix3d& m) { return m.cwiseAbs().maxCoeff(); }

/// A rotation vector of less than pi, in every regime of size.
Vector3d short_vector(Random& random) {
  const int regime = random.whole(0, 3);
  const double angle = regime == 0   ? random.magnitude(1e-300, 1e-3)
                       : regime == 1 ? kPi - random.magnitude(1e-6, 1e-1)
                                     : random.uniform(0.0, kPi - 1e-6);
  return angle * random.direction();
}

Vector3d long_vector(Random& random) { return random.uniform(0.0, 40.0) * random.direction(); }

Matrix3d rotation(Random& random) { return so3::exp(short_vector(random)); }

double from_whole_turns(double angle) { return std::abs(angle - 2 * kPi * std::round(angle / (2 * kPi))); }

}  // namespace

TEST_CASE("exp is a rotation, and its logarithm the vector it came from") {
  cases::each([](Random& random) {
    const Vector3d v = short_vector(random);
    const Matrix3d r = so3::exp(v);
    CHECK(largest(r * r.transpose() - Matrix3d::Identity()) < 4e-15);
    CHECK(r.determinant() > 0.0);
    CHECK((so3::log(r) - v).cwiseAbs().maxCoeff() <= 4e-15 * v.norm());
    CHECK(largest(so3::exp(-v) - r.transpose()) < 1e-15);
  });
}

TEST_CASE("the quaternion has length one, is the matrix, and has one logarithm with its negative") {
  cases::each([](Random& random) {
    const Vector3d v = random.coin() ? short_vector(random) : long_vector(random);
    const Quaterniond q = so3::exp_quaternion(v);
    CHECK(std::abs(q.norm() - 1.0) < 1e-15);
    CHECK(largest(q.toRotationMatrix() - so3::exp(v)) < 2e-15 * (1.0 + v.norm()));
    CHECK(so3::log(q) == so3::log(Quaterniond(-q.coeffs())));
    CHECK((so3::log(q) - so3::log(Quaterniond(random.magnitude(1e-100, 1e100) * q.coeffs()))).norm() < 2e-15);
  });
}

TEST_CASE(
    "the lifted logarithm is the vector itself, where one less than half a turn away was known before") {
  cases::each([](Random& random) {
    const Vector3d v = long_vector(random);
    const Vector3d before = v * (1.0 + random.uniform(-2.0, 2.0) / std::max(1.0, v.norm()));
    const Vector3d found = so3::lifted_log(so3::exp_quaternion(v), before);
    CHECK(largest(so3::exp(found) - so3::exp(v)) < 1e-13);
    if (from_whole_turns(v.norm()) > 1e-3) CHECK((found - v).norm() < 1e-10 * (1.0 + v.norm()));
  });
}

TEST_CASE("the Jacobian of the exponential has its identities") {
  cases::each([](Random& random) {
    const Vector3d v = random.coin() ? short_vector(random) : random.uniform(0.0, 6.0) * random.direction();
    const Matrix3d left = so3::left_jacobian(v);
    CHECK((left * v - v).norm() <= 4e-15 * v.norm());
    CHECK(largest(left - so3::left_jacobian(-v).transpose()) < 2e-15);
    CHECK(largest(left - so3::exp(v) * so3::left_jacobian(-v)) < 5e-15);
    CHECK(largest(left * so3::left_jacobian_inverse(v) - Matrix3d::Identity()) < 1e-12);
  });
}

TEST_CASE("the distance is a metric that no common rotation changes") {
  cases::each([](Random& random) {
    const Matrix3d a = rotation(random), b = rotation(random), c = rotation(random);
    const double ab = so3::distance(a, b);
    CHECK(so3::distance(b, a) == doctest::Approx(ab).epsilon(1e-14));
    CHECK(so3::distance(a, a) < 1e-15);
    CHECK(ab <= kPi);
    CHECK(so3::distance(a, c) <= ab + so3::distance(b, c) + 1e-14);
    CHECK(std::abs(so3::distance(c * a, c * b) - ab) < 1e-14);
    CHECK(std::abs(so3::distance(a * c, b * c) - ab) < 1e-14);
    CHECK(std::abs(so3::log(Matrix3d(b * a.transpose())).norm() - ab) < 1e-14);
  });
}

TEST_CASE("Euler angles of every convention are those of one rotation") {
  const char* const conventions[] = {"ZYX", "XYZ", "YXZ", "ZXZ", "ZYZ", "XZX",   "zyx",
                                     "xyz", "yzx", "zxz", "xyx", "YZX", "source"};
  cases::each([&](Random& random) {
    const char* convention = conventions[random.whole(0, 12)];
    CAPTURE(convention);
    const Matrix3d r = rotation(random);
    const Vector3d angles = so3::to_euler(r, convention);
    CHECK(so3::distance(so3::from_euler(angles, convention), r) < 3e-7);  // at gimbal lock; see the next line
    const bool proper = convention[0] == convention[2];
    const double middle = proper ? std::sin(angles[1]) : std::cos(angles[1]);
    if (std::abs(middle) > 1e-3) CHECK(so3::distance(so3::from_euler(angles, convention), r) < 1e-12);
  });
}

TEST_CASE("the nearest rotation of what is nearly one is one, and nearer than any other beside it") {
  cases::each([](Random& random) {
    const Matrix3d rough =
        rotation(random) + Matrix3d::NullaryExpr([&] { return random.uniform(-3e-4, 3e-4); });
    const Matrix3d found = so3::nearest_rotation(rough);
    CHECK(largest(found * found.transpose() - Matrix3d::Identity()) < 1e-15);
    const Matrix3d other = so3::exp(random.magnitude(1e-7, 1e-2) * random.direction()) * found;
    CHECK((rough - found).norm() <= (rough - other).norm());
  });
}
