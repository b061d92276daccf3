#include <doctest/doctest.h>
#include <dmp/error.hpp>

#include <random>

#include "motions.hpp"
#include "run_values.hpp"

using namespace dmp;
using namespace motions;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
OrientationDmp unforced(const Vector3d& goal, OrientationForm form) {
  OrientationDmpParameters p;
  p.options.basis_count = 5;
  p.options.orientation_form = form;
  p.goal = so3::exp(goal);
  p.start_error = goal;
  p.weights = RowMatrix::Zero(5, 3);
  return OrientationDmp(p);
}

AngleErrors reproduction(const OrientationDemonstration& demonstration, const DmpOptions& options) {
  return angles(OrientationDmp::fit(demonstration, options).rollout_at(demonstration.time()).rotation,
                demonstration.rotation());
}

const double kDegree = M_PI / 180;
}  // namespace

TEST_CASE("about a fixed axis the spring alone follows its closed form, in both forms of the equation") {
  const Vector3d axis = Vector3d(1, 2, 2) / 3;
  for (const auto form : {OrientationForm::ude, OrientationForm::log_linear}) {
    const auto rollout = unforced(2 * axis, form).rollout_at(Eigen::Vector2d(.1, .5));
    const double tolerance = form == OrientationForm::ude ? 1e-6 : 1e-13;
    CHECK((so3::log(rollout.rotation[0]) - .71072841412914455 * axis).norm() < tolerance);
    CHECK((so3::log(rollout.rotation[1]) - 1.9720084150246982 * axis).norm() < tolerance);
  }
}

TEST_CASE("the Euler path is reproduced through pi, with few kernels too") {
  DmpOptions ridge = stated();
  ridge.regression = Regression::ridge;
  CHECK(reproduction(rotation(1000, 4.995, 3.0), stated()).rmse < .0005 * kDegree);
  CHECK(reproduction(rotation(1000, 4.995, 3.0), ridge).rmse < 1e-5 * kDegree);
  CHECK(reproduction(rotation(1000, 4.995, 4.995), {}).rmse < .001 * kDegree);
  DmpOptions fifty;
  fifty.basis_count = 50;
  CHECK(reproduction(rotation(1000, 4.995, 4.995), fifty).rmse < .01 * kDegree);
  DmpOptions log_linear;
  log_linear.orientation_form = OrientationForm::log_linear;
  CHECK(reproduction(rotation(1000, 4.995, 4.995), log_linear).rmse < .001 * kDegree);
}

TEST_CASE("the shortest logarithm jumps on the way through pi: why the branch is followed") {
  DmpOptions principal;
  principal.log_branch = LogBranch::principal;
  const double jumped = reproduction(rotation(1000, 10.0, 10.0), principal).largest;
  const double followed = reproduction(rotation(1000, 10.0, 10.0), {}).largest;
  MESSAGE("shortest: " << jumped << " rad, followed: " << followed << " rad");
  CHECK(jumped > 10 * followed);
}

TEST_CASE("a reach that turns by pi to 2 pi is reproduced") {
  const Eigen::VectorXd t = grid(1000, 4.995);
  for (const double turn : {M_PI, 1.2 * M_PI, 1.5 * M_PI, 2 * M_PI}) {
    Rotations r;
    for (const double u : t)
      r.push_back(so3::exp(turn * minimum_jerk(u / 4.995) * Vector3d(1, 2, 3).normalized()));
    CHECK(reproduction({t, r}, {}).rmse < .01 * kDegree);
  }
}

