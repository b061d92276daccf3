// The filter of the goal: exponential, and at rest once what is left is rounding.
#include "primitive/goal_filter.hpp"

#include <doctest/doctest.h>

#include <cmath>

using dmp::detail::GoalFilter;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

int steps_to_settle(GoalFilter<VectorXd>& filter, double step, int most) {
  int steps = 0;
  while (!filter.settled() && steps < most) {
    filter.advance(filter.left_after(step));
    filter.settle();
    ++steps;
  }
  return steps;
}

}  // namespace

TEST_CASE("the goal approaches its target as exp(-rate s)") {
  GoalFilter<VectorXd> filter(25.0, Vector3d(1, 2, 3));
  filter.set(VectorXd(Vector3d(2, 0, 3)));
  for (int i = 0; i < 100; ++i) filter.advance(filter.left_after(1e-3));
  const double left = std::exp(-2.5);
  CHECK((filter.goal() - Vector3d(2 - left, 2 * left, 3)).norm() < 1e-14);
}

TEST_CASE("it arrives after 36.8 / rate of the phase, however short the steps and wherever the target lies") {
  for (const double step : {5e-3, 1e-3, 1e-4, 1e-5}) {
    for (const Vector3d& target : {Vector3d(1, 2, 3), Vector3d(0, 0, 0), Vector3d(1e9, -1e-9, 0)}) {
      GoalFilter<VectorXd> filter(25.0, Vector3d(0.3, 0, -7));
      filter.set(VectorXd(target));
      const int most = static_cast<int>(std::ceil(std::log(1e16) / 25.0 / step)) + 1;
      CHECK(steps_to_settle(filter, step, 2 * most) <= most);
      CHECK(filter.goal() == target);
    }
  }
}

TEST_CASE("the target that is approached already, set again and again, delays nothing") {
  GoalFilter<VectorXd> once(25.0, VectorXd::Zero(1)), streamed(25.0, VectorXd::Zero(1));
  const VectorXd target = VectorXd::Ones(1);
  once.set(target);
  for (int i = 0; i < 2000; ++i) {
    streamed.set(target);
    for (GoalFilter<VectorXd>* filter : {&once, &streamed}) {
      filter->advance(filter->left_after(1e-3));
      filter->settle();
    }
    CHECK(once.goal() == streamed.goal());
  }
  CHECK(streamed.settled());
  streamed.set(target);
  CHECK(streamed.settled());
}

TEST_CASE("another target on the way is approached from where the goal is") {
  GoalFilter<VectorXd> filter(10.0, VectorXd::Zero(1));
  filter.set(VectorXd(VectorXd::Ones(1)));
  filter.advance(0.5);
  CHECK(filter.goal()[0] == 0.5);
  filter.set(VectorXd(VectorXd::Zero(1)));
  CHECK(filter.goal()[0] == 0.5);
  filter.advance(0.5);
  CHECK(filter.goal()[0] == 0.25);
}

TEST_CASE("rate 0 jumps") {
  GoalFilter<VectorXd> filter(0.0, VectorXd::Zero(2));
  filter.set(VectorXd(VectorXd::Ones(2)));
  CHECK(filter.settled());
  CHECK(filter.goal() == VectorXd::Ones(2));
}

TEST_CASE("a rotation takes the shortest way at an even rate and arrives exactly") {
  const Quaterniond from = Quaterniond::Identity(), target(Eigen::AngleAxisd(2.0, Vector3d::UnitY()));
  GoalFilter<Quaterniond> filter(25.0, from);
  filter.set(target);
  CHECK(filter.after(0.1).angularDistance(target) == doctest::Approx(2.0 * std::exp(-2.5)).epsilon(1e-12));
  for (int i = 0; i < 100; ++i) filter.advance(filter.left_after(1e-3));
  CHECK(filter.goal().angularDistance(target) == doctest::Approx(2.0 * std::exp(-2.5)).epsilon(1e-12));
  int steps = 100;
  for (; !filter.settle() && steps < 3000; ++steps) filter.advance(filter.left_after(1e-3));
  CHECK(steps < 1475);
  CHECK(filter.goal().coeffs() == target.coeffs());
}
