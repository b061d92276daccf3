// Via-points: passed exactly at their phase, with nothing changed outside their reach, and the goal kept.
#include <doctest/doctest.h>
#include <dmp/pose_gripper_dmp.hpp>

#include <limits>
#include <vector>

#include "allocations.hpp"
#include "cases.hpp"
#include "forms.hpp"
#include "motions.hpp"
#include "refusals.hpp"

using namespace dmp;
using namespace motions;

namespace {

const std::vector<OrientationForm> kForms{OrientationForm::ude, OrientationForm::log_linear,
                                          OrientationForm::turning};

Eigen::VectorXd times(double duration, int count = 1001) { return grid(count, duration); }

/// A pose away from where the model is at a phase.
Eigen::Matrix4d beside(const PoseDmp& model, double phase, const Eigen::Vector3d& way,
                       const Eigen::Vector3d& turn) {
  const PoseTrajectory at = model.rollout_at(Eigen::VectorXd::Constant(1, phase * model.duration()));
  const Eigen::Matrix3d rotation = so3::exp(turn) * at.pose[0].topLeftCorner<3, 3>();
  return pose_of(rotation, at.pose[0].topRightCorner<3, 1>() + way);
}

double apart(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) { return (a - b).norm(); }

/// Steps a run to a phase; the largest change of the acceleration within one step on the way.
template <class Run>
double step_to(Run& run, double phase, double dt) {
  double largest = 0.0;
  auto before = run.acceleration();
  while (run.phase() < phase - 1e-9) {
    run.step(std::min(dt, (phase - run.phase()) * run.duration()));
    largest = std::max(largest, (run.acceleration() - before).norm());
    before = run.acceleration();
  }
  return largest;
}

}  // namespace

TEST_CASE("a rollout passes a via-pose at its phase, keeps its goal, and changes nothing outside the reach") {
  for (const OrientationForm form : kForms) {
    const PoseDmp model = PoseDmp::fit(pose(200, 2.0), of_form(form));
    const Eigen::Matrix4d via = beside(model, 0.6, {0.1, -0.05, 0.08}, {0.4, 0.2, -0.3});
    const PoseTrajectory plain = model.rollout_at(times(2.0));
    const PoseTrajectory past = model.rollout_at(times(2.0), {}, {}, {{0.6, via, {}, {0.2, 0.3}}});
    CHECK(apart(past.pose[600], via) < 1e-9);
    for (int k = 0; k <= 1000; ++k) {
      if (k >= 400 && k <= 900) continue;
      REQUIRE(past.pose[static_cast<std::size_t>(k)] == plain.pose[static_cast<std::size_t>(k)]);
      REQUIRE(past.acceleration.row(k) == plain.acceleration.row(k));
    }
    // Nowhere farther from the motion than at the via-point.
    for (int k = 0; k <= 1000; ++k) {
      const auto at = static_cast<std::size_t>(k);
      CHECK((past.pose[at] - plain.pose[at]).topRightCorner<3, 1>().norm() <
            1.001 * Eigen::Vector3d(0.1, -0.05, 0.08).norm());
      CHECK(so3::distance(past.pose[at].topLeftCorner<3, 3>(), plain.pose[at].topLeftCorner<3, 3>()) <
            1.001 * Eigen::Vector3d(0.4, 0.2, -0.3).norm());
    }
  }
}

