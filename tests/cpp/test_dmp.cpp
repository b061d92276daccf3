#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <random>

#include "motions.hpp"
#include "run_values.hpp"

using namespace dmp;
using namespace motions;

namespace {
double after(const Dmp& dmp, double time) {
  return dmp.rollout_at(Eigen::VectorXd::Constant(1, time)).position(0, 0);
}
Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }
}  // namespace

TEST_CASE("the spring alone follows its closed form at any step: critical, overdamped, underdamped") {
  const Dmp critical = spring(0, 1, 1);
  CHECK(after(critical, .1) == doctest::Approx(.35536420706457227).epsilon(1e-13));
  CHECK(after(critical, .25) == doctest::Approx(.8187601488034444).epsilon(1e-13));
  CHECK(after(critical, 1.) == doctest::Approx(.99994969018217694).epsilon(1e-13));
  const Trajectory coarse = critical.rollout({}, {}, .05);
  const Trajectory fine = critical.rollout({}, {}, .0005);
  for (int k = 0; k <= 20; ++k) CHECK(std::abs(coarse.position(k, 0) - fine.position(100 * k, 0)) < 1e-13);
  CHECK(coarse.velocity(5, 0) == doctest::Approx(1.7162864696643522).epsilon(1e-13));
  const Dmp source = spring(0, 1, 1, 25, 4);
  CHECK(after(source, .1) == doctest::Approx(.23640421479535967).epsilon(1e-13));
  CHECK(after(source, .5) == doctest::Approx(.89056846847805577).epsilon(1e-13));
  const Dmp underdamped = spring(0, 1, 1, 10, 4);
  CHECK(after(underdamped, .25) == doctest::Approx(.53288639026258699).epsilon(1e-13));
  CHECK(after(underdamped, .81115573519472238) == doctest::Approx(1.017321986715757614).epsilon(1e-13));
}

TEST_CASE("tau is a duration: at twice the time there is the same place and half the velocity") {
  const Dmp slow = spring(0, 1, 2);
  const Trajectory at = slow.rollout_at(one(.5));
  CHECK(at.position(0, 0) == doctest::Approx(.8187601488034444).epsilon(1e-13));
  CHECK(at.velocity(0, 0) == doctest::Approx(.85814323483217612).epsilon(1e-13));
}

TEST_CASE("a constant force moves the rest position by f / (alpha beta)") {
  DmpParameters p = spring(0, 1, 1).parameters();
  p.options.basis_count = 1;
  p.options.alpha_x = 1e-12;
  p.weights = RowMatrix::Constant(1, 1, 10.0);
  CHECK(after(Dmp(p), .25) == doctest::Approx(.87116079832686485).epsilon(1e-10));
}

TEST_CASE("one kernel has a closed form through phase, forcing term and spring") {
  DmpParameters p = spring(0, 1, 1, 25, 4).parameters();
  p.options.basis_count = 1;
  p.options.alpha_x = 1.0;
  p.weights = RowMatrix::Constant(1, 1, 50.0);
  const Dmp dmp(p);
  CHECK(after(dmp, .1) == doctest::Approx(.34999280553859692).epsilon(1e-8));
  CHECK(after(dmp, .5) == doctest::Approx(1.2212055966164099).epsilon(1e-8));
  CHECK(after(dmp, 1.) == doctest::Approx(1.2274270640230787).epsilon(1e-8));
}

TEST_CASE("a rollout has samples at 0, dt, .. and at its duration") {
  const Dmp dmp = spring(0, 1, 1);
  CHECK(dmp.rollout({}, {}, .1).time.size() == 11);
  CHECK(dmp.rollout({}, {}, .3).time.size() == 5);
  CHECK(dmp.rollout({}, 2.0, 1e-3).time.size() == 2001);
  CHECK(dmp.rollout({}, {}, .3).time[3] == doctest::Approx(.9));
  CHECK(dmp.rollout({}, {}, .3).time[4] == 1.0);
}

