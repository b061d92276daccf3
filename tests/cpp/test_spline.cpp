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

namespace {
RowMatrix noise(int count, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  RowMatrix values(count, columns);
  for (int k = 0; k < count; ++k)
    for (int d = 0; d < columns; ++d) values(k, d) = normal(random);
  return values;
}

double peak(const Spline& spline, double begin, double end) {
  return spline.sample(Eigen::VectorXd::LinSpaced(2001, begin, end)).second.rowwise().norm().maxCoeff();
}

/// The third derivative next to a time, from the second one.
Eigen::RowVectorXd third(const Spline& spline, double from, double to) {
  const Spline::Samples at = spline.sample(Eigen::Vector2d(from, to));
  return (at.second.row(1) - at.second.row(0)) / (to - from);
}
}  // namespace

TEST_CASE("a smooth motion keeps not-a-knot ends, and so do few samples") {
  const Eigen::VectorXd times = irregular(200, 2.0);
  RowMatrix values(200, 2);
  for (int k = 0; k < 200; ++k) values.row(k) << std::sin(3 * times[k]), std::exp(times[k]);
  const std::array<EndCondition, 2> free{EndCondition::not_a_knot, EndCondition::not_a_knot};
  CHECK(Spline(times, values).ends() == free);
  CHECK(Spline(times, RowMatrix(RowMatrix::Constant(200, 3, 0.7))).ends() == free);
  CHECK(Spline(irregular(11, 1.0), noise(11, 3, 1)).ends() == free);
  CHECK(Spline::smoothing(times, values).ends() ==
        std::array<EndCondition, 2>{EndCondition::natural, EndCondition::natural});
}

TEST_CASE("white noise is no larger at the ends of an interpolating spline than inside it") {
  double inside = 0.0;
  double ends = 0.0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Spline spline(Eigen::VectorXd::LinSpaced(101, 0.0, 1.0), noise(101, 3, seed));
    inside += peak(spline, 0.40, 0.43) / 40;
    ends += 0.5 * (peak(spline, 0.0, 0.03) + peak(spline, 0.97, 1.0)) / 40;
  }
  CHECK(ends < 1.15 * inside);
  CHECK(ends > 0.3 * inside);
}

TEST_CASE("an end of its own condition passes through the samples on any grid, beside any other end") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::VectorXd times = irregular(60, 2.0);
    RowMatrix values(60, 3);
    for (int k = 0; k < 60; ++k) values.row(k) << std::sin(times[k]), std::cos(times[k]), times[k];
    if (seed % 3 != 0) values.topRows(20) += 0.01 * noise(20, 3, seed);
    if (seed % 3 != 1) values.bottomRows(20) += 0.01 * noise(20, 3, seed + 100);
    const Spline spline(times, values);
    CHECK((spline.ends()[0] == EndCondition::not_a_knot) == (seed % 3 == 0));
    CHECK((spline.ends()[1] == EndCondition::not_a_knot) == (seed % 3 == 1));
    CHECK((spline.sample(times).value - values).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("a natural end has no third derivative; third_difference takes that of the last four samples") {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(61, 0.0, 60.0);
  const Spline natural(times, noise(61, 1, 3));
  REQUIRE(natural.ends()[0] == EndCondition::natural);
  CHECK(std::abs(third(natural, 0.0, 1e-3)[0]) < 1e-5);
  RowMatrix cubic = 0.01 * times.array().cube();
  cubic.array() += 0.004 * noise(61, 1, 1).array();
  const Spline fitted(times, cubic);
  REQUIRE(fitted.ends()[1] == EndCondition::third_difference);
  const double difference = cubic(60) - 3 * cubic(59) + 3 * cubic(58) - cubic(57);
  CHECK(third(fitted, 60.0 - 1e-3, 60.0)[0] == doctest::Approx(difference).epsilon(1e-3));
}

TEST_CASE("through other values it chooses the ends anew and is the spline made of them") {
  const Eigen::VectorXd times = irregular(80, 2.0);
  RowMatrix calm(80, 3);
  for (int k = 0; k < 80; ++k) calm.row(k) << std::sin(times[k]), std::cos(times[k]), times[k];
  const RowMatrix noisy = calm + 0.01 * noise(80, 3, 5);
  const Eigen::VectorXd between = Eigen::VectorXd::LinSpaced(501, 0.0, 2.0);
  for (const auto& [from, to] : {std::pair(calm, noisy), std::pair(noisy, calm), std::pair(noisy, noisy)}) {
    const Spline changed = Spline(times, from).through(to);
    const Spline made(times, to);
    CHECK(changed.ends() == made.ends());
    CHECK(changed.sample(between).second == made.sample(between).second);
  }
}
