#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/spread.hpp>

#include <random>

#include "motions.hpp"

using namespace dmp;
using namespace motions;

TEST_CASE("demonstrations of any duration are compared at equal phase") {
  std::vector<Demonstration> demonstrations;
  for (const double duration : {1.0, 2.0, 5.0}) demonstrations.push_back(reach(200, duration));
  const Spread found = spread(demonstrations, 21);
  CHECK((found.mean.row(10) - 0.5 * Eigen::RowVector3d(.3, -.2, .4)).norm() < 1e-9);
  for (const auto& covariance : found.covariance) CHECK(covariance.norm() < 1e-15);
}

TEST_CASE("the covariance is that of the shifts between them") {
  const Demonstration middle = reach(200, 1.0);
  std::vector<Demonstration> demonstrations;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  RowMatrix shifts(400, 3);
  for (int j = 0; j < 400; ++j) {
    const Eigen::RowVector3d shift(.01 * normal(random), .02 * normal(random), 0.0);
    shifts.row(j) = shift;
    demonstrations.emplace_back(middle.time(), middle.position().rowwise() + shift);
  }
  const RowMatrix centred = shifts.rowwise() - shifts.colwise().mean();
  const Eigen::MatrixXd expected = centred.transpose() * centred / 399.0;
  for (const auto& covariance : spread(demonstrations, 5).covariance)
    CHECK((covariance - expected).norm() < 1e-9);
}

TEST_CASE("poses spread in position and rotation") {
  const PoseDemonstration one = pose(200, 1.0);
  Poses turned = one.pose();
  const Eigen::Matrix3d turn = so3::exp({0, 0, .2});
  for (auto& p : turned) p.topLeftCorner<3, 3>() = turn * p.topLeftCorner<3, 3>();
  const PoseSpread found =
      spread(std::vector<PoseDemonstration>{one, PoseDemonstration(one.time(), turned)}, 5);
  for (const auto& covariance : found.covariance) {
    CHECK(covariance(5, 5) == doctest::Approx(2 * .1 * .1).epsilon(1e-6));
    CHECK(covariance.topLeftCorner(5, 5).norm() < 1e-9);
  }
}

TEST_CASE("one demonstration has no spread, none is refused") {
  CHECK(spread(std::vector<Demonstration>{reach(50, 1.0)}, 3).covariance[1].norm() == 0.0);
  CHECK_THROWS_AS(spread(std::vector<Demonstration>{}), InvalidArgument);
  CHECK_THROWS_AS(spread(std::vector<Demonstration>{reach(50, 1.0)}, 1), InvalidArgument);
}