TEST_CASE("100 kernels reproduce the helix and the reach; ridge regression a hundred times closer") {
  const Demonstration turning = helix(1000, 4.995, .1, .2, 999 * .05 / (2 * M_PI));
  const Demonstration reaching = reach(1000, 4.995);
  DmpOptions ridge = stated();
  ridge.regression = Regression::ridge;
  const auto error = [](const Demonstration& demonstration, const DmpOptions& options) {
    return rmse(Dmp::fit(demonstration, options).rollout_at(demonstration.time()).position,
                demonstration.position());
  };
  CHECK(error(turning, stated()) < .06e-3);
  CHECK(error(reaching, stated()) < .0015e-3);
  CHECK(error(turning, ridge) < .001e-3);
  CHECK(error(reaching, ridge) < 1e-8);
}

TEST_CASE(
    "the default is nowhere less exact than 100 kernels of locally weighted regression, and takes few") {
  const Demonstration turning = helix(1000, 4.995, .1, .2, 999 * .05 / (2 * M_PI));
  const Demonstration reaching = reach(1000, 4.995);
  for (const Demonstration& demonstration : {turning, reaching}) {
    const auto error = [&](const Dmp& dmp) {
      return rmse(dmp.rollout_at(demonstration.time()).position, demonstration.position());
    };
    CHECK(error(Dmp::fit(demonstration)) < error(Dmp::fit(demonstration, stated())));
  }
  CHECK(Dmp::fit(reaching).options().basis_count == 25);
  CHECK(Dmp::fit(turning).options().basis_count > 50);
  const DmpOptions used = Dmp::fit(reaching).options();
  CHECK(used.regression == Regression::ridge);
  CHECK(used.derivatives == Derivatives::interpolate);
  CHECK_FALSE(used.automatic());
}

TEST_CASE(
    "a stated number of passes is locally weighted regression; a model of weights leaves nothing open") {
  DmpOptions textbook;
  textbook.passes = 1;
  CHECK(Dmp::fit(reach(100, 1.0), textbook).options().regression == Regression::lwr);
  CHECK_FALSE(DmpOptions::source().automatic());
  CHECK(DmpOptions().automatic());
  DmpParameters parameters = Dmp::fit(reach(100, 1.0)).parameters();
  parameters.options = {};
  CHECK(Dmp(parameters).options().basis_count == static_cast<int>(parameters.weights.rows()));
  CHECK_FALSE(Dmp(parameters).options().automatic());
}

TEST_CASE("noise is not learned: the default comes as close to the truth as the best smoothing") {
  const Demonstration truth = reach(800, 4.0);
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 1e-3);
    RowMatrix y = truth.position();
    for (Eigen::Index k = 0; k < y.size(); ++k) y.data()[k] += noise(random);
    const Dmp learned = Dmp::fit(Demonstration(truth.time(), y));
    CHECK(learned.options().derivatives == Derivatives::smooth);
    CHECK(learned.options().basis_count <= 50);
    CHECK(rmse(learned.rollout_at(truth.time()).position, truth.position()) < .4e-3);
  }
}

TEST_CASE("the source's equations make the source's errors, the default a thousandth of them") {
  const Eigen::VectorXd t = grid(201, 1.0);
  RowMatrix y(201, 3);
  for (int k = 0; k < 201; ++k) y.row(k) << std::sin(.05 * k), std::cos(.05 * k), 2.0 * k;
  const Demonstration demonstration(t, y);
  const auto worst = [&](const DmpOptions& options) -> Eigen::Vector3d {
    return (Dmp::fit(demonstration, options).rollout({}, {}, .005).position - y)
        .cwiseAbs()
        .colwise()
        .maxCoeff();
  };
  const Eigen::Vector3d source = worst(DmpOptions::source());
  CHECK(source[0] == doctest::Approx(.327).epsilon(.02));
  CHECK(source[1] == doctest::Approx(.116).epsilon(.02));
  CHECK(source[2] == doctest::Approx(10.5).epsilon(.02));
  const Eigen::Vector3d ours = worst({});
  for (int d = 0; d < 3; ++d) CHECK(ours[d] < 1e-3 * source[d]);
}

TEST_CASE("few samples for the kernels: the spline between them is learned") {
  const Demonstration few = helix(60, 2.0, .1, .2, 1.5);
  const Demonstration many = helix(2000, 2.0, .1, .2, 1.5);
  const Trajectory rollout = Dmp::fit(few).rollout_at(many.time());
  CHECK(largest(rollout.position, many.position()) < 1e-4);
}

