#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "geometry/exponential.hpp"

namespace {

/// Units in the last place between exp(x) and its value in the longer type.
double units_off(double x, double found) {
  const long double exact = std::exp(static_cast<long double>(x));
  const double rounded = static_cast<double>(exact);
  const double unit = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
  return static_cast<double>(std::abs(found - exact)) / unit;
}

double worst(double largest, int count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> draw(-largest, largest);
  double units = 0.0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Array4d x(draw(random), draw(random), draw(random), draw(random));
    const Eigen::Array4d found = dmp::detail::exponential<4>(x);
    for (int j = 0; j < 4; ++j) units = std::fmax(units, units_off(x[j], found[j]));
  }
  return units;
}

}  // namespace

TEST_CASE("the exponential is within one unit in the last place") {
  for (const double largest : {1e-12, 1e-3, 0.4, 3.0, 50.0, 700.0}) {
    CAPTURE(largest);
    CHECK(worst(largest, 25000) < 1.0);
  }
}

TEST_CASE("the exponential is exact at zero and alike in every place") {
  const double x = -4.6051701859880914;
  CHECK(dmp::detail::exponential<2>({0.0, -0.0}).isOnes(0.0));
  const Eigen::Array4d same = dmp::detail::exponential<4>(Eigen::Array4d::Constant(x));
  for (int j = 0; j < 4; ++j) CHECK(same[j] == dmp::detail::exponential<2>({x, 1.0})[0]);
}
