#include <doctest/doctest.h>
#include <dmp/reach_speed.hpp>

#include <cmath>
#include <random>

#include "arms.hpp"

using dmp::Arm;
using doctest::Approx;

TEST_CASE("Two links in the plane: stretched out, both joints at their limit") {
  const Arm arm = Arm::from_urdf(arms::two_link());  // 1 m each, 3 rad/s
  const dmp::TipSpeed speed = dmp::fastest_tip(arm);
  CHECK(speed.angular == Approx(6.0));               // both turn about z
  CHECK(speed.linear == Approx(9.0).epsilon(1e-3));  // 2 m x 3 rad/s + 1 m x 3 rad/s
  CHECK(speed.linear <= 9.0 + 1e-12);
}

TEST_CASE("No joint velocity in any posture moves the tip faster, and the numbers repeat") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  const dmp::TipSpeed speed = dmp::fastest_tip(arm);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double linear = 0.0, angular = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::MatrixXd jacobian = arm.jacobian(arms::random_joints(arm, random));
    Eigen::VectorXd v = arm.velocity_limit();
    for (Eigen::Index j = 0; j < v.size(); ++j) v[j] = std::copysign(v[j], unit(random));
    linear = std::max(linear, (jacobian * v).head<3>().norm());
    angular = std::max(angular, (jacobian * v).tail<3>().norm());
  }
  CHECK(linear <= speed.linear);
  CHECK(angular <= speed.angular);
  CHECK(speed.linear < 1.5 * linear);
  CHECK(speed.angular < 1.5 * angular);
  CHECK(dmp::fastest_tip(arm).linear == speed.linear);
}

TEST_CASE("Without velocity limits there is no largest speed") {
  dmp::LimitOverrides none;
  none.velocity = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  CHECK(std::isinf(dmp::fastest_tip(Arm::from_urdf(arms::two_link()).with_limits(none)).linear));
}