TEST_CASE("rollouts at 20 Hz, 200 Hz and 1 kHz agree where they meet") {
  const Dmp dmp = Dmp::fit(helix(201, 1.0, 1.0, 400, 10 / (2 * M_PI)));
  const Trajectory slow = dmp.rollout({}, {}, .05);
  const Trajectory middle = dmp.rollout({}, {}, .005);
  const Trajectory fast = dmp.rollout({}, {}, .001);
  for (int k = 0; k <= 20; ++k) {
    CHECK((slow.position.row(k) - middle.position.row(10 * k)).norm() < 1e-6 * 400);
    CHECK((slow.position.row(k) - fast.position.row(50 * k)).norm() < 1e-6 * 400);
  }
}

TEST_CASE("translation: start and goal moved together move the path, bit by rounding") {
  const Demonstration here = reach(300, 2.0);
  const Eigen::RowVector3d far(3.0, -2.0, 5.0);
  const Demonstration there(here.time(), here.position().rowwise() + far);
  const RowMatrix a = Dmp::fit(here).rollout({}, {}, .01).position;
  const RowMatrix b = Dmp::fit(there).rollout({}, {}, .01).position;
  CHECK(largest(a.rowwise() + far, b) < 1e-11);
}

TEST_CASE("time: duration and step doubled give the same samples bit for bit, half the velocity") {
  const Dmp dmp = Dmp::fit(reach(300, 2.0));
  const Trajectory a = dmp.rollout({}, 2.0, .01);
  const Trajectory b = dmp.rollout({}, 4.0, .02);
  CHECK(a.position == b.position);
  CHECK(a.velocity == 2.0 * b.velocity);
}

TEST_CASE("per-axis scaling: the path scales with the goal, mirrored too; without scaling it does not") {
  DmpOptions options;
  options.scaling = Scaling::per_axis;
  const Demonstration demonstration = reach(300, 2.0);
  for (const double k : {2.0, -2.5}) {
    const Eigen::VectorXd goal = k * demonstration.position().row(299);
    const Dmp scaled = Dmp::fit(demonstration, options);
    const RowMatrix expected = k * scaled.rollout({}, {}, .01).position;
    CHECK(largest(scaled.rollout(goal, {}, .01).position, expected) < 1e-12);
    options.scaling = Scaling::none;
    const Dmp plain = Dmp::fit(demonstration, options);
    options.scaling = Scaling::per_axis;
    CHECK(largest(plain.rollout(goal, {}, .01).position, expected) > 1e-3);
  }
}

TEST_CASE("rotation-dilation scaling: a rotated, dilated goal gives the rotated, dilated path") {
  DmpOptions options;
  options.scaling = Scaling::rotation_dilation;
  const Dmp dmp = Dmp::fit(reach(300, 2.0), options);
  const Eigen::Vector3d from = dmp.goal().normalized();
  const Eigen::Vector3d to = Eigen::Vector3d(-1, .5, .2).normalized();
  const Eigen::Matrix3d turn = so3::exp(std::acos(from.dot(to)) * from.cross(to).normalized());
  const RowMatrix expected = 1.7 * dmp.rollout({}, {}, .01).position * turn.transpose();
  CHECK(largest(dmp.rollout(Eigen::VectorXd(1.7 * turn * dmp.goal()), {}, .01).position, expected) < 1e-11);
  const RowMatrix opposite = dmp.rollout(Eigen::VectorXd(-dmp.goal()), {}, .01).position;
  CHECK(opposite.allFinite());
  CHECK((opposite.row(200).transpose() + dmp.goal()).norm() < 1e-3);
}

TEST_CASE("a closed loop whose goal moves keeps its size, unless (g - y0) scales it") {
  const Eigen::VectorXd t = grid(500, 2.0);
  RowMatrix y(500, 2);
  for (int k = 0; k < 500; ++k) {
    const double m = 2 * M_PI * minimum_jerk(t[k] / 2.0);
    y.row(k) << .1 * std::sin(m), .1 * std::cos(m) + .001 * minimum_jerk(t[k] / 2.0);
  }
  const Demonstration loop(t, y);
  for (const Scaling scaling : {Scaling::none, Scaling::per_axis_relative, Scaling::advance}) {
    DmpOptions options;
    options.scaling = scaling;
    const Dmp dmp = Dmp::fit(loop, options);
    const Eigen::VectorXd goal = dmp.goal() + Eigen::Vector2d(.05, 0);
    const RowMatrix moved = dmp.rollout(goal, {}, .005).position;
    CHECK(moved.cwiseAbs().maxCoeff() < .25);
    CHECK((moved.row(400).transpose() - goal).norm() < 1e-3);
  }
  DmpOptions source;
  source.scaling = Scaling::per_axis;
  source.scaling_guard = false;
  CHECK_THROWS_AS(Dmp::fit(Demonstration(t, RowMatrix(y.col(0))), source), InvalidArgument);
}

