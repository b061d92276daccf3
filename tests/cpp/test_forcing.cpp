#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/forcing.hpp>

#include <cmath>
#include <functional>

using namespace dmp;

namespace {
const double kAlphaX = std::log(100.0);

DmpOptions options_of(Regression regression, int passes = 10) {
  DmpOptions options;
  options.regression = regression;
  options.passes = passes;
  return options;
}

ForcingTarget target_of(int samples, const std::function<double(double)>& f) {
  ForcingTarget target{Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0), RowMatrix(samples, 1),
                       Eigen::VectorXd::Ones(1)};
  for (int k = 0; k < samples; ++k) target.value(k, 0) = f(target.s[k]);
  return target;
}

/// The textbook: kernel by kernel over the samples, again over what is left. An independent, slow reference.
RowMatrix textbook_lwr(const GaussianBasis& basis, const ForcingTarget& target, int passes) {
  const RowMatrix psi = basis.activations(target.s);
  const RowMatrix normalised = basis.activations(target.s, true);
  const Eigen::VectorXd x = (-basis.alpha_x() * target.s).array().exp();
  Eigen::VectorXd w = Eigen::VectorXd::Zero(basis.count());
  for (int pass = 0; pass < passes; ++pass) {
    const Eigen::VectorXd rest = target.value.col(0).array() - x.array() * (normalised * w).array();
    for (int i = 0; i < basis.count(); ++i) {
      const Eigen::ArrayXd weight = psi.col(i).array();
      w[i] += (weight * x.array() * rest.array()).sum() / (weight * x.array().square()).sum();
    }
  }
  return w;
}
}  // namespace

TEST_CASE("the band matrix gives the weights of the textbook, pass for pass") {
  const ForcingTarget target = target_of(500, [](double s) { return std::sin(9 * s) + s * s; });
  for (const GaussianBasis& basis :
       {GaussianBasis::equal_in_time(30, kAlphaX, std::log(2.0)), GaussianBasis::source(30, 1.0)})
    for (const int passes : {1, 2, 10}) {
      const RowMatrix expected = textbook_lwr(basis, target, passes);
      const RowMatrix found = fit_forcing(basis, {target}, options_of(Regression::lwr, passes));
      CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-9 * expected.cwiseAbs().maxCoeff());
    }
}

TEST_CASE("a constant times x is found by every kernel: the partition of unity") {
  const ForcingTarget target = target_of(400, [](double s) { return 3.5 * std::exp(-kAlphaX * s); });
  for (const auto regression : {Regression::lwr, Regression::ridge}) {
    const auto basis = GaussianBasis::equal_in_time(25, kAlphaX, 0.5);
    const RowMatrix w = fit_forcing(basis, {target}, options_of(regression));
    CHECK((w.array() - 3.5).abs().maxCoeff() < 1e-6);
  }
}

TEST_CASE("passes go down to the least-squares fit") {
  const auto basis = GaussianBasis::equal_in_time(40, kAlphaX, std::log(2.0));
  const ForcingTarget target =
      target_of(800, [](double s) { return std::exp(-kAlphaX * s) * std::sin(20 * s); });
  const auto error = [&](const DmpOptions& options) {
    const ForcingTerm term(basis, fit_forcing(basis, {target}, options));
    return (term.evaluate(target.s) - target.value).norm();
  };
  const double best = error(options_of(Regression::ridge));
  double last = 1e300;
  for (const int passes : {1, 3, 10, 30, 100}) {
    const double now = error(options_of(Regression::lwr, passes));
    CHECK(now < last);
    CHECK(now >= best * (1 - 1e-9));
    last = now;
  }
  CHECK(last < 2 * best);
}

