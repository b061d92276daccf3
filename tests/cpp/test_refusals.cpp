// Every number that can be given to dmp::core, replaced by every bad one; see refusals.hpp.
#include <doctest/doctest.h>
#include <dmp/batch.hpp>
#include <dmp/dtw.hpp>
#include <dmp/error.hpp>
#include <dmp/fit_report.hpp>
#include <dmp/phase.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/spread.hpp>

#include "motions.hpp"
#include "refusals.hpp"

using namespace dmp;
using namespace refusals;

namespace {

using Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;

const PoseDemonstration& demonstrated() {
  static const PoseDemonstration demonstration = motions::pose_with_goal_apart(12, 1.0);
  return demonstration;
}
const VectorXd& times() { return demonstrated().time(); }
const RowMatrix& positions() { return demonstrated().position().position(); }
const Rotations& rotations() { return demonstrated().orientation().rotation(); }
Poses poses() { return demonstrated().pose(); }

DmpOptions few(Scaling scaling = Scaling::none) {
  DmpOptions options;
  options.basis_count = 5;
  options.scaling = scaling;
  return options;
}

// What the calls below ask of each of the three kinds of model.
const Demonstration& demonstration_of(const Dmp*) { return demonstrated().position(); }
const OrientationDemonstration& demonstration_of(const OrientationDmp*) {
  return demonstrated().orientation();
}
const PoseDemonstration& demonstration_of(const PoseDmp*) { return demonstrated(); }
template <class Model>
Model model(const DmpOptions& options = few()) {
  return Model::fit(demonstration_of(static_cast<const Model*>(nullptr)), options);
}

template <class Model>
void check_rollouts(const std::string& kind) {
  const Model learned = model<Model>();
  check(
      kind + "::rollout",
      [&](const auto& goal, double duration, double dt) { return learned.rollout(goal, duration, dt); },
      argument("goal", learned.goal()), argument("duration", 1.0), argument("dt", 0.1));
  check(
      kind + "::rollout_at",
      [&](const VectorXd& at, const auto& goal, double duration) {
        return learned.rollout_at(at, goal, duration);
      },
      any_size("times", times()), argument("goal", learned.goal()), argument("duration", 1.0));
  check(
      kind + "::forcing", [&](const VectorXd& s) { return learned.forcing().evaluate(s); },
      any_size("s", times()));
}

/// fit and rollout with one option replaced.
template <class Model, class Value, class Member>
void check_option(const char* name, Member member, Value good) {
  check(
      name,
      [&](Value value) {
        DmpOptions options = few();
        options.*member = value;
        return model<Model>(options).rollout({}, {}, 0.1);
      },
      argument(name, good));
}

template <class Model>
void check_options() {
  check_option<Model>("basis_count", &DmpOptions::basis_count, 5);
  check_option<Model>("passes", &DmpOptions::passes, 2);
  check_option<Model>("alpha", &DmpOptions::alpha, 25.0);
  check_option<Model>("beta", &DmpOptions::beta, 6.0);
  check_option<Model>("orientation_alpha", &DmpOptions::orientation_alpha, 25.0);
  check_option<Model>("orientation_beta", &DmpOptions::orientation_beta, 6.0);
  check_option<Model>("alpha_x", &DmpOptions::alpha_x, 4.0);
  check_option<Model>("overlap", &DmpOptions::overlap, 0.5);
  check_option<Model>("ridge", &DmpOptions::ridge, 1e-9);
  check_option<Model>("goal_filter", &DmpOptions::goal_filter, 20.0);
  check_option<Model>("tempo_filter", &DmpOptions::tempo_filter, 0.1);
  check_option<Model>("phase_stop", &DmpOptions::phase_stop, 1.0);
}

template <class Model, class Parameters, class Value>
void check_parameter(const std::string& entry, const Parameters& good, Value Parameters::* member) {
  check(
      entry,
      [&](const Value& value) {
        Parameters parameters = good;
        parameters.*member = value;
        return Model(parameters).rollout({}, {}, 0.1);
      },
      argument("value", good.*member));
}

}  // namespace