TEST_CASE("several demonstrations of different duration and sampling are learned together") {
  std::vector<Demonstration> demonstrations;
  for (const int count : {200, 500, 900}) demonstrations.push_back(reach(count, 1.0 + count / 300.0));
  const Dmp dmp = Dmp::fit(demonstrations);
  CHECK(dmp.duration() == doctest::Approx((1 + 200 / 300. + 1 + 500 / 300. + 4) / 3));
  const Demonstration truth = reach(400, dmp.duration());
  CHECK(largest(dmp.rollout_at(truth.time()).position, truth.position()) < 1e-4);
}

TEST_CASE("a run steps through the rollout, whatever the steps, and ends") {
  const Dmp dmp = Dmp::fit(reach(300, 2.0));
  const Trajectory rollout = dmp.rollout({}, {}, 1e-3);
  Run run(dmp);
  CHECK(run.position() == dmp.start());
  int steps = 0;
  while (run.step(1e-3) == Status::running) {
    ++steps;
    REQUIRE(run.position().transpose() == rollout.position.row(steps));
    REQUIRE(run.velocity().transpose() == rollout.velocity.row(steps));
    REQUIRE(run.acceleration().transpose() == rollout.acceleration.row(steps));
  }
  CHECK(steps == 1999);
  CHECK(run.phase() == doctest::Approx(1.0));
  Run uneven(dmp);
  for (int i = 0; i < 100; ++i) {
    uneven.step(.013);
    uneven.step(.007);
  }
  CHECK((uneven.position() - run.position()).norm() < 1e-6);
  run.step(10.0);
  CHECK((run.position() - dmp.goal()).norm() < 1e-12);
  CHECK(run.status() == Status::finished);
}

TEST_CASE("the acceleration is the derivative of the velocity, in a change of goal and duration too") {
  Run run(Dmp::fit(helix(400, 2.0, .1, .2, 1)));
  run.set_goal(Eigen::Vector3d(.1, .2, .3));
  run.set_duration(3.0);
  const double h = 1e-6;
  for (int i = 0; i < 50; ++i) {
    run.step(.03);
    Run before = run;
    before.step(h);
    const Eigen::VectorXd difference = (before.velocity() - run.velocity()) / h;
    CHECK((difference - .5 * (run.acceleration() + before.acceleration())).norm() <
          1e-3 * (1 + run.acceleration().norm()));
  }
}

TEST_CASE("a goal that changes on the way is reached without a jump of the acceleration") {
  const Dmp dmp = Dmp::fit(reach(300, 2.0));
  Run run(dmp);
  for (int i = 0; i < 1000; ++i) run.step(1e-3);
  const Eigen::VectorXd before = run.acceleration();
  const Eigen::VectorXd goal = dmp.goal() + Eigen::Vector3d(.1, 0, 0);
  CHECK(run.set_goal(goal) == Status::running);
  run.step(1e-3);
  CHECK((run.acceleration() - before).norm() < .1);  // 3.9 m/s^2 with no filter
  for (int i = 0; i < 3000; ++i) run.step(1e-3);
  CHECK((run.position() - goal).norm() < 1e-4);
}

TEST_CASE(
    "whatever scales the forcing term, a new goal makes no jump, and before the first step it counts at "
    "once") {
  for (const Scaling scaling : {Scaling::none, Scaling::per_axis, Scaling::per_axis_relative,
                                Scaling::rotation_dilation, Scaling::advance}) {
    DmpOptions options;
    options.scaling = scaling;
    const Dmp dmp = Dmp::fit(reach(300, 2.0), options);
    const Eigen::VectorXd goal = dmp.goal() + Eigen::Vector3d(.1, -.2, .3);
    Run run(dmp);
    for (int i = 0; i < 800; ++i) run.step(1e-3);
    const Eigen::VectorXd before = run.acceleration();
    run.set_goal(goal);
    run.step(1e-6);
    CHECK((run.acceleration() - before).norm() < .01);
    Run fresh(dmp);
    fresh.set_duration(3.0);
    fresh.set_goal(goal);
    const Trajectory rollout = dmp.rollout(goal, 3.0, 1e-2);
    for (int k = 1; k <= 300; ++k) {
      fresh.step(1e-2);
      REQUIRE(fresh.position().transpose() == rollout.position.row(k));
    }
  }
}

