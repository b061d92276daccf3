#include <doctest/doctest.h>
#include <dmp/distribution.hpp>
#include <dmp/error.hpp>
#include <dmp/file.hpp>

#include <Eigen/Dense>

#include "varied.hpp"

using namespace dmp;
using namespace varied;

namespace {

const DmpDistribution& learned() {
  static const DmpDistribution distribution = DmpDistribution::fit(curves(8, 1));
  return distribution;
}

VectorXd reference_at(const DmpDistribution& distribution, double s) {
  const RowMatrix& table = distribution.parameters().reference;
  const Demonstration reference(VectorXd::LinSpaced(table.rows(), 0, 1), table);
  return reference.at(VectorXd::Constant(1, s)).position.row(0);
}

VectorXd point(double x, double y) { return Eigen::Vector2d(x, y); }

double inside_two_sigma(const DmpDistribution& distribution, const std::vector<Demonstration>& unseen) {
  double inside = 0.0, all = 0.0;
  for (const Demonstration& one : unseen) {
    const Spread band = distribution.spread(one.size());
    for (Index k = 0; k < one.size(); ++k)
      for (Index a = 0; a < 2; ++a) {
        const double sigma = std::sqrt(band.covariance[static_cast<std::size_t>(k)](a, a) +
                                       std::pow(distribution.parameters().noise[0], 2));
        inside += std::abs(one.position()(k, a) - band.mean(k, a)) < 2 * sigma ? 1 : 0;
        all += 1;
      }
  }
  return inside / all;
}

}  // namespace

TEST_CASE("conditioning is that of a Gaussian, written out with dense matrices") {
  const DmpDistribution& d = learned();
  Given<VectorSpace> given(.37, point(.9, .3));
  given.covariance = Eigen::Matrix2d{{4e-4, 1e-4}, {1e-4, 9e-4}};
  const DmpDistribution found = d.condition({given});

  const MatrixXd h = rows_at(.37, 14, 2);
  const MatrixXd s = covariance_of(d);
  const MatrixXd gain = s * h.transpose() * (h * s * h.transpose() + *given.covariance).inverse();
  const VectorXd away = *given.point - reference_at(d, .37) - h * d.parameters().mean;
  CHECK((found.parameters().mean - d.parameters().mean - gain * away).norm() < 1e-9);
  CHECK((covariance_of(found) - (s - gain * h * s)).norm() < 1e-11 * s.norm());
}

TEST_CASE("the likelihood is that of all samples as one Gaussian") {
  const DmpDistribution& d = learned();
  const Demonstration unseen = curves(1, 77).front();
  const Index n = unseen.size();
  MatrixXd rows(2 * n, d.parameters().mean.size());
  VectorXd away(2 * n);
  for (Index k = 0; k < n; ++k) {
    const double s = unseen.time()[k] / unseen.duration();
    rows.middleRows(2 * k, 2) = rows_at(s, 14, 2);
    away.segment(2 * k, 2) = unseen.position().row(k).transpose() - reference_at(d, s);
  }
  away -= rows * d.parameters().mean;
  MatrixXd covariance = rows * covariance_of(d) * rows.transpose();
  covariance.diagonal().array() += std::pow(d.parameters().noise[0], 2);
  const Eigen::LLT<MatrixXd> llt(covariance);
  const double deviance = away.dot(llt.solve(away)) +
                          2 * MatrixXd(llt.matrixL()).diagonal().array().log().sum() +
                          static_cast<double>(2 * n) * std::log(2 * M_PI);
  CHECK(d.log_likelihood(unseen) == doctest::Approx(-.5 * deviance).epsilon(1e-8));
}