TEST_CASE("demonstrations, their splines and what is asked of them") {
  check(
      "Demonstration", [](const VectorXd& t, const RowMatrix& y) { return Demonstration(t, y).at(t); },
      argument("times", times()), argument("positions", positions()));
  check(
      "OrientationDemonstration",
      [](const VectorXd& t, const Rotations& r) { return OrientationDemonstration(t, r).at(t); },
      argument("times", times()), argument("rotations", rotations()));
  check(
      "PoseDemonstration", [](const VectorXd& t, const Poses& p) { return PoseDemonstration(t, p).pose(); },
      argument("times", times()), argument("poses", poses()));
  check(
      "from_euler",
      [](const VectorXd& t, const RowMatrix& a) {
        return OrientationDemonstration::from_euler(t, a, "ZYX").at(t);
      },
      argument("times", times()), argument("angles", positions()));
  RowMatrix quaternions = RowMatrix::Zero(times().size(), 4);
  quaternions.col(0).setOnes();
  check(
      "OrientationDemonstration::from_quaternions",
      [](const VectorXd& t, const RowMatrix& q) {
        return OrientationDemonstration::from_quaternions(t, q, "wxyz").at(t);
      },
      argument("times", times()), argument("quaternions", quaternions));
  check(
      "PoseDemonstration::from_quaternions",
      [](const VectorXd& t, const RowMatrix& y, const RowMatrix& q) {
        return PoseDemonstration::from_quaternions(t, y, q, "wxyz").pose();
      },
      argument("times", times()), argument("positions", positions()), argument("quaternions", quaternions));
  check(
      "Demonstration::at", [](const VectorXd& t) { return demonstrated().position().at(t); },
      any_size("times", times()));
  check(
      "OrientationDemonstration::at", [](const VectorXd& t) { return demonstrated().orientation().at(t); },
      any_size("times", times()));
  check(
      "Demonstration::with", [](const RowMatrix& y) { return demonstrated().position().with(y).at(times()); },
      argument("positions", positions()));
  check(
      "OrientationDemonstration::with",
      [](const Rotations& r) { return demonstrated().orientation().with(r).at(times()); },
      argument("rotations", rotations()));
  check(
      "PoseDemonstration::with", [](const Poses& p) { return demonstrated().with(p).pose(); },
      argument("poses", poses()));
  check(
      "smoothed", [](const VectorXd& t, const RowMatrix& y) { return Demonstration(t, y).smoothed().at(t); },
      argument("times", times()), argument("positions", positions()));
}

TEST_CASE("motions that are compared, averaged or learned in numbers") {
  check(
      "align", [](const RowMatrix& a, const RowMatrix& b, double band) { return align(a, b, band).distance; },
      any_size("a", positions()), any_size("b", positions()), or_infinite("band", 5.0));
  check(
      "align of poses",
      [](const Poses& a, const Poses& b, double weight) { return align(a, b, weight).distance; },
      any_size("a", poses()), any_size("b", poses()), argument("angle_weight", 0.2));
  check(
      "frechet", [](const RowMatrix& a, const RowMatrix& b) { return frechet(a, b); },
      any_size("a", positions()), any_size("b", positions()));
  check(
      "assess",
      [](double position, double angle) {
        return assess(model<PoseDmp>(), {demonstrated()}, {position, angle}).rmse;
      },
      or_infinite("position", 1e-3), or_infinite("angle", 1e-2));
  check(
      "fit_each",
      [](const VectorXd& t, const Poses& p) { return fit_each(t, std::vector<Poses>{p}, few())[0].start(); },
      argument("times", times()), argument("poses", poses()));
  check(
      "rollout_each",
      [](const VectorXd& goal, const VectorXd& durations) {
        return rollout_each(model<Dmp>(), {goal}, durations, 5)[0];
      },
      argument("goal", VectorXd(positions().row(5))), any_size("durations", VectorXd(VectorXd::Ones(1))));
  for (const Eigen::Index count : {Eigen::Index(-1), Eigen::Index(0), Eigen::Index(1)}) {
    CHECK_THROWS_AS(spread({demonstrated()}, count), InvalidArgument);
    CHECK_THROWS_AS(rollout_each(model<Dmp>(), {}, VectorXd::Ones(1), count), InvalidArgument);
  }
}

TEST_CASE("rollouts of every kind of model") {
  check_rollouts<Dmp>("Dmp");
  check_rollouts<OrientationDmp>("OrientationDmp");
  check_rollouts<PoseDmp>("PoseDmp");
}

TEST_CASE("options of every kind of model") {
  check_options<Dmp>();
  check_options<OrientationDmp>();
  check_options<PoseDmp>();
}

TEST_CASE("parameters that a model is made of") {
  for (const Scaling scaling :
       {Scaling::none, Scaling::per_axis, Scaling::per_axis_relative, Scaling::rotation_dilation}) {
    const auto p = model<Dmp>(few(scaling)).parameters();
    check_parameter<Dmp>("Dmp duration", p, &DmpParameters::duration);
    check_parameter<Dmp>("Dmp start", p, &DmpParameters::start);
    check_parameter<Dmp>("Dmp goal", p, &DmpParameters::goal);
    check_parameter<Dmp>("Dmp start_velocity", p, &DmpParameters::start_velocity);
    check_parameter<Dmp>("Dmp amplitude", p, &DmpParameters::amplitude);
    check_parameter<Dmp>("Dmp weights", p, &DmpParameters::weights);
    const auto r = model<OrientationDmp>(few(scaling)).parameters();
    check_parameter<OrientationDmp>("OrientationDmp start", r, &OrientationDmpParameters::start);
    check_parameter<OrientationDmp>("OrientationDmp goal", r, &OrientationDmpParameters::goal);
    check_parameter<OrientationDmp>("OrientationDmp start_velocity", r,
                                    &OrientationDmpParameters::start_velocity);
    check_parameter<OrientationDmp>("OrientationDmp start_error", r, &OrientationDmpParameters::start_error);
    check_parameter<OrientationDmp>("OrientationDmp amplitude", r, &OrientationDmpParameters::amplitude);
    check_parameter<OrientationDmp>("OrientationDmp weights", r, &OrientationDmpParameters::weights);
    const auto q = model<PoseDmp>(few(scaling)).parameters();
    check_parameter<PoseDmp>("PoseDmp start", q, &PoseDmpParameters::start);
    check_parameter<PoseDmp>("PoseDmp goal", q, &PoseDmpParameters::goal);
    check_parameter<PoseDmp>("PoseDmp start_twist", q, &PoseDmpParameters::start_twist);
    check_parameter<PoseDmp>("PoseDmp weights", q, &PoseDmpParameters::weights);
  }
}

