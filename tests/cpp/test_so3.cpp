#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <cmath>
#include <random>

using namespace dmp;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
const double kPi = std::acos(-1.0);

Vector3d random_axis(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}
}  // namespace

TEST_CASE("hat is the cross product, vee its inverse") {
  const Vector3d a(.3, -.5, .8);
  const Vector3d b(-1., 2., .4);
  CHECK((so3::hat(a) * b - a.cross(b)).norm() == 0.0);
  CHECK((so3::hat(a) + so3::hat(a).transpose()).norm() == 0.0);
  CHECK(so3::vee(so3::hat(a)) == a);
}

TEST_CASE("exp is a rotation by |v| about v at every angle") {
  std::mt19937 random(1);
  for (const double angle : {0.0, 1e-300, 1e-12, 1e-4, 0.2499, 0.2501, 1.0, kPi, 4.0, 2 * kPi, 40.0}) {
    const Vector3d axis = random_axis(random);
    const Matrix3d r = so3::exp(angle * axis);
    CHECK((r * r.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 2e-15);
    CHECK((r * axis - axis).norm() < 2e-15 * (1 + angle));
    CHECK((r - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).cwiseAbs().maxCoeff() <
          1e-15 * (1 + angle));
  }
}

TEST_CASE("log(exp(v)) = v from 1e-300 to pi") {
  std::mt19937 random(2);
  for (const double angle :
       {1e-300, 1e-20, 1e-12, 1e-8, 1e-4, .1, 1., 2., 3., kPi - 1e-1, kPi - 1e-6, kPi - 1e-12, kPi - 1e-15})
    for (int i = 0; i < 30; ++i) {
      const Vector3d v = angle * random_axis(random);
      const Vector3d back = so3::log(so3::exp(v));
      CHECK((back - v).cwiseAbs().maxCoeff() < 2.5e-15 * std::max(angle, 1e-300));
    }
}

TEST_CASE("at pi the logarithm has the right axis and a fixed sign") {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Vector3d axis = random_axis(random);
    const Matrix3d r = 2 * axis * axis.transpose() - Matrix3d::Identity();
    const Vector3d v = so3::log(r);
    CHECK(std::abs(v.norm() - kPi) < 1e-14);
    CHECK(v.cross(axis).norm() < 1e-14);
  }
  CHECK(so3::log(Eigen::Quaterniond(0, -1, 0, 0)).x() > 0.0);
  CHECK(so3::log(Eigen::Quaterniond(0, 0, -1, 2)).y() > 0.0);
}

TEST_CASE("a quaternion and its negative have one logarithm, whatever their length") {
  const Eigen::Quaterniond q(.3, -.4, .1, .8);
  const Eigen::Quaterniond negative(-.6, .8, -.2, -1.6);
  CHECK((so3::log(q) - so3::log(negative)).norm() < 1e-15);
}

TEST_CASE("the lifted logarithm goes on through pi and 2 pi") {
  const Vector3d axis = Vector3d(1, 2, 2) / 3;
  Vector3d previous = Vector3d::Zero();
  for (double angle = 0.0; angle < 4.5 * kPi; angle += 0.1) {
    previous = so3::lifted_log(so3::exp_quaternion(angle * axis), previous);
    CHECK((previous - angle * axis).norm() < 1e-13);
  }
}

TEST_CASE("next to a whole turn the lifted logarithm keeps the axis that rounding has lost") {
  const Vector3d axis = Vector3d(1, -2, 2) / 3;
  for (const int turns : {-2, -1, 1, 2, 7})
    for (const double beside : {-9e-4, -1e-9, 0.0, 1e-6, 9e-4}) {
      const Vector3d v = (2 * kPi * turns + beside) * axis;
      const Vector3d previous = v + 0.01 * Vector3d(1, 1, -1);
      CHECK((so3::exp(so3::lifted_log(so3::exp_quaternion(v), previous)) - so3::exp(v)).norm() < 1e-4);
      CHECK((so3::lifted_log(so3::exp_quaternion(v), v) - v).norm() < 1e-13);
    }
  const Eigen::Quaterniond small = so3::exp_quaternion(5e-4 * axis);
  CHECK(so3::lifted_log(small, -3.1414 * axis) == so3::log(small));  // no whole turn away: the principal one
  CHECK((so3::lifted_log(small, -3.2 * axis) - (5e-4 - 2 * kPi) * axis).norm() < 1e-13);
}

