#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/fit_report.hpp>

#include <random>

#include "motions.hpp"

using namespace dmp;
using namespace motions;

namespace {
Demonstration noisy_helix(double sigma, unsigned seed) {
  const Demonstration clean = helix(401, 2.0, .1, .4, 1.6);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, sigma);
  RowMatrix y = clean.position();
  for (Eigen::Index k = 0; k < y.size(); ++k) y.data()[k] += noise(random);
  return {clean.time(), y};
}
}  // namespace

TEST_CASE("a report has the errors of the rollout, axis by axis") {
  const Demonstration demonstration = helix(500, 2.0, .1, .2, 2);
  const Dmp dmp = Dmp::fit(demonstration);
  const RowMatrix away = dmp.rollout_at(demonstration.time()).position - demonstration.position();
  const FitReport report = assess(dmp, {demonstration});
  for (int d = 0; d < 3; ++d) {
    CHECK(report.rmse[d] == doctest::Approx(std::sqrt(away.col(d).squaredNorm() / 500)));
    CHECK(report.largest[d] == doctest::Approx(away.col(d).cwiseAbs().maxCoeff()));
  }
  CHECK(report.warnings.empty());
  CHECK(report.removed.norm() == 0.0);
}

TEST_CASE("the suggested number of kernels reaches the tolerance, half of it does not") {
  const Demonstration demonstration = helix(500, 2.0, .1, .2, 2);
  const int count = assess(Dmp::fit(demonstration), {demonstration}, {1e-4, 1e-3}).suggested_basis_count;
  const auto error = [&](int n) {
    DmpOptions options;
    options.basis_count = n;
    return rmse(Dmp::fit(demonstration, options).rollout_at(demonstration.time()).position,
                demonstration.position());
  };
  REQUIRE(count > 10);
  CHECK(error(count) <= 1e-4);
  CHECK(error(count / 2) > 1e-4);
}

TEST_CASE("the noise in the data is found, and smoothing tells what it took out") {
  const Demonstration noisy = noisy_helix(1e-3, 1);
  const FitReport plain = assess(Dmp::fit(noisy), {noisy}, {1e-5, 1e-3});
  for (int d = 0; d < 3; ++d) CHECK(plain.noise[d] == doctest::Approx(1e-3).epsilon(.15));
  DmpOptions smooth;
  smooth.derivatives = Derivatives::smooth;
  const FitReport report = assess(Dmp::fit(noisy, smooth), {noisy});
  for (int d = 0; d < 3; ++d) CHECK(report.removed[d] == doctest::Approx(1e-3).epsilon(.15));
}

TEST_CASE("smoothed, a noisy helix comes back closer to the truth than a third of its noise") {
  double squares = 0.0;
  const Demonstration truth = helix(401, 2.0, .1, .4, 1.6);
  DmpOptions smooth;
  smooth.derivatives = Derivatives::smooth;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const RowMatrix again = Dmp::fit(noisy_helix(1e-3, seed), smooth).rollout_at(truth.time()).position;
    squares += (again - truth.position()).squaredNorm() / static_cast<double>(3 * 401 * 20);
  }
  CHECK(std::sqrt(squares) < .33e-3);
}

TEST_CASE("smoothing leaves clean data as they are") {
  const Demonstration clean = helix(401, 2.0, .1, .4, 1.6);
  Smoothing report;
  CHECK(largest(clean.smoothed(&report).position(), clean.position()) < 1e-6);
  CHECK(report.noise.maxCoeff() < 1e-6);
}

TEST_CASE("how far an orientation turns and in which form it is learned") {
  const OrientationDemonstration near = rotation(300, 2.0, 1.0);
  const OrientationDemonstration far = rotation(1000, 10.0, 10.0);
  CHECK(OrientationDmp::fit(near).options().orientation_form == OrientationForm::ude);
  CHECK(OrientationDmp::fit(far).options().orientation_form == OrientationForm::turning);
  CHECK(assess(OrientationDmp::fit(near), {near}).largest_log < 1.5);
  CHECK(assess(OrientationDmp::fit(far), {far}).largest_log > 5.0);
}

TEST_CASE("two samples are a spring alone, and the report warns") {
  RowMatrix two(2, 1);
  two << 0.0, 1.0;
  const Demonstration demonstration(Eigen::Vector2d(0, 1), two);
  const Dmp dmp = Dmp::fit(demonstration);
  CHECK(dmp.parameters().weights.norm() == 0.0);
  CHECK(dmp.rollout_at(Eigen::VectorXd::Constant(1, .25)).position(0, 0) ==
        doctest::Approx(.8187601488034444).epsilon(1e-12));
  const FitReport report = assess(dmp, {demonstration});
  REQUIRE_FALSE(report.warnings.empty());
  CHECK(report.warnings[0].find("two samples") != std::string::npos);
}

