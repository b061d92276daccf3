#include <doctest/doctest.h>
#include <dmp/average.hpp>
#include <dmp/error.hpp>

#include "motions.hpp"

using namespace dmp;
using namespace motions;

TEST_CASE("averaging models is learning the demonstrations together, where scales agree") {
  const Demonstration a = helix(300, 2.0, .1, .2, 1.5);
  RowMatrix other = a.position();
  for (Eigen::Index k = 0; k < other.rows(); ++k) other(k, 0) += .02 * std::sin(3 * a.time()[k]);
  const Demonstration b(a.time(), other);
  const Dmp mean = average(std::vector<Dmp>{Dmp::fit(a, stated()), Dmp::fit(b, stated())});
  const Dmp joint = Dmp::fit(std::vector<Demonstration>{a, b}, stated());
  CHECK((mean.parameters().weights - joint.parameters().weights).norm() <
        1e-9 * joint.parameters().weights.norm());
  CHECK(largest(mean.rollout({}, {}, .01).position, joint.rollout({}, {}, .01).position) < 1e-12);
}

TEST_CASE("orientations and poses average on SO(3)") {
  const PoseDemonstration demonstration = pose(300, 2.0);
  const PoseDmp one = PoseDmp::fit(demonstration);
  const PoseDmp mean = average(std::vector<PoseDmp>{one, one, one});
  CHECK((mean.rollout({}, {}, .01).pose.back() - one.rollout({}, {}, .01).pose.back()).norm() < 1e-12);
  const OrientationDmp turn = OrientationDmp::fit(demonstration.orientation());
  CHECK(so3::distance(average(std::vector<OrientationDmp>{turn, turn}).goal(), turn.goal()) < 1e-12);
}

TEST_CASE("models that are not alike are refused with the option that differs") {
  const Demonstration a = reach(100, 1.0);
  DmpOptions other;
  other.alpha = 30.0;
  CHECK_THROWS_WITH_AS(average(std::vector<Dmp>{Dmp::fit(a), Dmp::fit(a, other)}),
                       doctest::Contains("models[1]: options.alpha is 30"), InvalidArgument);
  CHECK_THROWS_AS(average(std::vector<Dmp>{}), InvalidArgument);
  const Demonstration flat(a.time(), a.position().leftCols(2));
  CHECK_THROWS_AS(average(std::vector<Dmp>{Dmp::fit(a), Dmp::fit(flat)}), InvalidArgument);
}

TEST_CASE(
    "orientations and poses that are not alike are refused with the option that differs, or none at all") {
  const PoseDemonstration demonstration = pose(100, 1.0);
  DmpOptions other;
  other.alpha_x = 3.0;
  const auto turn = [&](const DmpOptions& options) {
    return OrientationDmp::fit(demonstration.orientation(), options);
  };
  const auto both = [&](const DmpOptions& options) { return PoseDmp::fit(demonstration, options); };
  CHECK_THROWS_WITH_AS(average(std::vector<OrientationDmp>{turn({}), turn(other)}),
                       doctest::Contains("models[1]: options."), InvalidArgument);
  CHECK_THROWS_WITH_AS(average(std::vector<PoseDmp>{both({}), both({}), both(other)}),
                       doctest::Contains("models[2]: options."), InvalidArgument);
  CHECK_THROWS_WITH_AS(average(std::vector<OrientationDmp>{}), doctest::Contains("models: none"),
                       InvalidArgument);
  CHECK_THROWS_WITH_AS(average(std::vector<PoseDmp>{}), doctest::Contains("models: none"), InvalidArgument);
}

TEST_CASE("how the weights were found, and in which kernels, may differ: the mean has those of the finest") {
  const Demonstration a = helix(300, 2.0, .1, .2, 1.5);
  DmpOptions coarse = stated();
  coarse.basis_count = 60;
  DmpOptions fine = stated();
  fine.regression = Regression::ridge;
  fine.derivatives = Derivatives::smooth;
  const Dmp one = Dmp::fit(a, coarse);
  const Dmp other = Dmp::fit(a, fine);
  for (const Dmp& mean : {average(std::vector<Dmp>{one, other}), average(std::vector<Dmp>{other, one})}) {
    CHECK(mean.options().basis_count == 100);
    CHECK(mean.options().overlap == other.options().overlap);
    const RowMatrix middle = .5 * (one.rollout({}, {}, .01).position + other.rollout({}, {}, .01).position);
    CHECK(largest(mean.rollout({}, {}, .01).position, middle) < 1e-6);
    const Eigen::VectorXd aside = a.position().row(299).transpose() + Eigen::Vector3d(.05, .05, 0);
    const RowMatrix led =
        .5 * (one.rollout(aside, {}, .01).position + other.rollout(aside, {}, .01).position);
    CHECK(largest(mean.rollout(aside, {}, .01).position, led) < 1e-4);
  }
}