TEST_CASE("quaternions of any length that a double holds have a logarithm") {
  const Eigen::Quaterniond q = so3::exp_quaternion(Vector3d(.3, -.4, 1.2));
  for (const double length : {1e-300, 1e-150, 1.0, 1e150, 1e300})
    CHECK((so3::log(Eigen::Quaterniond(length * q.coeffs())) - Vector3d(.3, -.4, 1.2)).norm() < 1e-15);
}

TEST_CASE("the left Jacobian turns rates of the rotation vector into angular velocities") {
  std::mt19937 random(4);
  for (const double angle : {1e-9, 1e-3, .0499, .0501, 1., 3., 5.}) {
    const Vector3d v = angle * random_axis(random);
    const Vector3d rate = random_axis(random);
    const double h = 1e-6;
    const Matrix3d change = so3::exp(v + h * rate) * so3::exp(v - h * rate).transpose();
    CHECK((so3::left_jacobian(v) * rate - so3::log(change) / (2 * h)).norm() < 1e-9);
    CHECK((so3::left_jacobian(v) * so3::left_jacobian_inverse(v) - Matrix3d::Identity()).norm() < 1e-12);
  }
}

TEST_CASE("the left Jacobian of a vector too long to turn along is the projection onto it") {
  const Vector3d axis = Vector3d(2, -1, 2) / 3;
  for (const double length : {1e15, 0.99e20, 1.01e20, 1e200})
    CHECK((so3::left_jacobian(length * axis) - axis * axis.transpose()).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("Euler angles: the reference matrices of the source's product and of ZYX") {
  const Vector3d angles(.3, -.2, .5);
  Matrix3d source;
  source << .93629336358419924, .1683503012925674, .30824164767741602, -.28962947762551558,
      .86653410131815086, .40648913508618607, -.19866933079506122, -.46986894694951531, .86008933820504722;
  Matrix3d zyx;
  zyx << .93629336358419924, -.35033645881189415, -.024881779183339805, .28962947762551558,
      .81023918587025619, -.5095362866083979, .19866933079506122, .46986894694951531, .86008933820504722;
  CHECK((so3::from_euler(angles, "source") - source).cwiseAbs().maxCoeff() < 1e-15);
  CHECK((so3::from_euler(angles, "ZYX") - zyx).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(so3::distance(source, zyx) == doctest::Approx(1.2129063147412258).epsilon(1e-14));
}

TEST_CASE("to_euler inverts from_euler in every convention, at gimbal lock too") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  for (const char* convention :
       {"ZYX", "XYZ", "YXZ", "ZXZ", "ZYZ", "XZX", "zyx", "xyz", "yzx", "zxz", "xyx", "source"}) {
    for (int i = 0; i < 200; ++i) {
      Vector3d angles(angle(random), angle(random), angle(random));
      if (i % 10 == 0) angles[1] = kPi / 2;
      if (i % 10 == 1) angles[1] = 0.0;
      if (i % 10 == 2) angles[1] = -kPi / 2;
      const Matrix3d r = so3::from_euler(angles, convention);
      const Vector3d found = so3::to_euler(r, convention);
      CHECK_MESSAGE(so3::distance(so3::from_euler(found, convention), r) < 3e-7, convention);
      const double second = std::abs(found[1]);
      CHECK(second <= kPi + 1e-12);
    }
  }
}

TEST_CASE("Euler angles lie in their ranges, and at gimbal lock the third is zero") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  for (const char* convention : {"ZYX", "XYZ", "ZXZ", "XYX", "zyx", "xyz", "zxz", "source"}) {
    const bool proper = convention[0] == convention[2];
    for (int i = 0; i < 200; ++i) {
      const bool locked = i % 4 == 0;
      const double lock = proper ? (i % 8 == 0 ? 0.0 : kPi) : (i % 8 == 0 ? kPi / 2 : -kPi / 2);
      const Vector3d angles(angle(random), locked ? lock : angle(random), angle(random));
      const Vector3d found = so3::to_euler(so3::from_euler(angles, convention), convention);
      CAPTURE(convention);
      CAPTURE(angles.transpose());
      CHECK((found[0] > -kPi && found[0] <= kPi && found[2] > -kPi && found[2] <= kPi));
      CHECK((found[1] >= (proper ? 0.0 : -kPi / 2) && found[1] <= (proper ? kPi : kPi / 2)));
      if (locked) CHECK(std::abs(std::remainder(found[1] - lock, 2 * kPi)) < 1e-7);
    }
  }
  for (const char* convention : {"ZYX", "zyx", "ZXZ", "zxz"}) {
    const double lock = convention[0] == convention[2] ? 0.0 : kPi / 2;
    CHECK(so3::to_euler(so3::from_euler({0.4, lock, 0.0}, convention), convention)[2] ==
          doctest::Approx(0.0).epsilon(1e-7));
  }
}

TEST_CASE(
    "the nearest rotation is one, is itself for a rotation and the polar factor for what is not quite one") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-3e-4, 3e-4);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d exact = so3::exp(3.0 * random_axis(random));
    CHECK((so3::nearest_rotation(exact) - exact).cwiseAbs().maxCoeff() < 2e-15);
    const Matrix3d rough = exact + Matrix3d::NullaryExpr([&] { return noise(random); });
    REQUIRE(so3::is_rotation(rough));
    const Matrix3d found = so3::nearest_rotation(rough);
    CHECK((found.transpose() * found - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-15);
    const Matrix3d stretch = found.transpose() * rough;  // symmetric in a polar decomposition
    CHECK((stretch - stretch.transpose()).cwiseAbs().maxCoeff() < 1e-15);
  }
  CHECK_FALSE(so3::is_rotation(1.001 * Matrix3d::Identity()));
  CHECK(so3::is_rotation(1.0004 * Matrix3d::Identity()));
}