TEST_CASE("the condition tells how the kernels overlap") {
  const Demonstration demonstration = reach(300, 1.0);
  DmpOptions ridge;
  ridge.regression = Regression::ridge;
  const double local = assess(Dmp::fit(demonstration, stated()), {demonstration}).condition;
  const double global = assess(Dmp::fit(demonstration, ridge), {demonstration}).condition;
  CHECK(local > 1.0);
  CHECK(local < 1e3);
  CHECK(global > 1e3 * local);
}

TEST_CASE(
    "a motion that ends near its start is learned under (goal - start) scaling with a warning, at its start "
    "not without a guard") {
  const Eigen::VectorXd t = grid(200, 1.0);
  DmpOptions options;
  options.scaling = Scaling::per_axis;
  const auto loop = [&](double gap) {
    return Demonstration(t, RowMatrix((2 * M_PI * t).array().sin() + gap * t.array()));
  };
  for (const bool guarded : {true, false}) {
    options.scaling_guard = guarded;
    const FitReport near = assess(Dmp::fit(loop(1e-4), options), {loop(1e-4)});
    REQUIRE(near.warnings.size() == 1);
    CHECK(near.warnings.back().find("scaling: axis 0") == 0);
    CHECK((near.warnings.back().find("advances") != std::string::npos) == guarded);
    CHECK(assess(Dmp::fit(loop(1.0), options), {loop(1.0)}).warnings.empty());
  }
  CHECK_THROWS_AS(Dmp::fit(loop(0.0), options), InvalidArgument);
}

TEST_CASE("a report sees scaled demonstrations as a run started at them does") {
  const Demonstration one = reach(300, 1.0);
  const Demonstration three(one.time(), RowMatrix(3.0 * one.position()));
  for (const Scaling scaling : {Scaling::per_axis, Scaling::per_axis_relative, Scaling::rotation_dilation}) {
    DmpOptions options;
    options.scaling = scaling;
    const std::vector<Demonstration> both{one, three};
    CHECK(assess(Dmp::fit(both, options), both).rmse.maxCoeff() < 1e-4);
  }
}

TEST_CASE("nothing to hold a model against is refused") {
  const Dmp dmp = Dmp::fit(reach(100, 1.0));
  CHECK_THROWS_AS(assess(dmp, {}), InvalidArgument);
  CHECK_THROWS_AS(assess(dmp, {Demonstration(grid(9, 1.0), RowMatrix::Zero(9, 2))}), InvalidArgument);
}

TEST_CASE("a report of poses is that of its positions beside that of its orientations") {
  const PoseDemonstration demonstration = pose(300, 2.0);
  const FitReport both = assess(PoseDmp::fit(demonstration, stated()), {demonstration});
  const FitReport position = assess(Dmp::fit(demonstration.position(), stated()), {demonstration.position()});
  const FitReport orientation =
      assess(OrientationDmp::fit(demonstration.orientation(), stated()), {demonstration.orientation()});
  REQUIRE(both.rmse.size() == 6);
  CHECK((both.rmse.head(3) - position.rmse).norm() < 1e-12);
  CHECK((both.rmse.tail(3) - orientation.rmse).norm() < 1e-12);
  CHECK((both.largest.tail(3) - orientation.largest).norm() < 1e-12);
  CHECK(both.largest_log == doctest::Approx(orientation.largest_log));
  CHECK(both.warnings.empty());
}

TEST_CASE(
    "the noise of orientations is found in rad about every axis, and smoothing tells what it took out") {
  const OrientationDemonstration clean = rotation(401, 2.0, 1.5);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 2e-3);
  Rotations shaken;
  Poses poses;
  for (const Eigen::Matrix3d& r : clean.rotation()) {
    shaken.push_back(so3::exp({noise(random), noise(random), noise(random)}) * r);
    poses.push_back(pose_of(shaken.back(), {noise(random), noise(random), noise(random)}));
  }
  const OrientationDemonstration noisy(clean.time(), shaken);
  DmpOptions smooth;
  smooth.derivatives = Derivatives::smooth;
  const FitReport report = assess(OrientationDmp::fit(noisy, smooth), {noisy});
  for (int d = 0; d < 3; ++d) {
    CHECK(report.noise[d] == doctest::Approx(2e-3).epsilon(.15));
    CHECK(report.removed[d] == doctest::Approx(2e-3).epsilon(.15));
  }
  const PoseDemonstration moved(clean.time(), poses);
  const FitReport both = assess(PoseDmp::fit(moved, smooth), {moved});
  for (int d = 0; d < 6; ++d) CHECK(both.removed[d] == doctest::Approx(2e-3).epsilon(.2));
}

