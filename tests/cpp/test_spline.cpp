#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/spline.hpp>

#include <cmath>
#include <random>

using namespace dmp;

namespace {
Eigen::VectorXd irregular(int count, double end) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.5, 1.5);
  Eigen::VectorXd times(count);
  times[0] = 0.0;
  for (int k = 1; k < count; ++k) times[k] = times[k - 1] + share(random);
  return times * (end / times[count - 1]);
}
}  // namespace

TEST_CASE("a quintic is its own spline on any grid, its derivatives too") {
  const auto y = [](double t) {
    return 1 - 2 * t + t * t - 3 * std::pow(t, 3) + std::pow(t, 4) - .5 * std::pow(t, 5);
  };
  const auto v = [](double t) { return -2 + 2 * t - 9 * t * t + 4 * std::pow(t, 3) - 2.5 * std::pow(t, 4); };
  const auto a = [](double t) { return 2 - 18 * t + 12 * t * t - 10 * std::pow(t, 3); };
  const Eigen::VectorXd times = irregular(40, 2.0);
  RowMatrix values(40, 2);
  for (int k = 0; k < 40; ++k) values.row(k) << y(times[k]), -y(times[k]);
  const Eigen::VectorXd between = Eigen::VectorXd::LinSpaced(301, 0.0, 2.0);
  const Spline::Samples samples = Spline(times, values).sample(between);
  for (int k = 0; k < 301; ++k) {
    CHECK(std::abs(samples.value(k, 0) - y(between[k])) < 1e-12);
    CHECK(std::abs(samples.first(k, 0) - v(between[k])) < 1e-10);
    CHECK(std::abs(samples.second(k, 1) + a(between[k])) < 1e-8);
  }
}

TEST_CASE("it passes through the samples and converges with the sixth power of their distance") {
  double last = 0.0;
  for (const int count : {50, 100, 200}) {
    const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(count + 1, 0.0, 2.0);
    const Spline spline(times, RowMatrix((3 * times).array().sin()));
    CHECK((spline.sample(times).value.col(0) - Eigen::VectorXd((3 * times).array().sin()))
              .cwiseAbs()
              .maxCoeff() < 1e-14);
    const Eigen::VectorXd between = Eigen::VectorXd::LinSpaced(4001, 0.0, 2.0);
    const double error =
        (spline.sample(between).value.col(0).array() - (3 * between).array().sin()).abs().maxCoeff();
    if (last > 0.0) CHECK(error < last / 40.0);
    last = error;
  }
}

TEST_CASE("with fewer than six samples it is the polynomial through them") {
  for (int count = 2; count < 6; ++count) {
    const Eigen::VectorXd times = irregular(count, 1.0);
    const RowMatrix values = times.array().pow(count - 1);
    const Spline::Samples at = Spline(times, values).sample(Eigen::VectorXd::Constant(1, 0.37));
    CHECK(at.value(0, 0) == doctest::Approx(std::pow(0.37, count - 1)).epsilon(1e-12));
    CHECK(at.first(0, 0) == doctest::Approx((count - 1) * std::pow(0.37, count - 2)).epsilon(1e-11));
  }
}

TEST_CASE("a smoothing spline has no samples to go through, and says so") {
  const Eigen::VectorXd times = irregular(40, 2.0);
  const Spline smooth = Spline::smoothing(times, RowMatrix(times.array().sin()));
  CHECK_THROWS_WITH_AS(smooth.through(RowMatrix::Zero(40, 1)), doctest::Contains("through"), InvalidArgument);
  CHECK_THROWS_AS(Spline(times, RowMatrix(times)).through(RowMatrix::Zero(39, 1)), InvalidArgument);
}