TEST_CASE("a partial recording is its samples one by one") {
  const DmpDistribution& d = learned();
  const Demonstration unseen = curves(1, 78).front();
  const Index n = 12;
  const Demonstration part(unseen.time().head(n), unseen.position().topRows(n));
  std::vector<Given<VectorSpace>> given;
  for (Index k = 0; k < n; ++k) {
    given.emplace_back(.2 + part.time()[k] / 3.0, part.position().row(k).transpose());
    given.back().covariance = 1e-4 * Eigen::Matrix2d::Identity();
  }
  const DmpDistribution one = d.condition(given);
  const DmpDistribution other = d.condition(part, 3.0, .2, VectorXd::Constant(1, 1e-2));
  CHECK((one.parameters().mean - other.parameters().mean).norm() < 1e-9);
  CHECK((covariance_of(one) - covariance_of(other)).norm() < 1e-10 * covariance_of(d).norm());
}

TEST_CASE("exact points and velocities are met, in any order, and leave nothing open there") {
  const DmpDistribution& d = learned();
  const Given<VectorSpace> start(0.0, point(0, .1));
  const Given<VectorSpace> middle(.5, point(1.1, .2), point(.3, -.4));
  const DmpDistribution found = d.condition({start, middle});
  const Trajectory motion = found.rollout(101);
  CHECK((motion.position.row(0).transpose() - *start.point).norm() < 1e-12);
  CHECK((motion.position.row(50).transpose() - *middle.point).norm() < 1e-12);
  CHECK((motion.velocity.row(50).transpose() - *middle.velocity).norm() < 1e-10);
  CHECK(found.spread(3).covariance[1].norm() < 1e-20);
  CHECK(found.spread(3).covariance[0].norm() < 1e-20);
  CHECK(found.spread(5).covariance[3].norm() > 1e-6);
  const DmpDistribution turned = d.condition({middle, start});
  CHECK((found.parameters().mean - turned.parameters().mean).norm() < 1e-9);
  const Dmp mean = found.mean();
  CHECK((mean.start() - *start.point).norm() < 1e-9);
  CHECK(
      (mean.rollout_at(VectorXd::Constant(1, .5 * d.duration())).position.row(0).transpose() - *middle.point)
          .norm() < 2e-3);
}

TEST_CASE("one axis may be known alone") {
  const DmpDistribution& d = learned();
  Given<VectorSpace> given(.5, point(2.0, NAN));
  given.axes = {0};
  CHECK_THROWS_AS(d.condition({given}), InvalidArgument);  // no number may be missing
  given.point = point(1.05, 99.0);
  const DmpDistribution found = d.condition({given});
  CHECK(found.rollout(3).position(1, 0) == doctest::Approx(1.05));
  CHECK(std::abs(found.rollout(3).position(1, 1)) < 1.0);
  CHECK(found.spread(3).covariance[1](1, 1) > 0.0);
}

TEST_CASE(
    "few demonstrations are not taken for all there is: about 95 % of unseen samples lie inside two sigma") {
  double inside = 0.0;
  for (unsigned seed = 10; seed < 22; ++seed)
    inside += inside_two_sigma(DmpDistribution::fit(curves(7, seed)), curves(10, seed + 100)) / 12;
  CHECK(inside > .89);
  CHECK(inside < .97);
}

TEST_CASE("mean, covariance and noise are found from many") {
  const DmpDistribution d = DmpDistribution::fit(curves(200, 5));
  const Spread band = d.spread(11);
  CHECK(d.parameters().noise[0] == doctest::Approx(.005).epsilon(.05));
  for (Index k = 0; k < 11; ++k) {
    const double s = .1 * static_cast<double>(k);
    CHECK((band.mean.row(k) - Eigen::RowVector2d(std::sin(3 * s), s * s)).norm() < .03);
    const Eigen::Matrix2d expected{
        {.01 * (1 + s * s), .01 * s * std::cos(3 * s)},
        {.01 * s * std::cos(3 * s), .01 * (std::pow(std::cos(3 * s), 2) + std::pow(std::sin(5 * s), 2))}};
    CHECK((band.covariance[static_cast<std::size_t>(k)] - expected).norm() < .007);
  }
}

