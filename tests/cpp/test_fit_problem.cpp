#include <doctest/doctest.h>
#include <dmp/so3.hpp>

#include <cmath>
#include <random>

#include "arms.hpp"
#include "kinematics/bordered_band.hpp"
#include "kinematics/fit_problem.hpp"

using dmp::Arm;
using dmp::detail::BorderedBand;
using doctest::Approx;

namespace {

// A problem with everything in it, somewhere beside its optimum.
struct Problem {
  Arm arm = Arm::from_urdf(arms::seven_joints());
  dmp::detail::FitProblem problem;
  dmp::detail::FitState state;

  static dmp::detail::FitBounds bounds(const Arm& arm, bool tight) {
    dmp::detail::FitBounds bounds;
    const double size = tight ? 0.2 : 1.0;
    bounds.lower = size * arm.lower();
    bounds.upper = size * arm.upper();
    bounds.velocity = 0.3 * arm.velocity_limit();
    bounds.acceleration = 0.3 * arm.acceleration_limit();
    bounds.position_tolerance = 5e-3;
    bounds.angle_tolerance = 0.05;
    bounds.floor = 1.0;
    return bounds;
  }

  static std::vector<dmp::detail::Frame> targets(const Arm& arm) {
    std::vector<dmp::detail::Frame> frames;
    for (Eigen::Index k = 0; k < dmp::detail::FitProblem::samples_of(12); ++k) {
      const double t = static_cast<double>(k) / 27.0;
      const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(7, 0.1 + t, 0.5 - t);
      const Eigen::Matrix4d pose = arm.forward_kinematics(q);
      frames.push_back({pose.topLeftCorner<3, 3>(), pose.topRightCorner<3, 1>()});
    }
    return frames;
  }

  explicit Problem(const dmp::detail::Vector6& weight)
      : problem(arm.model(), arm.gravity(), dmp::detail::PoseGoal(weight, 1.0), bounds(arm, true),
                targets(arm), {Eigen::VectorXd::LinSpaced(28, 1.0, 1.4), Eigen::VectorXd::Constant(28, 0.2)},
                2.0, true) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    state.coefficients.resize(12, 7);
    for (Eigen::Index i = 0; i < state.coefficients.size(); ++i)
      state.coefficients.data()[i] = 0.3 * normal(random) + 0.3;
    state.position = problem.centre() + Eigen::Vector3d(0.01, -0.02, 0.01);
    state.yaw = 0.05;
    state.tool = dmp::so3::exp(Eigen::Vector3d(0.02, 0.03, -0.01));
  }
};

}  // namespace

TEST_CASE("The bordered band gives what a dense solver gives") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr Eigen::Index count = 20, below = 4, border = 3, all = count + border;
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(all, all);
  for (Eigen::Index i = 0; i < all; ++i)
    for (Eigen::Index j = 0; j < all; ++j)
      if ((i >= j && i - j <= below) || i >= count) root(i, j) = normal(random) + (i == j ? 5.0 : 0.0);
  const Eigen::MatrixXd dense = root * root.transpose();
  Eigen::VectorXd right(all);
  for (Eigen::Index i = 0; i < all; ++i) right[i] = normal(random);
  BorderedBand system(count, below, border);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index k = 0; k <= below && j + k < count; ++k) system.band(j, k) = dense(j + k, j);
  system.edge = dense.topRightCorner(count, border);
  system.corner = dense.bottomRightCorner(border, border);
  system.right = right.head(count);
  system.right_end = right.tail(border);
  Eigen::VectorXd x, y;
  REQUIRE(system.solve(0.1, x, y));
  Eigen::MatrixXd damped = dense;
  damped.diagonal() += 0.1 * (dense.diagonal().array() + 1e-6).matrix();
  const Eigen::VectorXd expected = damped.llt().solve(right);
  CHECK((x - expected.head(count)).norm() < 1e-10);
  CHECK((y - expected.tail(border)).norm() < 1e-10);
  system.band(3, 0) = -1.0;
  CHECK_FALSE(system.solve(0.1, x, y));
}

TEST_CASE("The normal equations hold the gradient of the cost, by finite differences") {
  dmp::detail::Vector6 whole = dmp::detail::Vector6::Ones(), position = whole;
  position.tail<3>().setZero();
  for (const auto& weight : {whole, position}) {
    Problem one(weight);
    BorderedBand system(12 * 7, 27, 7);
    dmp::detail::FitMeasure measure;
    const double cost = one.problem.evaluate(one.state, 0.9, measure, &system);
    CHECK(one.problem.evaluate(one.state, 0.9, measure, nullptr) == Approx(cost));
    REQUIRE(measure.outside > 0.0);
    REQUIRE(measure.below > 0.0);
    REQUIRE(measure.rate > 0.9);
    Eigen::VectorXd none = Eigen::VectorXd::Zero(84), still = Eigen::VectorXd::Zero(7);
    const double h = 1e-6;
    for (Eigen::Index i = 0; i < 84; i += 5) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(84, i);
      const double up =
          one.problem.evaluate(one.problem.moved(one.state, step, still), 0.9, measure, nullptr);
      const double down =
          one.problem.evaluate(one.problem.moved(one.state, -step, still), 0.9, measure, nullptr);
      CAPTURE(i);
      // The Jacobian of the logarithm is left out, as errors are small at the optimum: 2 % of the largest.
      CHECK(std::abs(-2.0 * system.right[i] - (up - down) / (2.0 * h)) <
            0.05 * system.right.cwiseAbs().maxCoeff());
    }
    for (Eigen::Index i = 0; i < 7; ++i) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(7, i);
      const double up = one.problem.evaluate(one.problem.moved(one.state, none, step), 0.9, measure, nullptr);
      const double down =
          one.problem.evaluate(one.problem.moved(one.state, none, -step), 0.9, measure, nullptr);
      CAPTURE(i);
      CHECK(std::abs(-2.0 * system.right_end[i] - (up - down) / (2.0 * h)) <
            0.1 * system.right_end.cwiseAbs().maxCoeff());
    }
  }
}
