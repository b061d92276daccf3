// Two hands in one phase: a product that the library does not bring, compiled here from its parts.
#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/product.hpp>

#include "motions.hpp"
#include "primitive/instantiate.hpp"

namespace dmp {
using TwoPoses = Product<PoseSpace, PoseSpace>;
DMP_INSTANTIATE(TwoPoses);
}  // namespace dmp

using namespace dmp;
using namespace motions;

namespace {

using TwoPosesDmp = Primitive<TwoPoses>;

/// A minimum-jerk turn about z by `angle` while the position stays.
PoseDemonstration turning_by(double angle, int count = 200) {
  const Eigen::VectorXd t = grid(count, 2.0);
  Poses poses;
  for (int k = 0; k < count; ++k)
    poses.push_back(pose_of(so3::exp({0, 0, angle * minimum_jerk(t[k] / 2.0)}), {.4, t[k], .2}));
  return {t, poses};
}

DmpOptions few() {
  DmpOptions options;
  options.basis_count = 30;
  options.derivatives = Derivatives::interpolate;
  return options;
}

}  // namespace

TEST_CASE("two poses move as each does alone") {
  const TwoPoses::Demonstration both{turning_by(1.0), pose(200, 2.0)};
  DmpOptions options = few();
  options.orientation_form = OrientationForm::ude;
  const TwoPosesDmp model = TwoPosesDmp::fit(both, options);
  CHECK(model.dimension() == 12);
  TwoPoses::Point goal = model.goal();
  goal.second(1, 3) += 0.1;
  const auto motion = model.rollout(goal, 1.5);
  const auto first = PoseDmp::fit(both.first(), options).rollout(goal.first, 1.5);
  const auto second = PoseDmp::fit(both.second(), options).rollout(goal.second, 1.5);
  for (std::size_t k = 0; k < first.pose.size(); ++k) {
    REQUIRE((motion.first.pose[k] - first.pose[k]).norm() < 1e-10);
    REQUIRE((motion.second.pose[k] - second.pose[k]).norm() < 1e-10);
  }
}

TEST_CASE("where one of two poses turns far, both are learned in the log-linear form; none turns along") {
  const TwoPoses::Demonstration both{turning_by(0.5), turning_by(5.0)};
  const TwoPosesDmp model = TwoPosesDmp::fit(both, few());
  CHECK(model.options().orientation_form == OrientationForm::log_linear);
  CHECK(model.parameters().reference.size() == 0);
  CHECK(assess(model, {both}).rmse.maxCoeff() < 1e-3);

  DmpOptions turning = few();
  turning.orientation_form = OrientationForm::turning;
  CHECK_THROWS_WITH_AS(TwoPosesDmp::fit(both, turning), doctest::Contains("options.orientation_form"),
                       InvalidArgument);
  TwoPoses::Parameters parameters = model.parameters();
  parameters.options.orientation_form = OrientationForm::turning;
  CHECK_THROWS_WITH_AS(TwoPosesDmp{parameters}, doctest::Contains("reference: none"), InvalidArgument);
  parameters.reference = PoseDmp::fit(both.second(), few()).parameters().reference;
  CHECK_THROWS_WITH_AS(TwoPosesDmp{parameters}, doctest::Contains("reference: given"), InvalidArgument);
}