TEST_CASE("rotations stay rotations and the step is of fourth order") {
  const OrientationDmp dmp = OrientationDmp::fit(rotation(1000, 1.0, 3.0));
  const auto end = [&](double dt) { return dmp.rollout({}, {}, dt).rotation; };
  const Rotations fine = end(1e-4);
  const double coarse = so3::distance(end(.004)[125], fine[5000]);
  const double half = so3::distance(end(.002)[250], fine[5000]);
  CHECK(coarse / half > 10.0);
  for (const Matrix3d& r : fine)
    CHECK((r * r.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("Euler's rule goes to the same motion in both forms, in proportion to its step") {
  for (const auto form : {OrientationForm::ude, OrientationForm::log_linear}) {
    DmpOptions options;
    options.orientation_form = form;
    const auto demonstration = rotation(1000, 4.995, 2.0);
    const OrientationDmp exact = OrientationDmp::fit(demonstration, options);
    OrientationDmpParameters parameters = exact.parameters();
    parameters.options.integrator = Integrator::semi_implicit_euler;
    const OrientationDmp by_euler(parameters);
    const auto miss = [&](double dt) {
      return angles(by_euler.rollout({}, {}, dt).rotation, exact.rollout({}, {}, dt).rotation).largest;
    };
    const double coarse = miss(2e-3);
    CHECK(coarse < 0.02);
    CHECK(miss(1e-3) < 0.55 * coarse);
    CHECK(miss(1e-3) > 0.45 * coarse);
  }
}

TEST_CASE("a rotation of the body frame from the right goes through unchanged") {
  const OrientationDemonstration here = rotation(300, 2.0, 3.0);
  const Matrix3d q = so3::exp({.4, -1.0, .7});
  Rotations turned;
  for (const Matrix3d& r : here.rotation()) turned.push_back(r * q);
  const Rotations a = OrientationDmp::fit(here).rollout({}, {}, .01).rotation;
  const Rotations b = OrientationDmp::fit({here.time(), turned}).rollout({}, {}, .01).rotation;
  for (std::size_t k = 0; k < a.size(); ++k) CHECK(so3::distance(a[k] * q, b[k]) < 1e-11);
}

TEST_CASE(
    "turning the world from the left goes through the spring alone, and not through an unscaled forcing "
    "term") {
  const Matrix3d q = so3::exp({.4, -1.0, .7});
  const auto difference = [&](const OrientationDmp& dmp) {
    OrientationRun here(dmp);
    OrientationRun there(dmp);
    there.start_from(q * dmp.start(), q * dmp.parameters().start_velocity);
    there.set_goal(q * dmp.goal());
    double most = 0.0;
    for (int i = 0; i < 200; ++i) {
      here.step(.01);
      there.step(.01);
      most = std::max(most, so3::distance(q * here.rotation(), there.rotation()));
    }
    return most;
  };
  OrientationDmpParameters p = OrientationDmp::fit(rotation(300, 2.0, 3.0)).parameters();
  CHECK(difference(OrientationDmp(p)) > 1e-2);
  p.weights.setZero();
  p.advance.setZero();
  CHECK(difference(OrientationDmp(p)) < 1e-12);
}

TEST_CASE("a run follows the rollout; angular velocity and acceleration are derivatives in the world frame") {
  for (const auto form : {OrientationForm::ude, OrientationForm::log_linear}) {
    DmpOptions options;
    options.orientation_form = form;
    const OrientationDmp dmp = OrientationDmp::fit(rotation(400, 2.0, 3.0), options);
    OrientationRun run(dmp);
    const double h = 1e-6;
    for (int i = 0; i < 19; ++i) {
      run.step(.1);
      OrientationRun next = run;
      next.step(h);
      const Vector3d velocity = so3::log(Matrix3d(next.rotation() * run.rotation().transpose())) / h;
      CHECK((velocity - run.angular_velocity()).norm() < 1e-4);
      CHECK(((next.angular_velocity() - run.angular_velocity()) / h - run.angular_acceleration()).norm() <
            1e-2);
    }
    CHECK(run.step(.1) == Status::finished);
    CHECK(so3::distance(run.rotation(), dmp.goal()) < 1e-3);
  }
}

TEST_CASE("a goal that changes on the way is reached, in both forms") {
  for (const auto form : {OrientationForm::ude, OrientationForm::log_linear}) {
    DmpOptions options;
    options.orientation_form = form;
    const OrientationDmp dmp = OrientationDmp::fit(rotation(400, 2.0, 3.0), options);
    OrientationRun run(dmp);
    for (int i = 0; i < 500; ++i) run.step(1e-3);
    const Vector3d before = run.angular_velocity();
    const Matrix3d goal = so3::exp({.3, .2, -.4}) * dmp.goal();
    CHECK(run.set_goal(goal) == Status::running);
    run.step(1e-3);
    CHECK((run.angular_velocity() - before).norm() < .05);
    for (int i = 0; i < 4500; ++i) run.step(1e-3);
    CHECK(so3::distance(run.rotation(), goal) < 1e-6);
    CHECK(so3::distance(run.goal(), goal) < 1e-12);
  }
}

TEST_CASE("what is no rotation is refused and changes nothing") {
  const OrientationDmp dmp = OrientationDmp::fit(rotation(100, 1.0, 1.0));
  OrientationRun run(dmp);
  run.step(.3);
  const Matrix3d now = run.rotation();
  CHECK(run.set_goal(2 * Matrix3d::Identity()) == Status::invalid_input);
  CHECK(run.set_goal(-Matrix3d::Identity()) == Status::invalid_input);
  CHECK(run.start_from(Matrix3d::Identity(), Vector3d(NAN, 0, 0)) == Status::invalid_input);
  CHECK(run.rotation() == now);
  CHECK_THROWS_AS(dmp.rollout(Matrix3d(2 * Matrix3d::Identity())), InvalidArgument);
  CHECK_THROWS_AS(OrientationDmp::fit(std::vector<OrientationDemonstration>{}), InvalidArgument);
}

TEST_CASE("several demonstrations are learned together; start and goal are means on SO(3)") {
  const OrientationDmp dmp = OrientationDmp::fit(
      std::vector<OrientationDemonstration>{rotation(200, 1.0, 3.0), rotation(500, 2.0, 3.0)});
  CHECK(dmp.duration() == doctest::Approx(1.5));
  const OrientationDemonstration truth = rotation(300, 1.5, 3.0);
  CHECK(angles(dmp.rollout_at(truth.time()).rotation, truth.rotation()).largest < .01 * kDegree);
}

TEST_CASE("differences of samples teach nearly what the spline does") {
  const OrientationDemonstration demonstration = rotation(500, 2.0, 2.0);
  DmpOptions differences;
  differences.derivatives = Derivatives::gradient;
  const auto again =
      OrientationDmp::fit(demonstration, differences).rollout_at(demonstration.time()).rotation;
  const auto spline = OrientationDmp::fit(demonstration).rollout_at(demonstration.time()).rotation;
  CHECK(angles(again, demonstration.rotation()).rmse < 5e-3);
  CHECK(angles(again, demonstration.rotation()).rmse > angles(spline, demonstration.rotation()).rmse);
}

TEST_CASE("smoothing brings a noisy rotation closer to the truth than half of its noise") {
  const OrientationDemonstration truth = rotation(401, 2.0, 1.5);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 5e-3);
  Rotations shaken;
  for (const Eigen::Matrix3d& r : truth.rotation())
    shaken.push_back(so3::exp({noise(random), noise(random), noise(random)}) * r);
  DmpOptions smooth;
  smooth.derivatives = Derivatives::smooth;
  smooth.start = Start::rest;
  const auto again = OrientationDmp::fit({truth.time(), shaken}, smooth);
  CHECK(again.rollout({}, {}, .01).angular_velocity.row(0).norm() == 0.0);
  smooth.start = Start::demonstrated;
  const auto learned = OrientationDmp::fit({truth.time(), shaken}, smooth).rollout_at(truth.time()).rotation;
  CHECK(angles(learned, truth.rotation()).rmse < .5 * std::sqrt(3.0) * 5e-3);
}

TEST_CASE("two samples of an orientation are a spring alone, which turns straight to the goal") {
  const Eigen::Vector3d turn(.4, -.3, .2);
  const OrientationDemonstration ends(Eigen::Vector2d(0, 1), {Eigen::Matrix3d::Identity(), so3::exp(turn)});
  const OrientationDmp dmp = OrientationDmp::fit(ends);
  CHECK(dmp.parameters().weights.norm() == 0.0);
  const Eigen::Matrix3d quarter = dmp.rollout_at(Eigen::VectorXd::Constant(1, .25)).rotation[0];
  CHECK((so3::log(quarter) - .8187601488034444 * turn).norm() < 1e-7);
}

TEST_CASE("runs of orientations are values") {
  run_values::check<OrientationRun>(OrientationDmp::fit(rotation(200, 2.0, 2.0)),
                                    OrientationDmp::fit(rotation(100, 1.0, 1.0)),
                                    [](const OrientationRun& run) { return run.rotation(); });
}

TEST_CASE("a pause holds an orientation, and it goes on to its goal") {
  const OrientationDmp dmp = OrientationDmp::fit(rotation(200, 2.0, 2.0));
  OrientationRun run(dmp);
  for (int i = 0; i < 500; ++i) run.step(1e-3);
  run.pause();
  for (int i = 0; i < 2000; ++i) run.step(1e-3);
  const double held = run.phase();
  for (int i = 0; i < 100; ++i) run.step(1e-3);
  CHECK(run.phase() - held < 1e-6);
  run.resume();
  for (int i = 0; i < 6000; ++i) run.step(1e-3);
  CHECK(so3::distance(run.rotation(), dmp.goal()) < 1e-6);
}

namespace {
/// A minimum-jerk turn about (1, 2, 3) with a wobble of 17 degrees across.
OrientationDemonstration turn(double degrees, int count = 500) {
  const Eigen::VectorXd t = grid(count, 4.0);
  const Vector3d axis = Vector3d(1, 2, 3).normalized();
  const Vector3d across = axis.cross(Vector3d::UnitX()).normalized();
  Rotations r;
  for (int k = 0; k < count; ++k) {
    const double s = minimum_jerk(t[k] / 4.0);
    r.push_back(so3::exp(0.3 * std::sin(3 * M_PI * s) * across) * so3::exp(degrees * kDegree * s * axis));
  }
  return {t, r};
}

struct Effort {
  double rate;
  double travel;
};
Effort effort_of(const OrientationTrajectory& motion) {
  const Eigen::VectorXd rate = motion.angular_velocity.rowwise().norm();
  return {rate.maxCoeff(), rate.sum() * motion.time[1]};
}
}  // namespace

TEST_CASE("turns of one to three times around are reproduced, and no start or goal makes them whirl") {
  for (const double degrees : {300.0, 360.0, 370.0, 720.0, 1080.0}) {
    CAPTURE(degrees);
    const OrientationDemonstration shown = turn(degrees);
    const OrientationDmp dmp = OrientationDmp::fit(shown, stated());
    CHECK(dmp.options().orientation_form == OrientationForm::turning);
    CHECK(reproduction(shown, stated()).rmse < .002 * kDegree);
    const Effort shown_effort = effort_of(dmp.rollout({}, {}, .004));
    for (const double off : {5.0, 20.0, 60.0, 150.0})
      for (const Vector3d& axis :
           {Vector3d(1, 0, 0), Vector3d(0, -1, 1), Vector3d(1, 2, 3), Vector3d(-1, 1, -1)}) {
        const Eigen::Matrix3d goal = so3::exp(off * kDegree * axis.normalized()) * dmp.goal();
        const OrientationTrajectory motion = dmp.rollout(goal, {}, .004);
        const Effort effort = effort_of(motion);
        CHECK(effort.rate < (off > 60 ? 2.0 : off > 20 ? 1.3 : 1.1) * shown_effort.rate);
        CHECK(effort.travel < shown_effort.travel + 1.05 * off * kDegree);
        CHECK(so3::distance(motion.rotation.back(), goal) < .02 * kDegree);
      }
  }
}

TEST_CASE("a turning run starts anywhere, follows a goal without a jump and gives its own derivatives") {
  const OrientationDmp dmp = OrientationDmp::fit(turn(370), stated());
  OrientationRun run(dmp);
  run.start_from(so3::exp({.3, -.5, .2}) * dmp.start(), {.1, .2, -.3});
  const double dt = 1e-4;
  Eigen::Quaterniond before = run.quaternion();
  Vector3d rate = run.angular_velocity();
  CHECK((rate - Vector3d(.1, .2, -.3)).norm() < 1e-12);
  for (int k = 0; k < 40000; ++k) {
    if (k == 15000) run.set_goal(so3::exp({1.0, .5, -2.0}) * dmp.goal());
    run.step(dt);
    const Vector3d mean = so3::log(Eigen::Quaterniond(run.quaternion() * before.conjugate())) / dt;
    CHECK((mean - 0.5 * (rate + run.angular_velocity())).norm() < 1e-4);
    CHECK((run.angular_velocity() - rate).norm() < 0.05);
    before = run.quaternion();
    rate = run.angular_velocity();
  }
  run.reset();
  CHECK(so3::distance(run.rotation(), dmp.start()) < 1e-12);
}

TEST_CASE("what a turning model turns with must be there, and whole") {
  OrientationDmpParameters parameters = OrientationDmp::fit(turn(370), stated()).parameters();
  CHECK(parameters.reference.rows() == 3);
  const auto refused = [&](const char* reason) {
    CHECK_THROWS_WITH_AS(OrientationDmp{parameters}, doctest::Contains(reason), InvalidArgument);
  };
  const RowMatrix reference = parameters.reference;
  parameters.reference.row(1).setZero();
  refused("comes nearer to 0");
  parameters.reference = 2.0 * reference;
  refused("reference[0]: of length 2");
  parameters.reference = reference.leftCols(3);
  refused("reference: 3 x 3");
  parameters.reference = RowMatrix();
  refused("reference: none");
  parameters.options.orientation_form = OrientationForm::ude;
  parameters.reference = reference;
  refused("reference: given");
  DmpOptions scaled;
  scaled.orientation_form = OrientationForm::turning;
  scaled.scaling = Scaling::per_axis_relative;
  CHECK_THROWS_WITH_AS(OrientationDmp::fit(turn(100), scaled), doctest::Contains("options.scaling"),
                       InvalidArgument);
}

TEST_CASE("several takes turn along with one rotation") {
  const OrientationDmp dmp = OrientationDmp::fit({turn(350), turn(370), turn(390)}, stated());
  CHECK(dmp.options().orientation_form == OrientationForm::turning);
  const Effort effort = effort_of(dmp.rollout({}, {}, .004));
  CHECK(effort.travel ==
        doctest::Approx(effort_of(OrientationDmp::fit(turn(370), stated()).rollout({}, {}, .004)).travel)
            .epsilon(.02));
}

TEST_CASE("scaled turns beyond 3 rad are learned in the log-linear form, on the principal branch never") {
  DmpOptions options = stated();
  options.scaling = Scaling::per_axis_relative;
  const auto form_of = [&](double degrees) {
    return OrientationDmp::fit(turn(degrees), options).options().orientation_form;
  };
  CHECK(form_of(150) == OrientationForm::ude);
  CHECK(form_of(200) == OrientationForm::log_linear);
  options.log_branch = LogBranch::principal;
  CHECK(form_of(200) == OrientationForm::ude);
}

TEST_CASE("a goal that is set on the way of a turning run is met, and counts at once for a new start") {
  const OrientationDmp dmp = OrientationDmp::fit(turn(370), stated());
  const Eigen::Matrix3d goal = so3::exp({.3, -.6, .2}) * dmp.goal();
  OrientationRun run(dmp);
  for (int k = 0; k < 300; ++k) run.step(.01);
  run.set_goal(goal);
  OrientationRun fresh(dmp);
  fresh.set_goal(goal);
  OrientationRun again(run);
  for (int k = 0; k < 700; ++k) run.step(.01);
  CHECK(so3::distance(run.rotation(), goal) < 1e-6);
  again.start_from(dmp.start(), Vector3d::Zero());
  fresh.start_from(dmp.start(), Vector3d::Zero());
  for (int k = 0; k < 100; ++k) {
    again.step(.01);
    fresh.step(.01);
  }
  CHECK(again.rotation() == fresh.rotation());
}

TEST_CASE("a turning form rests where its own spring balances a push") {
  DmpOptions options = stated();
  options.orientation_alpha = 20.0;
  options.orientation_beta = 3.0;
  options.orientation_form = OrientationForm::turning;
  const OrientationDmp dmp = OrientationDmp::fit(turn(370), options);
  OrientationRun run(dmp);
  const Vector3d push(0.0, 0.0, 6.0);
  for (int k = 0; k < 4000; ++k)
    run.step(.01, [&](const CouplingState<RotationSpace>&) noexcept { return push; });
  CHECK(so3::distance(run.rotation(), dmp.goal()) == doctest::Approx(6.0 / (20.0 * 3.0)).epsilon(1e-6));
}