TEST_CASE("velocities and accelerations are the derivatives of the poses along a via-pose") {
  for (const OrientationForm form : kForms) {
    const PoseDmp model = PoseDmp::fit(pose(200, 2.0), of_form(form));
    const Eigen::Matrix4d via = beside(model, 0.5, {0.1, 0, 0}, {0.8, -0.5, 0.6});
    const PoseTrajectory t = model.rollout({}, 2.0, 1e-3, {{0.5, via, {}, 0.3}});
    double velocity = 0.0, acceleration = 0.0;
    for (Eigen::Index k = 1; k + 1 < t.time.size(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      const Eigen::Matrix4d &before = t.pose[at - 1], &after = t.pose[at + 1];
      Vector6 seen;
      seen << (after - before).topRightCorner<3, 1>() / 2e-3,
          so3::log(Eigen::Matrix3d(after.topLeftCorner<3, 3>() * before.topLeftCorner<3, 3>().transpose())) /
              2e-3;
      velocity = std::max(velocity, (seen.transpose() - t.twist.row(k)).norm());
      acceleration = std::max(
          acceleration, ((t.twist.row(k + 1) - t.twist.row(k - 1)) / 2e-3 - t.acceleration.row(k)).norm());
    }
    CHECK(velocity < 2e-3);
    CHECK(acceleration < 2e-2 * t.acceleration.rowwise().norm().maxCoeff());
  }
}

TEST_CASE("a via-point with a velocity has it there") {
  const PoseDmp model = PoseDmp::fit(pose(200, 2.0));
  const Eigen::Matrix4d via = beside(model, 0.5, {0.05, 0.02, 0}, {0.3, 0, 0.2});
  const Vector6 twist = (Vector6() << 0.2, -0.1, 0.05, 0.5, 0.3, -0.4).finished();
  for (const double duration : {1.0, 2.0, 5.0}) {
    const PoseTrajectory t =
        model.rollout_at(Eigen::VectorXd::Constant(1, 0.5 * duration), {}, duration, {{0.5, via, twist}});
    CHECK(apart(t.pose[0], via) < 1e-9);
    CHECK((t.twist.row(0).transpose() - twist).norm() < 1e-8);
  }
}

TEST_CASE("several via-points whose reaches overlap are all passed, without a jump") {
  const Dmp model = Dmp::fit(helix(200, 2.0, .1, .2, 2));
  const Trajectory plain = model.rollout_at(times(2.0));
  const auto at = [&](int k, double x, double y, double z) {
    return Eigen::VectorXd(plain.position.row(k).transpose() + Eigen::Vector3d(x, y, z));
  };
  const Eigen::VectorXd slow = Eigen::Vector3d(0.05, 0, 0);
  const std::vector<Via<VectorSpace>> vias{{0.2, at(200, .05, 0, .02), {}, 0.15},
                                           {0.3, at(300, .08, -.03, 0), {}, 0.15},
                                           {0.42, at(420, .02, .02, .05), slow, 0.15},
                                           {0.8, at(800, -.05, 0, 0), {}, {0.05, 0.4}}};
  const Trajectory past = model.rollout_at(times(2.0), {}, {}, vias);
  for (const Via<VectorSpace>& via : vias)
    CHECK((past.position.row(static_cast<int>(1000 * via.phase + .5)).transpose() - via.point).norm() < 1e-9);
  CHECK((past.velocity.row(420).transpose() - slow).norm() < 1e-8);
  CHECK((past.position - plain.position).topRows(51).norm() == 0.0);
  CHECK((past.position - plain.position).middleRows(571, 179).norm() == 0.0);
  CHECK((past.position.row(1000) - plain.position.row(1000)).norm() == 0.0);
  // The acceleration is continuous: its steps halve with the time between the samples.
  const auto steps = [&](int count) {
    const RowMatrix a = model.rollout_at(times(2.0, count), {}, {}, vias).acceleration;
    return (a.bottomRows(count - 1) - a.topRows(count - 1)).rowwise().norm().maxCoeff();
  };
  CHECK(steps(4001) < 0.55 * steps(2001));
}

TEST_CASE("the offset of a chain is smooth to the fourth derivative where its rates are free") {
  // Monotone on the way up: minimum jerk, so that third and fourth derivatives are continuous.
  const Dmp model = spring(0.0, 0.0, 1.0);
  const auto point = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  const std::vector<Via<VectorSpace>> vias{
      {0.3, point(1.0), {}, 0.2}, {0.5, point(3.0), {}, 0.2}, {0.6, point(4.0), {}, 0.3}};
  const Trajectory t = model.rollout_at(times(1.0, 10001), {}, {}, vias);
  const auto jerk = [&](int k) { return 1e4 * (t.acceleration(k + 1, 0) - t.acceleration(k, 0)); };
  const auto snap = [&](int k) { return jerk(k + 1) - jerk(k); };
  for (const int k : {3000, 5000}) CHECK(snap(k) == doctest::Approx(snap(k - 2)).epsilon(0.02));
}

TEST_CASE("a via-point set on the way, moved, and with a goal that moves, is passed exactly") {
  for (const Scaling scaling : {Scaling::none, Scaling::advance, Scaling::rotation_dilation})
    for (const double dt : {1e-3, 4e-3, 1.7e-2}) {
      DmpOptions options;
      options.scaling = scaling;
      options.tempo_filter = 0.0;  // so that a phase is met exactly
      const PoseDmp model = PoseDmp::fit(pose_with_goal_apart(200, 2.0), options);
      PoseRun run(model);
      Eigen::Matrix4d goal = model.goal();
      step_to(run, 0.3, dt);
      const Eigen::Matrix4d via = beside(model, 0.7, {0.1, 0, 0.05}, {0.3, -0.2, 0.1});
      CHECK(run.via(0.7, via, Reach(0.3)) == Status::running);
      step_to(run, 0.4, dt);
      goal(1, 3) += 0.1;
      run.set_goal(goal);
      step_to(run, 0.5, dt);
      Eigen::Matrix4d moving = via;
      while (run.phase() < 0.62) {
        moving(2, 3) += 1e-4;
        CHECK(run.move_via(0.7, moving) == Status::running);
        run.step(dt);
      }
      run.set_duration(3.0);
      step_to(run, 0.7, dt);
      CHECK(run.phase() == doctest::Approx(0.7).epsilon(1e-12));
      CHECK(apart(run.pose(), moving) < 1e-7);
      step_to(run, 2.0, dt);
      CHECK(apart(run.pose(), goal) < 1e-4);
    }
}

TEST_CASE("the acceleration stays continuous while goal and via-point are set and moved") {
  const PoseDmp model = PoseDmp::fit(pose(200, 2.0));
  const Eigen::Matrix4d via = beside(model, 0.7, {0.1, 0, 0.05}, {0.3, -0.2, 0.1});
  Eigen::Matrix4d goal = model.goal();
  goal(0, 3) += 0.1;
  const auto largest = [&](double dt) {
    PoseRun run(model);
    double jump = step_to(run, 0.4, dt);
    const Vector6 before = run.acceleration();
    run.via(0.7, via, Reach(0.3));
    run.step(0.0);
    CHECK((run.acceleration() - before).norm() < 1e-9);
    jump = std::max(jump, step_to(run, 0.5, dt));
    run.set_goal(goal);
    Eigen::Matrix4d moved = via;
    moved(1, 3) += 0.05;
    run.move_via(0.7, moved);
    return std::max(jump, step_to(run, 1.0, dt));
  };
  CHECK(largest(1e-3) < 0.55 * largest(2e-3));
}

TEST_CASE("a run without via-points and one whose via-point lies on its way are the same motion") {
  const PoseDmp model = PoseDmp::fit(pose(200, 2.0));
  PoseRun plain(model), past(model);
  past.via(0.5, beside(model, 0.5, {0, 0, 0}, {0, 0, 0}));
  for (int i = 0; i < 2000; ++i) {
    plain.step(1e-3);
    past.step(1e-3);
    REQUIRE(apart(plain.pose(), past.pose()) < 1e-8);
    REQUIRE((plain.acceleration() - past.acceleration()).norm() < 1e-4);
  }
  CHECK(plain.pose() == past.pose());
}

TEST_CASE("ahead says where the run will be, with its via-points") {
  for (const OrientationForm form : kForms) {
    const PoseDmp model = PoseDmp::fit(pose(200, 2.0), of_form(form));
    PoseRun run(model);
    run.step(0.5);
    Eigen::Matrix4d goal = model.goal();
    goal(0, 3) += 0.1;
    run.set_goal(goal);
    run.via(0.7, beside(model, 0.7, {0.1, 0, 0}, {0.2, 0, 0}));
    for (const double phase : {0.25, 0.5, 0.7, 0.75, 1.0}) {
      const CouplingState<PoseSpace> seen = run.ahead(phase);
      PoseRun later(run);
      later.step(2.0 * phase - 0.5);
      CHECK(seen.phase == doctest::Approx(phase).epsilon(1e-12));
      CHECK(apart(seen.point, later.pose()) < 1e-9);
      CHECK((seen.velocity - later.twist()).norm() < 1e-8);
      CHECK(seen.goal == run.goal());
    }
    CHECK(run.ahead(0.1).phase == run.phase());
    CHECK(run.ahead(std::numeric_limits<double>::quiet_NaN()).phase == run.phase());
    CHECK(run.ahead(7.0).phase == 1.0);
    const Eigen::Matrix4d before = run.pose();
    run.ahead(0.9);
    CHECK(run.pose() == before);
  }
}

TEST_CASE("what cannot be passed is refused with its Status, and nothing changes") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  const Eigen::VectorXd point = Eigen::Vector3d(.1, .1, .1);
  const Eigen::VectorXd wrong = Eigen::Vector2d(1, 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Run run(model), plain(model);
  run.step(0.5);
  plain.step(0.5);
  CHECK(run.via(0.5, point) == Status::too_late);
  CHECK(run.via(0.3, point) == Status::too_late);
  CHECK(run.via(0.505, point) == Status::too_late);
  CHECK(run.via(0.995, point) == Status::invalid_input);
  CHECK(run.via(nan, point) == Status::invalid_input);
  CHECK(run.via(0.7, wrong) == Status::invalid_input);
  CHECK(run.via(0.7, Eigen::VectorXd::Constant(3, nan)) == Status::invalid_input);
  CHECK(run.via(0.7, point, wrong) == Status::invalid_input);
  CHECK(run.via(0.7, point, Reach(0.0)) == Status::invalid_input);
  CHECK(run.via(0.7, point, Reach(0.2, nan)) == Status::invalid_input);
  CHECK(run.move_via(0.7, point) == Status::invalid_input);
  for (int i = 0; i < 100; ++i) run.step(5e-3), plain.step(5e-3);
  CHECK(run.position() == plain.position());

  Run full(model);
  CHECK(full.via(0.5, point) == Status::running);
  CHECK(full.via(0.505, point) == Status::invalid_input);
  CHECK(full.via(0.5, 2.0 * point) == Status::running);  // replaced
  full.step(0.5);
  CHECK((full.position() - 2.0 * point).norm() < 1e-9);
  CHECK(full.move_via(0.5, point) == Status::too_late);
}

TEST_CASE("a velocity that no offset can have makes the run not finite, with the last finite output kept") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  Run run(model);
  CHECK(run.via(0.5, model.start(), Eigen::VectorXd::Constant(3, 1e300)) == Status::running);
  Status status = Status::running;
  for (int i = 0; i < 100 && status == Status::running; ++i) status = run.step(1e-2);
  CHECK(status == Status::not_finite);
  CHECK(run.position().allFinite());
  CHECK(run.acceleration().allFinite());
  CHECK_THROWS_AS(model.rollout({}, {}, 1e-2, {{0.5, model.start(), Eigen::VectorXd::Constant(3, 1e300)}}),
                  InvalidArgument);
}