TEST_CASE("a demonstration counts alike however densely each part of it was sampled") {
  const auto f = [](double s) { return std::exp(-kAlphaX * s) * std::cos(7 * s); };
  ForcingTarget uneven = target_of(900, f);
  uneven.s = uneven.s.array().square();
  for (int k = 0; k < 900; ++k) uneven.value(k, 0) = f(uneven.s[k]);
  const auto basis = GaussianBasis::equal_in_time(20, kAlphaX, std::log(2.0));
  const RowMatrix a = fit_forcing(basis, {target_of(900, f)}, options_of(Regression::lwr));
  const RowMatrix b = fit_forcing(basis, {uneven}, options_of(Regression::lwr));
  CHECK((a - b).cwiseAbs().maxCoeff() < 0.02);
}

TEST_CASE("a demonstration sampled ten times as often counts no more") {
  const auto basis = GaussianBasis::equal_in_time(20, kAlphaX, std::log(2.0));
  const auto f = [](double size) {
    return [size](double s) { return size * std::exp(-kAlphaX * s) * std::sin(6 * s); };
  };
  const RowMatrix joint = fit_forcing(basis, {target_of(400, f(1.0)), target_of(4000, f(2.0))}, {});
  const RowMatrix middle = fit_forcing(basis, {target_of(4000, f(1.5))}, {});
  CHECK((joint - middle).cwiseAbs().maxCoeff() < 1e-2 * middle.cwiseAbs().maxCoeff());
}

TEST_CASE("targets that do not fit together are refused") {
  const auto basis = GaussianBasis::equal_in_time(20, kAlphaX, std::log(2.0));
  CHECK_THROWS_AS(fit_forcing(basis, {}, {}), InvalidArgument);
  ForcingTarget target = target_of(50, [](double s) { return s; });
  target.value.conservativeResize(20, 1);
  CHECK_THROWS_AS(fit_forcing(basis, {target}, {}), InvalidArgument);
  CHECK_THROWS_AS(basis.activations(Eigen::VectorXd::Constant(1, NAN)), InvalidArgument);
  CHECK_THROWS_AS(basis.activations(Eigen::VectorXd::Constant(1, -50.0)), InvalidArgument);
}

TEST_CASE("targets that are not finite, in their values or their scales, are refused") {
  const auto basis = GaussianBasis::equal_in_time(20, kAlphaX, std::log(2.0));
  ForcingTarget target = target_of(50, [](double s) { return s; });
  target.value(30, 0) = NAN;
  CHECK_THROWS_WITH_AS(fit_forcing(basis, {target}, {}), doctest::Contains("not finite"), InvalidArgument);
  target.value(30, 0) = 0.0;
  target.scale[0] = INFINITY;
  CHECK_THROWS_WITH_AS(fit_forcing(basis, {target}, {}), doctest::Contains("not finite"), InvalidArgument);
}

TEST_CASE("each axis has a scale of its own, and its weights are those it has alone") {
  const auto basis = GaussianBasis::equal_in_time(20, kAlphaX, std::log(2.0));
  for (const Regression regression : {Regression::lwr, Regression::ridge})
    for (const double scale : {1.0, 3.0}) {
      const ForcingTarget first = target_of(200, [](double s) { return std::sin(5 * s); });
      ForcingTarget second = target_of(200, [](double s) { return s * s; });
      second.scale[0] = scale;
      ForcingTarget both{first.s, RowMatrix(200, 2), Eigen::Vector2d(1.0, scale)};
      both.value << first.value, second.value;
      const RowMatrix weights = fit_forcing(basis, {both}, options_of(regression));
      const RowMatrix alone = fit_forcing(basis, {first}, options_of(regression));
      const RowMatrix beside = fit_forcing(basis, {second}, options_of(regression));
      CHECK((weights.col(0) - alone.col(0)).norm() < 1e-12 * alone.norm());
      CHECK((weights.col(1) - beside.col(0)).norm() < 1e-12 * beside.norm());
    }
}