TEST_CASE("the source's integrator takes one Euler step for each of its own, several for larger ones") {
  const Dmp dmp = Dmp::fit(reach(400, 2.0), DmpOptions::source());
  for (const double dt : {.01, .1, .2}) CHECK(dmp.rollout({}, {}, dt).position.cwiseAbs().maxCoeff() < 1.0);
}

TEST_CASE("the goal filter has its closed form") {
  DmpParameters p = spring(0, 0, 1).parameters();
  p.options.alpha = 1e4;
  p.options.beta = std::nullopt;
  Run run{Dmp(p)};
  run.step(0.2);
  run.set_goal(one(1.0));
  run.step(.1);
  const double filtered = .9179150013761012;  // 1 - exp(-2.5)
  CHECK(run.position()[0] == doctest::Approx(filtered).epsilon(1e-3));
}

TEST_CASE("a duration that changes on the way keeps the path") {
  const Dmp dmp = Dmp::fit(helix(400, 2.0, .1, .2, 1));
  const Trajectory path = dmp.rollout({}, {}, 1e-4);
  Run run(dmp);
  for (int i = 0; i < 200; ++i) {
    if (i == 50) run.set_duration(5.0);
    if (i == 120) run.set_duration(1.0);
    run.step(.01);
    if (run.phase() >= 1.0) break;
    const auto k = static_cast<Eigen::Index>(std::lround(run.phase() * 20000));
    CHECK((run.position().transpose() - path.position.row(k)).norm() < 1e-4);
  }
}

TEST_CASE("a pause stops on the path and the motion goes on from there; a tracking error slows it") {
  DmpParameters p = Dmp::fit(helix(400, 2.0, .1, .2, 1)).parameters();
  p.options.phase_stop = 100.0;
  const Dmp dmp(p);
  const Trajectory path = dmp.rollout({}, {}, 1e-4);
  Run run(dmp);
  for (int i = 0; i < 6000; ++i) {
    if (i == 500) run.pause();
    if (i == 2000) run.resume();
    if (i == 2500) run.set_tracking_error(.02);
    if (i == 3000) run.set_tracking_error(0.0);
    const Eigen::VectorXd velocity = run.velocity();
    run.step(1e-3);
    CHECK((run.velocity() - velocity).norm() < .02);
    if (i == 1999) CHECK(run.velocity().norm() < 1e-5);
    if (i == 2999) CHECK(run.velocity().norm() < .5 * path.velocity.rowwise().norm().maxCoeff());
    if (run.phase() >= 1.0) break;
    const auto k = static_cast<Eigen::Index>(std::lround(run.phase() * 20000));
    CHECK((run.position().transpose() - path.position.row(k)).norm() < 1e-4);
  }
  CHECK(run.status() == Status::finished);
  CHECK(run.time() > 3.5);
  CHECK(run.set_tracking_error(-1.0) == Status::invalid_input);
}

TEST_CASE("a run may begin anywhere, with any velocity") {
  const Dmp dmp = Dmp::fit(reach(300, 2.0));
  Run run(dmp);
  CHECK(run.start_from(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(.1, 0, -.1)) == Status::running);
  CHECK(run.position() == Eigen::Vector3d(1, 2, 3));
  CHECK((run.velocity() - Eigen::Vector3d(.1, 0, -.1)).norm() < 1e-15);
  for (int i = 0; i < 4000; ++i) run.step(1e-3);
  CHECK((run.position() - dmp.goal()).norm() < 1e-6);
  run.reset();
  CHECK(run.position() == dmp.start());
  CHECK(run.time() == 0.0);
}