TEST_CASE("there is room for sixteen at once, and for more once they lie behind") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  const Eigen::VectorXd point = Eigen::Vector3d(.1, .1, .1);
  Run run(model);
  for (int k = 1; k <= 16; ++k) CHECK(run.via(0.04 * k, point, Reach(0.02)) == Status::running);
  CHECK(run.via(0.9, point) == Status::invalid_input);
  for (int k = 1; k <= 16; ++k) {
    step_to(run, 0.04 * k, 1e-3);
    CHECK((run.position() - point).norm() < 1e-9);
  }
  CHECK(run.via(0.9, point) == Status::running);
  step_to(run, 0.9, 1e-3);
  CHECK((run.position() - point).norm() < 1e-9);
}

TEST_CASE("cleared via-points fade within their reach, those of a run that begins anew lie ahead again") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  const Eigen::VectorXd point = Eigen::Vector3d(.2, .1, .1);
  Run run(model), plain(model);
  run.via(0.6, point, Reach(0.2));
  step_to(run, 0.5, 1e-3);
  step_to(plain, 0.5, 1e-3);
  CHECK((run.position() - plain.position()).norm() > 0.01);
  run.clear_vias();
  Run fine(run);
  CHECK(step_to(fine, 0.701, 5e-4) < 0.55 * step_to(run, 0.701, 1e-3));  // nothing jumps
  step_to(plain, 0.701, 1e-3);
  CHECK((run.position() - plain.position()).norm() < 1e-12);

  Run again(model);
  again.via(0.6, point);
  for (int round = 0; round < 2; ++round) {
    step_to(again, 0.6, 1e-3);
    CHECK((again.position() - point).norm() < 1e-9);
    step_to(again, 1.0, 1e-3);
    again.reset();
    CHECK(again.position() == model.start());
  }
}

