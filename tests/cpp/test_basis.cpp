#include <doctest/doctest.h>
#include <dmp/basis.hpp>
#include <dmp/error.hpp>

#include <cmath>

using namespace dmp;

namespace {
const double kAlphaX = std::log(100.0);
}

TEST_CASE("kernels equal in time are the Gaussians they say, in a window of those that count") {
  const GaussianBasis basis = GaussianBasis::equal_in_time(100, kAlphaX, std::log(2.0));
  CHECK(basis.window_capacity() < 25);
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(1237, 0.0, 1.3);
  const RowMatrix psi = basis.activations(s);
  for (Eigen::Index k = 0; k < s.size(); ++k)
    for (int i = 0; i < 100; ++i) {
      const double u = 99 * s[k] - i;
      CHECK(std::abs(psi(k, i) - std::exp(-std::log(2.0) * u * u)) < 1e-15);
    }
}

TEST_CASE("neighbours cross at exp(-overlap / 4)") {
  const GaussianBasis basis = GaussianBasis::equal_in_time(11, kAlphaX, 0.7);
  const RowMatrix psi = basis.activations(Eigen::VectorXd::Constant(1, 0.25));
  CHECK(psi(0, 2) == doctest::Approx(std::exp(-0.7 / 4)).epsilon(1e-13));
  CHECK(psi(0, 3) == doctest::Approx(psi(0, 2)).epsilon(1e-13));
}

TEST_CASE("the source's kernels stand evenly in time and have its widths") {
  const GaussianBasis basis = GaussianBasis::source(100, 1.0);
  const Eigen::VectorXd c = basis.centers();
  CHECK(c[0] == 1.0);
  CHECK(c[99] == doctest::Approx(std::exp(-1.0)).epsilon(1e-15));
  const double s = 0.4;
  const RowMatrix psi = basis.activations(Eigen::VectorXd::Constant(1, s));
  for (int i = 0; i < 100; ++i) {
    const double d = std::exp(-s) - c[i];
    CHECK(psi(0, i) == doctest::Approx(std::exp(-1000.0 / c[i] * d * d)).epsilon(1e-13));
  }
}

TEST_CASE("normalised activations sum to one everywhere, far beyond the last kernel too") {
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(400, 0.0, 40.0);
  for (const GaussianBasis& basis :
       {GaussianBasis::equal_in_time(100, kAlphaX, 0.2), GaussianBasis::equal_in_time(1, kAlphaX, 0.7),
        GaussianBasis::equal_in_time(3, kAlphaX, 0.7), GaussianBasis::source(50, 1.0)}) {
    const RowMatrix psi = basis.activations(s, true);
    CHECK(psi.allFinite());
    CHECK((psi.rowwise().sum().array() - 1.0).abs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("a count, decay or overlap that makes no basis is refused") {
  CHECK_THROWS_AS(GaussianBasis::equal_in_time(0, kAlphaX, 0.7), InvalidArgument);
  CHECK_THROWS_AS(GaussianBasis::equal_in_time(10, 0.0, 0.7), InvalidArgument);
  CHECK_THROWS_AS(GaussianBasis::equal_in_time(10, kAlphaX, NAN), InvalidArgument);
  CHECK_THROWS_AS(GaussianBasis::source(-3, 1.0), InvalidArgument);
  CHECK_THROWS_WITH_AS(GaussianBasis::equal_in_time(100001, kAlphaX, 0.7),
                       "basis_count: 100001, expected 1 to 100000 kernels.", InvalidArgument);
  CHECK(GaussianBasis::equal_in_time(100000, kAlphaX, 0.7).count() == 100000);
  CHECK_THROWS_AS(GaussianBasis::equal_in_time(10, 50.5, 0.7), InvalidArgument);
  CHECK(GaussianBasis::equal_in_time(10, 50.0, 0.7).alpha_x() == 50.0);
}