TEST_CASE("what the loop cannot use is refused and changes nothing") {
  const Dmp dmp = Dmp::fit(reach(300, 2.0));
  Run run(dmp);
  run.step(.5);
  const Eigen::VectorXd position = run.position();
  for (const double dt : {-1e-3, static_cast<double>(NAN), static_cast<double>(INFINITY), 1e9})
    CHECK(run.step(dt) == Status::invalid_input);
  CHECK(run.set_goal(Eigen::Vector3d(0, NAN, 0)) == Status::invalid_input);
  CHECK(run.set_goal(Eigen::Vector2d(0, 0)) == Status::invalid_input);
  CHECK(run.set_duration(0.0) == Status::invalid_input);
  CHECK(run.start_from(Eigen::Vector3d(0, INFINITY, 0), Eigen::Vector3d::Zero()) == Status::invalid_input);
  CHECK(run.position() == position);
  CHECK(run.goal() == dmp.goal());
  CHECK(run.status() == Status::running);
}

TEST_CASE("a state that leaves the finite numbers is reported and the last finite output kept") {
  Run run(Dmp::fit(reach(300, 2.0)));
  run.start_from(Eigen::Vector3d::Constant(1e308), Eigen::Vector3d::Constant(1e308));
  Status status = Status::running;
  for (int i = 0; i < 2000 && status == Status::running; ++i) status = run.step(1e-3);
  CHECK(status == Status::not_finite);
  CHECK(run.position().allFinite());
  CHECK(run.step(1e-3) == Status::not_finite);
  run.reset();
  CHECK(run.step(1e-3) == Status::running);
}

TEST_CASE("degenerate demonstrations give sensible motions") {
  const Dmp still = Dmp::fit(Demonstration(grid(20, 1.0), RowMatrix::Constant(20, 2, 3.0)));
  CHECK((still.rollout({}, {}, .01).position.array() - 3.0).abs().maxCoeff() < 1e-12);
  RowMatrix two(2, 1);
  two << 0.0, 1.0;
  CHECK(Dmp::fit(Demonstration(Eigen::Vector2d(0, 1), two)).rollout({}, {}, .01).position.allFinite());
  DmpOptions one_kernel;
  one_kernel.basis_count = 1;
  CHECK(Dmp::fit(reach(300, 2.0), one_kernel).rollout({}, {}, .01).position.allFinite());
}

TEST_CASE("options and arguments outside their ranges are refused with their name") {
  const Demonstration demonstration = reach(100, 1.0);
  const auto refused = [&](auto change, const char* name) {
    DmpOptions options;
    change(options);
    CHECK_THROWS_WITH_AS(Dmp::fit(demonstration, options), doctest::Contains(name), InvalidArgument);
  };
  refused([](DmpOptions& o) { o.basis_count = -1; }, "options.basis_count");
  refused([](DmpOptions& o) { o.alpha = -1; }, "options.alpha");
  refused([](DmpOptions& o) { o.beta = NAN; }, "options.beta");
  refused([](DmpOptions& o) { o.passes = 0; }, "options.passes");
  refused([](DmpOptions& o) { o.ridge = -1; }, "options.ridge");
  refused([](DmpOptions& o) { o.overlap = 0; }, "options.overlap");
  const Dmp dmp = Dmp::fit(demonstration);
  CHECK_THROWS_WITH_AS(dmp.rollout(Eigen::VectorXd(Eigen::Vector2d(0, 0))),
                       doctest::Contains("goal: 2 numbers, expected 3"), InvalidArgument);
  CHECK_THROWS_WITH_AS(dmp.rollout(Eigen::VectorXd(Eigen::Vector3d(0, NAN, 0))), doctest::Contains("goal[1]"),
                       InvalidArgument);
  CHECK_THROWS_AS(dmp.rollout({}, -1.0), InvalidArgument);
  CHECK_THROWS_AS(dmp.rollout({}, {}, 0.0), InvalidArgument);
  CHECK_THROWS_AS(dmp.rollout({}, {}, 1e-12), InvalidArgument);
  CHECK_THROWS_AS(dmp.rollout_at(Eigen::Vector2d(1.0, 0.5)), InvalidArgument);
  CHECK_THROWS_AS(Dmp::fit(std::vector<Demonstration>{}), InvalidArgument);
  CHECK_THROWS_AS(
      Dmp::fit(std::vector<Demonstration>{demonstration, Demonstration(grid(9, 1.0), RowMatrix::Zero(9, 2))}),
      InvalidArgument);
}