TEST_CASE("a product passes via-points too, and copies of a run have their own") {
  const Demonstration width(grid(200, 2.0), RowMatrix(grid(200, 1.0)));
  const PoseGripperDmp model = PoseGripperDmp::fit({pose(200, 2.0), width});
  const PoseTrajectory at = model.rollout_at(Eigen::VectorXd::Constant(1, 1.0)).first;
  PoseGripperRun run(model);
  CHECK(run.via(0.5, {at.pose[0], Eigen::VectorXd::Constant(1, 0.7)}) == Status::running);
  PoseGripperRun other(run);
  other.clear_vias();
  step_to(run, 0.5, 1e-3);
  step_to(other, 0.5, 1e-3);
  CHECK(apart(run.pose(), at.pose[0]) < 1e-9);
  CHECK(run.output().second.position[0] == doctest::Approx(0.7).epsilon(1e-9));
  CHECK(other.output().second.position[0] == doctest::Approx(0.5).epsilon(1e-3));
}

TEST_CASE("via-points take no memory in the loop") {
  for (const OrientationForm form : kForms) {
    const PoseDmp model = PoseDmp::fit(pose(200, 2.0), of_form(form));
    PoseRun run(model), next(model);
    const Eigen::Matrix4d via = beside(model, 0.5, {0.1, 0, 0}, {0.2, 0, 0});
    Eigen::Matrix4d goal = model.goal();
    goal(0, 3) += 0.1;
    const Vector6 twist = Vector6::Constant(0.1);
    double sum = 0.0;
    CHECK(allocations_in([&] {
            for (int i = 0; i < 3000; ++i) {
              if (i == 100) run.via(0.5, via), run.via(0.6, via, twist, Reach(0.2, 0.1)), run.via(0.8, via);
              if (i > 300 && i < 500) run.set_goal(goal), run.move_via(0.6, via);
              if (i == 800) sum += run.ahead(0.9).point(0, 3);
              if (i == 1000) run.clear_vias();
              if (i == 1200) run.start_from(via, twist, 0.3);
              if (i == 1500) run.join(next, 0.3);
              if (i == 2500) run.reset();
              run.step(1e-3);
            }
          }) == 0);
    CHECK(std::isfinite(sum));
  }
}