TEST_CASE("an unknown convention and a matrix that is no rotation are refused with a reason") {
  CHECK_THROWS_WITH_AS(so3::from_euler({0, 0, 0}, "ZZX"), doctest::Contains("'ZZX' is unknown"),
                       InvalidArgument);
  CHECK_THROWS_AS(so3::from_euler({0, 0, 0}, "ZyX"), InvalidArgument);
  CHECK_THROWS_AS(so3::from_euler({0, 0, NAN}, "ZYX"), InvalidArgument);
  const Matrix3d reflection = Vector3d(1, 1, -1).asDiagonal();
  CHECK_THROWS_WITH_AS(so3::require_rotation(reflection, "rotations[17]"),
                       "rotations[17]: det(R) = -1.000, expected +1 (a reflection). Check the axis order.",
                       InvalidArgument);
  CHECK_THROWS_AS(so3::require_rotation(1.01 * Matrix3d::Identity(), "r"), InvalidArgument);
  CHECK_THROWS_AS(so3::require_rotation(NAN * Matrix3d::Identity(), "r"), InvalidArgument);
}

TEST_CASE(
    "the mean of rotations about one axis turns by the mean of their angles; one alone is its own mean") {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -1).normalized();
  const Rotations both{so3::exp(0.2 * axis), so3::exp(1.0 * axis)};
  CHECK(so3::distance(so3::mean_rotation(both), so3::exp(0.6 * axis)) < 1e-15);
  CHECK(so3::mean_rotation({both[0]}) == both[0]);
  CHECK_THROWS_AS(so3::mean_rotation({}), InvalidArgument);
}
