// The steps of learning are open: targets of demonstrations, a learner of the user's own, a model of weights.
#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/pose_dmp.hpp>

#include <cmath>
#include <string>

#include "motions.hpp"

using namespace dmp;
using namespace motions;

namespace {

template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE(
    "the built-in regression as a learner gives the same model: to the last bit where nothing advances") {
  DmpOptions options;
  options.basis_count = 30;
  options.derivatives = Derivatives::interpolate;
  for (const Regression regression : {Regression::lwr, Regression::ridge}) {
    options.regression = regression;
    const Learner learner = [&](const GaussianBasis& basis, const std::vector<ForcingTarget>& targets) {
      return fit_forcing(basis, targets, options.resolved());
    };
    const std::vector<PoseDemonstration> demonstrations{pose(100, 1.0), pose(120, 1.3)};
    const PoseDmp own = PoseDmp::fit(demonstrations, options, learner);
    const RowMatrix weights = PoseDmp::fit(demonstrations, options).parameters().weights;
    CHECK((own.parameters().weights - weights).norm() < 1e-7 * weights.norm());
    DmpOptions plain = options;
    plain.scaling = Scaling::none;
    CHECK(PoseDmp::fit(demonstrations, plain, learner).parameters().weights ==
          PoseDmp::fit(demonstrations, plain).parameters().weights);
  }
}

TEST_CASE("targets are what the forcing term of a fit becomes") {
  DmpOptions options;
  options.basis_count = 100;
  options.regression = Regression::ridge;
  options.derivatives = Derivatives::interpolate;
  const std::vector<Demonstration> demonstrations{helix(300, 2.0, .1, .2, 2)};
  const Dmp model = Dmp::fit(demonstrations, options);
  const std::vector<ForcingTarget> targets = Dmp::targets(demonstrations, options);
  REQUIRE(targets.size() == 1);
  const RowMatrix learned = model.forcing().evaluate(targets[0].s);
  CHECK((learned - targets[0].value).cwiseAbs().maxCoeff() < 1e-3 * targets[0].value.cwiseAbs().maxCoeff());
  CHECK((model.forcing().basis().features(targets[0].s) * model.parameters().weights - learned)
            .cwiseAbs()
            .maxCoeff() < 1e-10);
}

TEST_CASE(
    "targets are those that a fit takes where kernels, noise and form are found in the demonstrations") {
  const PoseDemonstration clean = pose(300, 2.0, 1.3);
  Poses noisy = clean.pose();
  for (std::size_t k = 0; k < noisy.size(); ++k) {
    const double u = static_cast<double>(k);
    noisy[k].topRightCorner<3, 1>() +=
        1e-3 * Eigen::Vector3d(std::sin(7e3 * u), std::sin(8e3 * u), std::sin(9e3 * u));
    noisy[k].topLeftCorner<3, 3>() *= so3::exp({0, 0, 4.0 * minimum_jerk(u / 299.0)});
  }
  const std::vector<PoseDemonstration> demonstrations{{clean.time(), noisy}};
  const PoseDmp model = PoseDmp::fit(demonstrations);
  CHECK(model.options().derivatives == Derivatives::smooth);
  CHECK(model.options().orientation_form == OrientationForm::turning);
  const RowMatrix weights =
      fit_forcing(model.forcing().basis(), PoseDmp::targets(demonstrations), model.options());
  CHECK((weights - model.parameters().weights).norm() < 1e-9 * weights.norm());
}

namespace {

/// A reach whose positions have noise, while its orientation goes along the Euler path as far as `end`.
PoseDemonstration noisy_reach(double noise, double end) {
  const Demonstration way = reach(600, 2.0);
  const OrientationDemonstration turns = rotation(600, 2.0, end);
  Poses poses;
  for (int k = 0; k < 600; ++k) {
    const Eigen::Vector3d error(std::sin(7e3 * k), std::sin(8e3 * k), std::sin(9e3 * k));
    poses.push_back(pose_of(turns.rotation()[static_cast<std::size_t>(k)],
                            way.position().row(k).transpose() + noise * error));
  }
  return {way.time(), poses};
}

}  // namespace

TEST_CASE("the orientation of a pose need not be closer than the noise of its positions lets these come") {
  CHECK(OrientationDmp::fit(rotation(600, 2.0, 60.0)).options().basis_count == 200);
  CHECK(PoseDmp::fit(noisy_reach(0.0, 60.0)).options().basis_count == 200);
  CHECK(PoseDmp::fit(noisy_reach(1e-3, 60.0)).options().basis_count == 200);
  CHECK(PoseDmp::fit(noisy_reach(5e-3, 60.0)).options().basis_count == 100);
  CHECK(PoseDmp::fit(noisy_reach(5e-3, 20.0)).options().basis_count == 25);
}

TEST_CASE("kernels suffice for a quarter of the error that smoothing leaves") {
  const Demonstration clean = helix(600, 2.0, .1, .2, 8);
  CHECK(Dmp::fit(clean).options().basis_count == 100);
  RowMatrix noisy = clean.position();
  for (int k = 0; k < 600; ++k)
    noisy.row(k) += 1e-3 * Eigen::RowVector3d(std::sin(7e3 * k), std::sin(8e3 * k), std::sin(9e3 * k));
  const Dmp model = Dmp::fit(clean.with(noisy));
  CHECK(model.options().derivatives == Derivatives::smooth);
  CHECK(model.options().basis_count == 200);
}

TEST_CASE("targets of demonstrations with other ends carry the scale that a joint fit divides by") {
  DmpOptions options;
  options.scaling = Scaling::per_axis_relative;
  const Demonstration near = reach(100, 1.0);
  const Demonstration far = near.with(2.0 * near.position());
  const auto targets = Dmp::targets({near, far}, options);
  for (int d = 0; d < 3; ++d) {
    CHECK(targets[0].scale[d] == doctest::Approx(1.0 / 1.5));
    CHECK(targets[1].scale[d] == doctest::Approx(2.0 / 1.5));
  }
}

TEST_CASE("a model with other weights keeps all else, and its motion is linear in them") {
  const Dmp model = Dmp::fit(helix(300, 2.0, .1, .2, 2));
  const Dmp none = model.with_weights(0.0 * model.parameters().weights);
  const Dmp half = model.with_weights(0.5 * model.parameters().weights);
  CHECK(half.goal() == model.goal());
  CHECK(half.options() == model.options());
  const RowMatrix middle = 0.5 * (model.rollout().position + none.rollout().position);
  CHECK((half.rollout().position - middle).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("weights of another size are refused where they come from") {
  DmpOptions options;
  options.basis_count = 100;
  const Dmp model = Dmp::fit(reach(100, 1.0), options);
  CHECK(message_of([&] { model.with_weights(RowMatrix::Zero(99, 3)); }) ==
        "weights: 99 x 3, expected 100 x 3 (kernels x axes).");
  const Learner wrong = [](const GaussianBasis&, const std::vector<ForcingTarget>&) {
    return RowMatrix(RowMatrix::Zero(3, 2));
  };
  CHECK(message_of([&] { Dmp::fit(reach(100, 1.0), options, wrong); }) ==
        "learner: weights: 3 x 2, expected 100 x 3 (kernels x axes).");
}

TEST_CASE("the condition of the regression is had for the options as they come") {
  const double condition = regression_condition(DmpOptions{});
  CHECK(std::isfinite(condition));
  CHECK(condition > 1.0);
  DmpOptions narrow;
  narrow.overlap = -1.0;
  CHECK(message_of([&] { regression_condition(narrow); }).find("overlap") != std::string::npos);
}

TEST_CASE(
    "a model whose rotations turn along takes no scaling by (goal - start), however the form is chosen") {
  DmpOptions options;
  options.orientation_form = OrientationForm::turning;
  PoseDmpParameters parameters = PoseDmp::fit(pose(100, 2.0), options).parameters();
  parameters.options.orientation_form = OrientationForm::automatic;
  parameters.options.scaling = Scaling::per_axis;
  CHECK(message_of([&] { PoseDmp model(parameters); }).find("scaling") != std::string::npos);
}