TEST_CASE("rollouts refuse via-points by name and index") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  const Eigen::VectorXd point = Eigen::Vector3d(.1, .1, .1);
  const auto refuse = [&](const std::vector<Via<VectorSpace>>& vias, const std::string& words) {
    CHECK_THROWS_WITH_AS(model.rollout({}, {}, 1e-2, vias), doctest::Contains(words.c_str()),
                         InvalidArgument);
  };
  refuse({{0.0, point}}, "via[0].phase: 0");
  refuse({{1.0, point}}, "via[0].phase: 1");
  refuse({{0.5, point}, {0.4, point}}, "via[1].phase: 0.4");
  refuse({{0.5, point}, {0.505, point}}, "via[1].phase: 0.505");
  refuse({{0.5, Eigen::Vector2d(1, 2)}}, "via[0].point");
  refuse({{0.5, point, Eigen::VectorXd(Eigen::Vector2d(1, 2))}}, "via[0].velocity");
  refuse({{0.5, point, {}, 2.0}}, "via[0].reach");
}

TEST_CASE("property: whatever via-points are set, they are passed, and the goal is kept") {
  const Dmp model = Dmp::fit(helix(200, 1.0, .1, .2, 2));
  cases::each(
      [&](cases::Random& random) {
        Run run(model);
        std::vector<double> phases;
        std::vector<Eigen::VectorXd> points;
        for (double s = random.uniform(0.02, 0.3); s < 0.97; s += random.uniform(0.03, 0.4)) {
          phases.push_back(s);
          points.push_back(random.vector(3, -0.5, 0.5));
          const Reach reach(random.uniform(0.02, 0.4), random.uniform(0.02, 0.4));
          if (random.coin()) {
            REQUIRE(run.via(s, points.back(), reach) == Status::running);
          } else {
            REQUIRE(run.via(s, points.back(), random.vector(3, -1, 1), reach) == Status::running);
          }
        }
        for (std::size_t k = 0; k < phases.size(); ++k) {
          step_to(run, phases[k], random.uniform(2e-3, 1.5e-2));
          REQUIRE((run.position() - points[k]).norm() < 1e-8);
        }
        Run plain(model);
        plain.step(1.0);
        step_to(run, 1.0, 5e-3);
        REQUIRE((run.position() - plain.position()).norm() < 1e-8);
      },
      100);
}