TEST_CASE("all results are the same in metres and in millimetres") {
  std::vector<Demonstration> large;
  for (const Demonstration& one : curves(6, 3)) large.push_back(one.with(1000 * one.position()));
  const DmpDistribution in_m = DmpDistribution::fit(curves(6, 3));
  const DmpDistribution in_mm = DmpDistribution::fit(large);
  const Demonstration unseen = curves(1, 4).front();
  const auto numbers = static_cast<double>(unseen.position().size());
  CHECK(in_mm.log_likelihood(unseen.with(1000 * unseen.position())) / numbers + std::log(1000) ==
        doctest::Approx(in_m.log_likelihood(unseen) / numbers).epsilon(1e-9));
  CHECK(in_mm.parameters().noise[0] == doctest::Approx(1000 * in_m.parameters().noise[0]).epsilon(1e-9));
  const auto at = [](double unit) { return Given<VectorSpace>(.5, unit * point(1.1, .2)); };
  CHECK((in_mm.condition({at(1000)}).rollout().position - 1000 * in_m.condition({at(1)}).rollout().position)
            .norm() < 1e-6);
  CHECK(in_mm.distance(at(1000)) == doctest::Approx(in_m.distance(at(1))).epsilon(1e-9));
}

TEST_CASE("samples have the mean and the covariance of the distribution; one seed, the same bits") {
  const DmpDistribution& d = learned();
  CHECK(d.sample(7).position == d.sample(7).position);
  CHECK(d.sample(7).position != d.sample(8).position);
  RowMatrix middle(4000, 2);
  for (Index j = 0; j < 4000; ++j) middle.row(j) = d.sample(static_cast<std::uint64_t>(j), 3).position.row(1);
  const Spread band = d.spread(3);
  const Eigen::RowVector2d mean = middle.colwise().mean();
  const RowMatrix away = middle.rowwise() - mean;
  const Eigen::Matrix2d covariance = away.transpose() * away / 3999;
  CHECK((mean - band.mean.row(1)).norm() < .05 * std::sqrt(band.covariance[1].trace()));
  CHECK((covariance - band.covariance[1]).norm() < .08 * band.covariance[1].norm());
}

TEST_CASE("the stiffness is high where demonstrations agree and bounded everywhere") {
  const DmpDistribution d = learned().condition({Given<VectorSpace>(0.0, point(0, 0))});
  const VectorXd most = point(400, 900), spread = point(.05, .02);
  CHECK((d.stiffness(0.0, most, spread) - MatrixXd(most.asDiagonal())).norm() < 1e-9);
  for (const double s : {.3, .6, 1.0}) {
    const MatrixXd k = d.stiffness(s, most, spread);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> own(k);
    CHECK(own.eigenvalues().minCoeff() > 0.0);
    CHECK((MatrixXd(most.asDiagonal()) - k).selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > 0.0);
    const MatrixXd damping = damping_of(k, .7);
    CHECK((damping * damping - 4 * .49 * k).norm() < 1e-9 * k.norm());
  }
  // One variance s^2 in all directions: half of the most.
  const MatrixXd v = d.spread(3).covariance[1];
  const VectorXd own = VectorXd::Constant(2, std::sqrt(v.selfadjointView<Eigen::Lower>().eigenvalues()[1]));
  const VectorXd same = VectorXd::Constant(2, 100.0);
  CHECK(d.stiffness(.5, same, own).selfadjointView<Eigen::Lower>().eigenvalues()[0] == doctest::Approx(50.0));
  CHECK_THROWS_WITH_AS(d.stiffness(.5, point(1, -1), own), doctest::Contains("most[1]"), InvalidArgument);
  CHECK_THROWS_WITH_AS(damping_of(-v), doctest::Contains("not positive definite"), InvalidArgument);
}

