// The nearest point that keeps rows and intervals, against what random search finds.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "safety/half_spaces.hpp"

using dmp::detail::AxisLimits;
using dmp::detail::HalfSpaces;
using dmp::detail::Interval;
using Eigen::Vector3d;

namespace {

struct Dice {
  std::mt19937 random{7};
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Vector3d vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
};

}  // namespace

TEST_CASE("no point that keeps all is nearer to what is wanted, within the intervals, than the one chosen") {
  Dice dice;
  for (int trial = 0; trial < 200; ++trial) {
    std::array<Interval, 3> box;
    for (Interval& interval : box) interval = {dice(-2, -0.2), dice(0.2, 2)};
    HalfSpaces spaces(box);
    const int rows = 1 + trial % 3;
    for (int j = 0; j < rows; ++j) REQUIRE(spaces.add(dice.vector(1.0).normalized(), dice(-0.8, 0.15)));
    const Vector3d wanted = spaces.clamped(dice.vector(3.0));
    const Vector3d chosen = spaces.nearest(wanted);
    Vector3d best = Vector3d::Constant(100);
    for (int k = 0; k < 5000; ++k) {
      const double near = k % 2 ? 3.0 : 0.05;
      const Vector3d x = spaces.clamped(k % 2 ? dice.vector(near) : Vector3d(chosen + dice.vector(near)));
      if (spaces.admits(x) && (x - wanted).norm() < (best - wanted).norm()) best = x;
    }
    if (best[0] > 50) continue;  // hardly a point keeps all
    CHECK(spaces.admits(chosen, 1e-3));
    CHECK((chosen - wanted).norm() <= (best - wanted).norm() + 1e-3);
  }
}

TEST_CASE("intervals are kept where rows cannot be, and what is wanted far outside does not change that") {
  HalfSpaces spaces({Interval{-1, 1}, Interval{-1, 1}, Interval{-1, 1}});
  REQUIRE(spaces.add(Vector3d::UnitX(), 5.0));
  CHECK(spaces.nearest(Vector3d::Zero()) == Vector3d(1, 0, 0));
  HalfSpaces reachable({Interval{-5, 5}, Interval{-5, 5}, Interval{-5, 5}});
  REQUIRE(reachable.add(-Vector3d::UnitX(), 2.2));
  const Vector3d chosen = reachable.nearest({1e4, 0.0, -1e4});
  CHECK(chosen[0] == doctest::Approx(-2.2).epsilon(1e-6));
  CHECK(chosen[2] == -5.0);
}

TEST_CASE("a row that does not bear on the axes, and one too many, are refused") {
  HalfSpaces spaces({Interval{-1, 1}, Interval{-1, 1}, Interval{0, 0}});
  CHECK(!spaces.add(Vector3d::Zero(), 1.0));
  for (int j = 0; j < HalfSpaces::kMost; ++j) CHECK(spaces.add(Vector3d::UnitY(), -1.0));
  CHECK(!spaces.add(Vector3d::UnitY(), -1.0));
}

TEST_CASE("of every viable acceleration a stop remains possible, with the next one too") {
  Dice dice;
  for (int trial = 0; trial < 500; ++trial) {
    const AxisLimits limits{-dice(0.1, 1), dice(0.1, 1), dice(0.2, 3), dice(0.5, 20)};
    const double longest = 0.01, dt = dice(1e-3, longest);
    double y = 0.0, v = 0.0;
    for (int k = 0; k < 400; ++k) {
      const Interval allowed = dmp::detail::viable(limits, y, v, dt, longest);
      CHECK(allowed.low <= allowed.high);
      CHECK(std::max(std::abs(allowed.low), std::abs(allowed.high)) <= limits.acceleration);
      const double a =
          dice(0, 1) < 0.7 ? (trial % 2 ? allowed.high : allowed.low) : dice(allowed.low, allowed.high);
      y += dt * (v + 0.5 * dt * a);
      v += dt * a;
      REQUIRE(y <= limits.upper + 1e-12);
      REQUIRE(y >= limits.lower - 1e-12);
      REQUIRE(std::abs(v) <= limits.velocity + 1e-12);
    }
  }
}