TEST_CASE("each thing that spoils a model of orientations or poses is a warning that says what to do") {
  const auto warned = [](const FitReport& report, const std::string& of) {
    for (const std::string& warning : report.warnings)
      if (warning.rfind(of, 0) == 0) return true;
    return false;
  };
  DmpOptions few;
  few.basis_count = 4;
  const PoseDemonstration winding = pose(300, 2.0, 3);
  const FitReport coarse = assess(PoseDmp::fit(winding, few), {winding}, {1e-4, 1e-3});
  CHECK(warned(coarse, "rmse"));
  CHECK(coarse.suggested_basis_count > 4);
  const OrientationDemonstration turn = rotation(300, 2.0, 3.0);
  const FitReport unreachable = assess(OrientationDmp::fit(turn, few), {turn}, {1e-15, 1e-15});
  CHECK(unreachable.suggested_basis_count == 0);
  CHECK(warned(unreachable, "rmse"));
  CHECK(unreachable.warnings[0].find("More kernels do not help") != std::string::npos);

  const OrientationDemonstration around = [] {  // about one axis, nearly once around
    const Eigen::VectorXd t = grid(200, 1.0);
    Rotations r;
    for (const double u : t) r.push_back(so3::exp({0, 0, 1.97 * M_PI * minimum_jerk(u)}));
    return OrientationDemonstration(t, r);
  }();
  DmpOptions about_the_goal;
  about_the_goal.orientation_form = OrientationForm::log_linear;
  CHECK(warned(assess(OrientationDmp::fit(around, about_the_goal), {around}), "largest_log"));
  CHECK_FALSE(warned(assess(OrientationDmp::fit(around), {around}), "largest_log"));

  DmpOptions scaled;
  scaled.scaling = Scaling::per_axis;
  const OrientationDemonstration loop = [] {
    const Eigen::VectorXd t = grid(200, 1.0);
    Rotations r;
    Eigen::Vector3d v;
    for (const double u : t)
      r.push_back(so3::exp(v = Eigen::Vector3d(.5 * u, .3 * u, std::sin(2 * M_PI * u) + 1e-4 * u)));
    return OrientationDemonstration(t, r);
  }();
  CHECK(warned(assess(OrientationDmp::fit(loop, scaled), {loop}), "scaling: axis 2"));
  Poses poses;
  for (Eigen::Index k = 0; k < loop.size(); ++k)
    poses.push_back(
        pose_of(loop.rotation()[static_cast<std::size_t>(k)], loop.time()[k] * Eigen::Vector3d::Ones()));
  const PoseDemonstration both(loop.time(), poses);
  CHECK(warned(assess(PoseDmp::fit(both, scaled), {both}), "scaling: axis 5"));

  const OrientationDemonstration ends(Eigen::Vector2d(0, 1),
                                      {Eigen::Matrix3d::Identity(), so3::exp({.5, .2, 0})});
  CHECK(warned(assess(OrientationDmp::fit(ends), {ends}), "demonstrations[0]: two samples"));

  DmpOptions singular;
  singular.regression = Regression::ridge;
  singular.overlap = 1e-3;
  CHECK(warned(assess(OrientationDmp::fit(turn, singular), {turn}), "condition"));

  const Demonstration noisy = noisy_helix(1e-3, 5);
  DmpOptions many;
  many.basis_count = 1000;
  many.regression = Regression::ridge;
  many.derivatives = Derivatives::interpolate;
  CHECK(warned(assess(Dmp::fit(noisy, many), {noisy}), "noise"));
}

TEST_CASE("a report of orientations or poses refuses what it cannot hold a model against") {
  const PoseDemonstration demonstration = pose(100, 1.0);
  const OrientationDmp turn = OrientationDmp::fit(demonstration.orientation());
  const PoseDmp both = PoseDmp::fit(demonstration);
  CHECK_THROWS_WITH_AS(assess(turn, {}), doctest::Contains("demonstrations: none"), InvalidArgument);
  CHECK_THROWS_WITH_AS(assess(both, {}), doctest::Contains("demonstrations: none"), InvalidArgument);
  CHECK_THROWS_WITH_AS(assess(turn, {demonstration.orientation()}, {1.0, 0.0}),
                       doctest::Contains("tolerance.angle"), InvalidArgument);
  CHECK_THROWS_WITH_AS(assess(both, {demonstration}, {NAN, 1.0}), doctest::Contains("tolerance.position"),
                       InvalidArgument);
}
