#pragma once
// Properties that hold in every case: many random cases, each with a generator of its own, so that a case
// that fails can be made again from its number.

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <random>

namespace cases {

/// Random numbers of one case.
class Random {
 public:
  explicit Random(unsigned long number) : generator_(0x9e3779b97f4a7c15ull * (number + 1)) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(generator_); }
  bool coin() { return whole(0, 1) == 1; }
  /// As likely in each power of ten.
  double magnitude(double low, double high) {
    return std::pow(10.0, uniform(std::log10(low), std::log10(high)));
  }
  Eigen::Vector3d direction() {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(generator_), normal(generator_), normal(generator_)).normalized();
  }
  Eigen::VectorXd vector(Eigen::Index size, double low, double high) {
    return Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(low, high); });
  }

 private:
  std::mt19937_64 generator_;
};

/// How many cases each property is held against: 10,000, or what the environment variable DMP_CASES says.
inline unsigned long count() {
  const char* stated = std::getenv("DMP_CASES");
  return stated ? std::strtoul(stated, nullptr, 10) : 10000ul;
}

/// Calls check(random) for each case, after `share` of them one; the number of a case that fails is printed
/// with it.
template <class Check>
void each(const Check& check, unsigned long share = 1) {
  REQUIRE(count() > 0);
  for (unsigned long number = 0; number < count(); number += share) {
    CAPTURE(number);
    Random random(number);
    check(random);
  }
}

}  // namespace cases