TEST_CASE("Euler's rule follows a moving goal with its scale, as the exact step does") {
  DmpOptions options;
  options.scaling = Scaling::per_axis_relative;
  options.goal_filter = 25.0;
  DmpOptions euler = options;
  euler.integrator = Integrator::semi_implicit_euler;
  Run exact(Dmp::fit(reach(300, 1.0), options));
  Run simple(Dmp::fit(reach(300, 1.0), euler));
  const Eigen::VectorXd goal = 2.0 * exact.goal();
  for (int i = 0; i < 5000; ++i) {
    exact.step(1e-4);
    simple.step(1e-4);
    if (i == 100) exact.set_goal(goal);
    if (i == 100) simple.set_goal(goal);
  }
  CHECK((exact.position() - simple.position()).norm() < 2e-3);
}

TEST_CASE("a spring far stiffer than its damping follows its closed form at any step") {
  // u'' + 10 u' + 10^7 u = 0: an oscillation of 3162 rad in a unit of phase, damped with exp(-5 s).
  const double omega = std::sqrt(1e7 - 25.0);
  const auto place = [&](double s) {
    return 1.0 - std::exp(-5.0 * s) * (std::cos(omega * s) + 5.0 / omega * std::sin(omega * s));
  };
  const Dmp stiff = spring(0, 1, 1, 10, 1e6);
  for (const double s : {.001, .01, .1, .37, 1.0})
    CHECK(after(stiff, s) == doctest::Approx(place(s)).epsilon(1e-9));
}

TEST_CASE("runs are values: assigned and moved they go on as the original would") {
  run_values::check<Run>(Dmp::fit(reach(100, 1.0)), Dmp::fit(helix(100, 3.0, .1, .2, 2)),
                         [](const Run& run) { return run.position(); });
}

TEST_CASE("what ridge regression cannot solve is refused with what to do") {
  DmpOptions options;
  options.regression = Regression::ridge;
  options.basis_count = 4001;
  CHECK_THROWS_WITH_AS(Dmp::fit(reach(100, 1.0), options), doctest::Contains("at most 4000"),
                       InvalidArgument);
  options.basis_count = 300;
  options.ridge = 0.0;
  options.overlap = 1e-3;
  CHECK_THROWS_WITH_AS(Dmp::fit(reach(100, 1.0), options), doctest::Contains("options.ridge"),
                       InvalidArgument);
}

TEST_CASE("a run that begins anew on the way begins at the first phase, wherever it was") {
  const Dmp dmp = Dmp::fit(reach(100, 1.0));
  Run run(dmp), fresh(dmp);
  for (int i = 0; i < 400; ++i) run.step(1e-3);
  const Eigen::Vector3d place(.1, .2, .3), velocity(.3, 0, -.1);
  CHECK(run.start_from(place, velocity) == Status::running);
  CHECK(fresh.start_from(place, velocity) == Status::running);
  CHECK(run.phase() == 0.0);
  CHECK(run.time() == 0.0);
  for (int i = 0; i < 400; ++i) {
    run.step(1e-3);
    fresh.step(1e-3);
    REQUIRE(run.position() == fresh.position());
  }
}

TEST_CASE("demonstrations of different dimensions are refused with both numbers") {
  const Demonstration line(grid(9, 1.0), RowMatrix::Zero(9, 1)), plane(grid(9, 1.0), RowMatrix::Zero(9, 2));
  CHECK_THROWS_WITH_AS(Dmp::fit(std::vector<Demonstration>{plane, plane, line}),
                       doctest::Contains("demonstrations[2]: 1 dimensions, expected 2 as in the first"),
                       InvalidArgument);
  CHECK_THROWS_WITH_AS(Dmp::fit(std::vector<Demonstration>{plane, line}),
                       doctest::Contains("demonstrations[1]: 1 dimensions, expected 2 as in the first"),
                       InvalidArgument);
}

TEST_CASE("a number that is no enumerator is refused, whoever made it one") {
  DmpOptions options;
  options.scaling = static_cast<Scaling>(9);
  CHECK_THROWS_WITH_AS(Dmp::fit(reach(30, 1.0), options), doctest::Contains("options.scaling: 9"),
                       InvalidArgument);
  options = {};
  options.integrator = static_cast<Integrator>(-1);
  CHECK_THROWS_WITH_AS(Dmp::fit(reach(30, 1.0), options), doctest::Contains("options.integrator: -1"),
                       InvalidArgument);
}