TEST_CASE("splines by themselves") {
  const Spline good(times(), positions());
  check(
      "Spline", [](const VectorXd& t, const RowMatrix& y) { return Spline(t, y).sample(t).second; },
      argument("times", times()), argument("values", positions()));
  check(
      "smoothing",
      [](const VectorXd& t, const RowMatrix& y) { return Spline::smoothing(t, y).sample(t).value; },
      argument("times", times()), argument("values", positions()));
  check(
      "through", [&](const RowMatrix& y) { return good.through(y).sample(times()).value; },
      argument("values", positions()));
}

TEST_CASE("targets of a forcing term") {
  const DmpOptions options = Dmp::fit(demonstrated().position(), few()).options();
  const GaussianBasis basis = GaussianBasis::equal_in_time(5, options.alpha_x, *options.overlap);
  check(
      "fit_forcing",
      [&](const VectorXd& s, const RowMatrix& value, const VectorXd& scale) {
        return fit_forcing(basis, {{s, value, scale}}, options);
      },
      argument("s", times()), argument("value", positions()), argument("scale", VectorXd(VectorXd::Ones(3))));
}

TEST_CASE("kernels, phases and forcing terms by themselves") {
  check(
      "equal_in_time",
      [](int count, double alpha_x, double overlap) {
        return GaussianBasis::equal_in_time(std::min(count, 100001), alpha_x, overlap)
            .activations(VectorXd::Zero(1));
      },
      argument("count", 5), argument("alpha_x", 4.0), argument("overlap", 0.5));
  check(
      "source", [](int count, double alpha_x) { return GaussianBasis::source(count, alpha_x).centers(); },
      argument("count", 5), argument("alpha_x", 4.0));
  const GaussianBasis basis = GaussianBasis::equal_in_time(5, 4.0, 0.5);
  check("activations", [&](const VectorXd& s) { return basis.activations(s, true); }, any_size("s", times()));
  check(
      "ForcingTerm", [&](const RowMatrix& w) { return ForcingTerm(basis, w).evaluate(times()); },
      argument("weights", RowMatrix(RowMatrix::Ones(5, 2))));
  check(
      "Phase",
      [](double duration, double alpha_x, double filter, double gain) {
        Phase phase(duration, alpha_x, filter, gain);
        phase.advance(0.01);
        return phase.s() + phase.x();
      },
      argument("duration", 1.0), argument("alpha_x", 4.0), argument("filter", 0.1),
      argument("stop_gain", 1.0));
}

TEST_CASE("rotations that are checked, and those of a control loop, which answer whatever is finite") {
  check(
      "from_euler", [](const Eigen::Vector3d& a) { return so3::from_euler(a, "ZYX"); },
      argument("angles", Eigen::Vector3d(.1, .2, .3)));
  const Eigen::Matrix3d r = rotations()[3];
  check(
      "require_rotation", [](const Eigen::Matrix3d& m) { return so3::require_rotation(m, "r"), m; },
      argument("r", r));
  check("to_euler", [](const Eigen::Matrix3d& m) { return so3::to_euler(m, "ZYX"); }, argument("r", r));
  for (const double size : {0.0, 5e-324, 1e-300, 1e-8, 1.0, 1e6, 1e154, 1e308, -1e308}) {
    CAPTURE(size);
    const Eigen::Vector3d v = Eigen::Vector3d(.6, 0, .8) * size;
    CHECK(so3::exp(v).allFinite());
    CHECK(so3::exp_quaternion(v).coeffs().allFinite());
    CHECK(so3::left_jacobian(v).allFinite());
    CHECK(so3::log(so3::exp(v)).allFinite());
  }
}

TEST_CASE("An error carries the argument that its message names first") {
  const auto argument = [](const char* message) { return dmp::InvalidArgument(message).argument(); };
  CHECK(argument("goal[2]: nan, expected a finite number.") == "goal");
  CHECK(argument("position[0, 1]: 3, expected 2.") == "position");
  CHECK(argument("options.alpha: -1, expected > 0.") == "options");
  CHECK(argument("basis_count: 0, expected > 0.") == "basis_count");
  CHECK(argument("'file.csv': line 3: no number.") == "");
  CHECK(argument("no way: found") == "");
  CHECK(argument("hand.csv: unit: unknown.") == "");
  CHECK(argument("goal[2: nan") == "");
  CHECK(argument("2nd: x") == "");
  CHECK(argument("") == "");
}
