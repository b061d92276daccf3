// What a run or a phase refuses leaves no trace: it goes on as one that was never asked, bit for bit.
#include <doctest/doctest.h>
#include <dmp/phase.hpp>
#include <dmp/pose_dmp.hpp>

#include <cstring>
#include <vector>

#include "motions.hpp"
#include "refusals.hpp"

using namespace dmp;
using namespace refusals;

namespace {

using Eigen::VectorXd;
using Numbers = std::vector<double>;

void append(Numbers& all, double value) { all.push_back(value); }
template <class Derived>
void append(Numbers& all, const Eigen::MatrixBase<Derived>& matrix) {
  const RowMatrix table = matrix;
  all.insert(all.end(), table.data(), table.data() + table.size());
}
template <class... Values>
Numbers numbers(const Values&... values) {
  Numbers all;
  (append(all, values), ...);
  return all;
}

// All that each kind of run shows.
Numbers shown(const Run& run) {
  return numbers(run.position(), run.velocity(), run.acceleration(), run.goal(), run.time(), run.phase(),
                 run.duration());
}
Numbers shown(const OrientationRun& run) {
  return numbers(run.rotation(), run.quaternion().coeffs(), run.angular_velocity(),
                 run.angular_acceleration(), run.goal(), run.time(), run.phase(), run.duration());
}
Numbers shown(const PoseRun& run) {
  return numbers(run.pose(), run.twist(), run.acceleration(), run.goal(), run.time(), run.phase(),
                 run.duration());
}

bool same(const Numbers& a, const Numbers& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool all_finite(const Numbers& all) {
  for (const double value : all)
    if (!std::isfinite(value)) return false;
  return true;
}

/// Both show the same now and after each of some steps: nothing hidden differs either.
template <class AnyRun>
bool same_future(AnyRun a, AnyRun b) {
  for (int i = 0; i < 20; ++i) {
    if (!same(shown(a), shown(b)) || a.status() != b.status() || a.paused() != b.paused()) return false;
    if (a.step(0.05) != b.step(0.05)) return false;
  }
  return true;
}

template <class AnyRun, class Call, class T>
void check_call(const AnyRun& run, const Call& call, const Argument<T>& argument) {
  for (const auto& bad_value : bad(argument)) {
    CAPTURE(argument.name);
    CAPTURE(bad_value.name);
    AnyRun trial(run);
    const Status status = call(trial, bad_value.value);
    if (status == Status::invalid_input) {
      CHECK(same_future(trial, run));
      continue;
    }
    CHECK_FALSE(bad_value.never);
    for (int i = 0; i < 20; ++i) trial.step(0.05);
    CHECK(all_finite(shown(trial)));
  }
}

template <class AnyRun, class Place, class Velocity>
void check_run(AnyRun run, const Place& place, const Velocity& velocity) {
  run.step(0.3);
  check_call(run, [](AnyRun& r, double dt) { return r.step(dt); }, argument("dt", 0.1));
  check_call(
      run, [](AnyRun& r, double duration) { return r.set_duration(duration); }, argument("duration", 1.0));
  check_call(
      run, [](AnyRun& r, double error) { return r.set_tracking_error(error); }, argument("error", 0.1));
  check_call(run, [](AnyRun& r, const Place& goal) { return r.set_goal(goal); }, argument("goal", place));
  check_call(
      run, [&](AnyRun& r, const Place& start) { return r.start_from(start, velocity); },
      argument("place", place));
  check_call(
      run, [&](AnyRun& r, const Velocity& start) { return r.start_from(place, start); },
      argument("velocity", velocity));
}

DmpOptions options_of(Scaling scaling, Integrator integrator) {
  DmpOptions options;
  options.basis_count = 5;
  options.scaling = scaling;
  options.integrator = integrator;
  options.phase_stop = 10.0;
  return options;
}

template <class Check>
void for_all_options(const Check& check_with) {
  for (const Scaling scaling :
       {Scaling::none, Scaling::per_axis, Scaling::per_axis_relative, Scaling::rotation_dilation})
    for (const Integrator integrator : {Integrator::exact, Integrator::semi_implicit_euler})
      check_with(options_of(scaling, integrator));
}

}  // namespace

TEST_CASE("a run of positions is as it was after a refusal") {
  const Demonstration demonstration = motions::helix(50, 1.0, .1, .2, 1.3);
  for_all_options([&](const DmpOptions& options) {
    const Run run(Dmp::fit(demonstration, options));
    check_run(run, VectorXd(run.goal()), VectorXd(run.velocity()));
  });
}

TEST_CASE("a run of orientations is as it was after a refusal") {
  const OrientationDemonstration demonstration = motions::rotation(50, 1.0, 1.0);
  for_all_options([&](const DmpOptions& options) {
    const OrientationRun run(OrientationDmp::fit(demonstration, options));
    check_run(run, run.goal(), Eigen::Vector3d(run.angular_velocity()));
  });
}

TEST_CASE("a run of poses is as it was after a refusal") {
  const PoseDemonstration demonstration = motions::pose_with_goal_apart(50, 1.0);
  for_all_options([&](const DmpOptions& options) {
    const PoseRun run(PoseDmp::fit(demonstration, options));
    check_run(run, run.goal(), run.twist());
  });
}

TEST_CASE("a phase is as it was after a refusal") {
  Phase phase(1.0, 4.0, 0.1, 1.0);
  phase.advance(0.3);
  const auto state = [](const Phase& p) {
    return numbers(p.s(), p.x(), p.time(), p.duration(), p.speed(), p.speed_rate());
  };
  for (const auto& number : bad_numbers(false)) {
    CAPTURE(number.name);
    for (bool (Phase::*set)(double) noexcept : {&Phase::set_duration, &Phase::set_tracking_error}) {
      Phase trial = phase;
      const bool taken = (trial.*set)(number.value);
      CHECK_FALSE((taken && number.never));
      if (!taken) CHECK(same(state(trial), state(phase)));
      trial.advance(0.1);
      CHECK(all_finite(state(trial)));
    }
  }
}

TEST_CASE(
    "a goal or start that was printed with four decimals is taken by the rollout and by the run alike") {
  const PoseDmp model = PoseDmp::fit(motions::pose(100, 1.0));
  Eigen::Matrix4d exact = model.goal();
  exact.topLeftCorner<3, 3>() *= so3::exp({0.3, -0.2, 0.1});
  const Eigen::Matrix4d printed = (exact * 1e4).array().round() / 1e4;
  REQUIRE((printed - exact).norm() > 1e-6);

  PoseRun run(model);
  CHECK(run.set_goal(printed) == Status::running);
  const Eigen::Matrix3d taken = run.goal().topLeftCorner<3, 3>();
  CHECK((taken.transpose() * taken - Eigen::Matrix3d::Identity()).norm() < 1e-14);
  CHECK(so3::distance(taken, so3::nearest_rotation(printed.topLeftCorner<3, 3>())) < 1e-14);
  const Eigen::Matrix4d rolled = model.rollout(printed).pose.back();
  while (run.step(1e-3) == Status::running) continue;
  CHECK((run.pose() - rolled).norm() < 1e-6);
  CHECK(run.start_from(printed, Eigen::Matrix<double, 6, 1>::Zero()) == Status::running);

  OrientationRun turn(OrientationDmp::fit(motions::rotation(100, 1.0, 2.0)));
  CHECK(turn.set_goal(printed.topLeftCorner<3, 3>()) == Status::running);
  CHECK(turn.set_goal(1.001 * printed.topLeftCorner<3, 3>()) == Status::invalid_input);
}