TEST_CASE("a blend is the product of Gaussians") {
  const DmpDistribution& d = learned();
  const DmpDistribution same = blend<VectorSpace>({d, d}, point(.5, .5));
  CHECK((same.parameters().mean - d.parameters().mean).norm() < 1e-6);
  CHECK((covariance_of(same) - covariance_of(d)).norm() < 1e-6 * covariance_of(d).norm());
  const DmpDistribution sharp = blend<VectorSpace>({d, d}, point(1, 1));
  CHECK((2 * covariance_of(sharp) - covariance_of(d)).norm() < 1e-6 * covariance_of(d).norm());
  const DmpDistribution other = DmpDistribution::fit(curves(8, 2));
  const DmpDistribution mostly = blend<VectorSpace>({d, other}, point(1e6, 1));
  CHECK((mostly.rollout().position - d.rollout().position).norm() < 1e-2);
  // Another reference is another way to write the same distribution.
  const DmpDistribution alone = blend<VectorSpace>({d, other}, point(1e-9, 1));
  CHECK((alone.rollout().position - other.rollout().position).rowwise().norm().maxCoeff() < 5e-3);
  CHECK_THROWS_WITH_AS(
      blend<VectorSpace>({d.condition({Given<VectorSpace>(0.0, point(0, 0))}), other}, point(1, 1)),
      doctest::Contains("distributions[0]: leaves nothing open"), InvalidArgument);
}

TEST_CASE("a singular condition is refused in words, and so is what cannot be") {
  const DmpDistribution& d = learned();
  const Given<VectorSpace> one(.5, point(1, .2));
  CHECK_THROWS_WITH_AS(d.condition({one, Given<VectorSpace>(.5, point(1, .3))}),
                       doctest::Contains("given[1]: nothing is left open at phase 0.5"), InvalidArgument);
  std::vector<Given<VectorSpace>> crowd;
  for (int k = 0; k < 10; ++k) crowd.emplace_back(.5 + .001 * k, point(1, .2));
  CHECK_THROWS_WITH_AS(d.condition(crowd), doctest::Contains("nothing is left open"), InvalidArgument);
  CHECK_THROWS_WITH_AS(d.condition({Given<VectorSpace>(1.5, point(1, .2))}),
                       doctest::Contains("given[0].phase: 1.5"), InvalidArgument);
  CHECK_THROWS_WITH_AS(d.condition({Given<VectorSpace>(.5, {})}), doctest::Contains("neither"),
                       InvalidArgument);
  Given<VectorSpace> skew = one;
  skew.covariance = Eigen::Matrix2d{{1, 0}, {.5, 1}};
  CHECK_THROWS_WITH_AS(d.condition({skew}), doctest::Contains("given[0].covariance"), InvalidArgument);
  skew.covariance = MatrixXd::Identity(3, 3);
  CHECK_THROWS_WITH_AS(d.condition({skew}), doctest::Contains("3 x 3, expected 2 x 2"), InvalidArgument);
  Given<VectorSpace> nowhere = one;
  nowhere.axes = {0, 2};
  CHECK_THROWS_WITH_AS(d.condition({nowhere}), doctest::Contains("axes: 2"), InvalidArgument);
  const Demonstration part = curves(1, 9).front();
  CHECK_THROWS_WITH_AS(d.condition(part, .5), doctest::Contains("part: ends at"), InvalidArgument);
  CHECK_THROWS_WITH_AS(d.condition(part, -1.0), doctest::Contains("duration"), InvalidArgument);
  CHECK_THROWS_AS(d.sample(0, 1), InvalidArgument);
}