TEST_CASE("a scale counts as zero below 1e-9, a target below 1e-9 as none") {
  const auto basis = GaussianBasis::equal_in_time(10, kAlphaX, 0.7);
  ForcingTarget target = target_of(100, [](double) { return 1e-9; });
  target.scale[0] = 0.0;
  CHECK(fit_forcing(basis, {target}, {}).allFinite());
  target.value *= 1.5;
  CHECK_THROWS_AS(fit_forcing(basis, {target}, {}), InvalidArgument);
  target.scale[0] = 1e-9;
  CHECK(fit_forcing(basis, {target}, {}).allFinite());
}

TEST_CASE("demonstrations of different scale are weighed by the square of their scale") {
  const auto basis = GaussianBasis::equal_in_time(20, kAlphaX, std::log(2.0));
  ForcingTarget large = target_of(300, [](double s) { return 2.0 * std::exp(-kAlphaX * s) * (1 + s); });
  large.scale[0] = 2.0;
  ForcingTarget small = target_of(300, [](double s) { return 0.1 * std::exp(-kAlphaX * s) * (1 + s); });
  small.scale[0] = 0.1;
  const RowMatrix alone = fit_forcing(basis, {large}, options_of(Regression::lwr));
  const RowMatrix both = fit_forcing(basis, {large, small}, options_of(Regression::lwr));
  CHECK((alone - both).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("a scale of zero cannot carry a forcing term") {
  const auto basis = GaussianBasis::equal_in_time(10, kAlphaX, 0.7);
  ForcingTarget target = target_of(100, [](double) { return 1.0; });
  target.scale[0] = 0.0;
  CHECK_THROWS_WITH_AS(fit_forcing(basis, {target}, {}), doctest::Contains("scaling: axis 0"),
                       InvalidArgument);
  target.value.setZero();
  CHECK(fit_forcing(basis, {target}, {}).norm() == 0.0);
}

TEST_CASE("weights that do not fit the basis are refused") {
  const auto basis = GaussianBasis::equal_in_time(10, kAlphaX, 0.7);
  CHECK_THROWS_AS(ForcingTerm(basis, RowMatrix::Zero(9, 3)), InvalidArgument);
  CHECK_THROWS_AS(ForcingTerm(basis, RowMatrix::Constant(10, 3, NAN)), InvalidArgument);
}

TEST_CASE("every number of dimensions is evaluated alike") {
  const auto basis = GaussianBasis::equal_in_time(15, kAlphaX, 0.7);
  const RowMatrix w = RowMatrix::Random(15, 9);
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(31, 0.0, 1.2);
  const RowMatrix all = ForcingTerm(basis, w).evaluate(s);
  const Eigen::VectorXd x = (-kAlphaX * s).array().exp();
  CHECK((all - RowMatrix(x.asDiagonal() * basis.activations(s, true) * w)).cwiseAbs().maxCoeff() < 1e-14);
  for (int d = 1; d < 9; ++d)
    CHECK((ForcingTerm(basis, w.leftCols(d)).evaluate(s) - all.leftCols(d)).cwiseAbs().maxCoeff() < 1e-15);
}

TEST_CASE("two phases at once are what each is alone, bit for bit, however far apart") {
  const auto basis = GaussianBasis::equal_in_time(15, kAlphaX, 0.7);
  Eigen::VectorXd psi(basis.window_capacity());
  for (int d = 1; d < 10; ++d) {
    const ForcingTerm term(basis, RowMatrix::Random(15, d));
    for (const double s : {0.0, 0.034, 0.5, 0.99, 1.0, 1.3, 40.0}) {
      for (const double next : {s, s + 1e-3, s + 0.02, s + 0.3}) {
        Eigen::MatrixXd together(d, 2), alone(d, 2);
        term.evaluate(s, next, psi.data(), together.col(0).data(), together.col(1).data());
        term.evaluate(s, psi.data(), alone.col(0).data());
        term.evaluate(next, psi.data(), alone.col(1).data());
        CHECK(together == alone);
      }
    }
  }
}