TEST_CASE("demonstrations that do not belong together are refused, and options out of range") {
  std::vector<Demonstration> mixed = curves(5, 1);
  mixed[3] = mixed[3].with(mixed[3].position().colwise().reverse());
  CHECK_THROWS_WITH_AS(DmpDistribution::fit(mixed), doctest::Contains("demonstrations[3]: goes another way"),
                       InvalidArgument);
  CHECK_THROWS_WITH_AS(DmpDistribution::fit({mixed[0]}), doctest::Contains("at least 2"), InvalidArgument);
  CHECK_THROWS_AS(DmpDistribution::fit({}), InvalidArgument);
  mixed[3] = motions::reach(50, 1.0);
  CHECK_THROWS_WITH_AS(DmpDistribution::fit(mixed), doctest::Contains("3 dimensions"), InvalidArgument);
  const auto some = curves(3, 1);
  CHECK_THROWS_WITH_AS(DmpDistribution::fit(some, {3, 8.0, 20}), doctest::Contains("control_points: 3"),
                       InvalidArgument);
  CHECK_THROWS_WITH_AS(DmpDistribution::fit(some, {14, 0.0, 20}), doctest::Contains("prior"),
                       InvalidArgument);
  CHECK_THROWS_WITH_AS(DmpDistribution::fit(some, {14, 8.0, 0}), doctest::Contains("iterations"),
                       InvalidArgument);
}

TEST_CASE("demonstrations that are all the same vary by nothing, and can still be asked") {
  const Demonstration one = curves(1, 1, .1, 0.0).front();
  const DmpDistribution d = DmpDistribution::fit({one, one, one});
  CHECK((d.rollout(one.size()).position - one.position()).norm() < 1e-3);
  CHECK(d.spread(5).covariance[2].norm() < 1e-6);
  CHECK(std::isfinite(d.log_likelihood(one)));
  const DmpDistribution still =
      DmpDistribution::fit({one.with(RowMatrix::Zero(60, 2)), one.with(RowMatrix::Zero(60, 2))});
  CHECK(still.rollout().position.norm() < 1e-6);
}

TEST_CASE("the covariance stays positive semidefinite under many conditions") {
  DmpDistribution d = learned();
  for (int k = 0; k < 40; ++k) {
    Given<VectorSpace> given(.025 * k, point(std::sin(.075 * k), .1));
    given.covariance = 1e-10 * Eigen::Matrix2d::Identity();
    d = d.condition({given});
  }
  const MatrixXd s = covariance_of(d);
  CHECK(s == s.transpose());
  CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(s).eigenvalues().minCoeff() > -1e-15 * s.trace());
  CHECK(d.parameters().mean.allFinite());
}

TEST_CASE("a distribution comes back bit for bit, and a broken file is refused by the field's name") {
  const DmpDistribution& d = learned();
  const std::string text = to_json(d);
  CHECK(text.find("\"kind\": \"dmp_distribution\"") != std::string::npos);
  const auto back = std::get<DmpDistribution>(from_json(text));
  CHECK(to_json(back) == text);
  CHECK(back.sample(3).position == d.sample(3).position);
  auto p = d.parameters();
  p.factor.conservativeResize(3, 28);
  CHECK_THROWS_WITH_AS(DmpDistribution{p}, doctest::Contains("factor"), InvalidArgument);
  p = d.parameters();
  p.mean[3] = NAN;
  CHECK_THROWS_WITH_AS(DmpDistribution{p}, doctest::Contains("mean"), InvalidArgument);
  p = d.parameters();
  p.noise[0] = 0.0;
  CHECK_THROWS_WITH_AS(DmpDistribution{p}, doctest::Contains("noise"), InvalidArgument);
  p = d.parameters();
  p.reference(0, 0) = NAN;
  CHECK_THROWS_WITH_AS(DmpDistribution{p}, doctest::Contains("reference"), InvalidArgument);
  p = d.parameters();
  p.duration = -1;
  CHECK_THROWS_WITH_AS(DmpDistribution{p}, doctest::Contains("duration"), InvalidArgument);
  p = d.parameters();
  p.demonstrations = 1;
  CHECK_THROWS_WITH_AS(DmpDistribution{p}, doctest::Contains("demonstrations"), InvalidArgument);
  const auto many = DmpDistribution::fit(curves(2, 1), {200, 8.0, 1}).parameters();
  CHECK(many.factor.rows() == 400);
}
