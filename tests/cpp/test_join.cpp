// Joins, soft starts and sequences: from one motion to another without a jump, exact behind the reach.
#include <doctest/doctest.h>
#include <dmp/file.hpp>
#include <dmp/sequence.hpp>

#include <limits>
#include <string>
#include <vector>

#include "allocations.hpp"
#include "forms.hpp"
#include "motions.hpp"

using namespace dmp;
using namespace motions;

namespace {

PoseDemonstration moved(const PoseDemonstration& demonstration, const Eigen::Vector3d& way,
                        const Eigen::Vector3d& turn) {
  Poses poses = demonstration.pose();
  for (Eigen::Matrix4d& pose : poses)
    pose = pose_of(so3::exp(turn) * pose.topLeftCorner<3, 3>(), pose.topRightCorner<3, 1>() + way);
  return demonstration.with(poses);
}

double apart(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) { return (a - b).norm(); }

/// The next motion, somewhere else, twice as fast.
PoseDmp another() { return PoseDmp::fit(moved(pose(150, 1.0, 1), {0.2, 0.1, -0.1}, {0.5, -0.3, 0.4})); }

}  // namespace

TEST_CASE(
    "a join at speed keeps position, velocity and acceleration, and is the next motion behind its reach") {
  for (const OrientationForm form :
       {OrientationForm::ude, OrientationForm::log_linear, OrientationForm::turning}) {
    const PoseDmp model = PoseDmp::fit(pose(200, 2.0), of_form(form));
    PoseRun run(model), next(another()), alone(next);
    run.step(0.83);
    const Eigen::Matrix4d where = run.pose();
    const Vector6 twist = run.twist(), acceleration = run.acceleration();
    CHECK(run.join(next, 0.4) == Status::running);
    CHECK(apart(run.pose(), where) < 1e-12);
    CHECK((run.twist() - twist).norm() < 1e-11);
    CHECK((run.acceleration() - acceleration).norm() < 1e-9 * acceleration.norm());
    CHECK(run.phase() == 0.0);
    CHECK(run.duration() == 1.0);
    CHECK(next.duration() == 2.0);  // they change places
    for (int i = 0; i < 1000; ++i) {
      run.step(1e-3);
      alone.step(1e-3);
      if (run.phase() < 0.4 + 1e-9) continue;
      REQUIRE(run.pose() == alone.pose());
      REQUIRE(run.acceleration() == alone.acceleration());
    }
  }
}

TEST_CASE("within a join velocities and accelerations are the derivatives of the poses") {
  PoseRun run(PoseDmp::fit(pose(200, 2.0))), next(another());
  next.step(0.2);  // any phase of the next one
  run.step(0.7);
  run.join(next, 0.5);
  CHECK(run.phase() == doctest::Approx(0.2));
  double velocity = 0.0, acceleration = 0.0;
  for (int i = 0; i < 450; ++i) {
    const Eigen::Matrix4d before = run.pose();
    const Vector6 twist = run.twist(), rate = run.acceleration();
    run.step(1e-4);
    Vector6 seen;
    seen << (run.pose() - before).topRightCorner<3, 1>(),
        so3::log(
            Eigen::Matrix3d(run.pose().topLeftCorner<3, 3>() * before.topLeftCorner<3, 3>().transpose()));
    velocity = std::max(velocity, (seen / 1e-4 - 0.5 * (twist + run.twist())).norm());
    acceleration =
        std::max(acceleration, ((run.twist() - twist) / 1e-4 - 0.5 * (rate + run.acceleration())).norm());
  }
  CHECK(velocity < 1e-4);
  CHECK(acceleration < 1e-2);
}

TEST_CASE("a soft start begins at rest anywhere and is the learned motion behind its reach") {
  const PoseDmp model = PoseDmp::fit(pose(200, 2.0));
  const Eigen::Matrix4d there = pose_of(so3::exp({0.4, 1.0, -0.7}), {0.3, 0.2, 0.1});
  const Vector6 twist = (Vector6() << 0.1, 0, -0.1, 0.3, 0.2, 0).finished();
  for (const Vector6& velocity : {Vector6(Vector6::Zero()), twist}) {
    PoseRun run(model), plain(model);
    run.step(0.7);
    CHECK(run.start_from(there, velocity, 0.3) == Status::running);
    CHECK(run.time() == 0.0);
    CHECK(apart(run.pose(), there) < 1e-12);
    CHECK((run.twist() - velocity).norm() < 1e-12);
    CHECK(run.acceleration().norm() < 1e-9);
    for (int i = 0; i < 2000; ++i) run.step(1e-3), plain.step(1e-3);
    CHECK(run.pose() == plain.pose());
  }
}

TEST_CASE("a via-point that is set for the next motion is passed within its join") {
  PoseRun run(PoseDmp::fit(pose(200, 2.0)));
  PoseRun next(another());
  const Eigen::Matrix4d via = pose_of(so3::exp({0.2, 0.3, 0.1}), {0.1, 0.2, 0.0});
  run.step(0.9);
  CHECK(next.via(0.2, via) == Status::running);
  const Vector6 acceleration = run.acceleration();
  run.join(next, 0.5);
  run.step(0.0);
  CHECK((run.acceleration() - acceleration).norm() < 1e-9 * acceleration.norm());
  run.step(0.2);
  CHECK(apart(run.pose(), via) < 1e-8);
}

TEST_CASE("joins that cannot be are refused and change nothing") {
  Run run(Dmp::fit(helix(100, 1.0, .1, .2, 1)));
  run.step(0.3);
  Run other(spring(0.0, 1.0, 1.0));
  Run paused(Dmp::fit(reach(100, 1.0)));
  paused.pause();
  const Eigen::VectorXd before = run.position();
  CHECK(run.join(other) == Status::invalid_input);
  CHECK(run.join(run) == Status::invalid_input);
  CHECK(run.join(paused) == Status::invalid_input);
  Run fine(Dmp::fit(reach(100, 1.0)));
  CHECK(run.join(fine, Reach(0.0)) == Status::invalid_input);
  CHECK(run.start_from(before, before, Reach(std::numeric_limits<double>::quiet_NaN())) ==
        Status::invalid_input);
  CHECK(run.position() == before);
  CHECK(run.phase() == 0.3);
}

TEST_CASE("a sequence is its motions one after another, without a jump where they take over") {
  const PoseDmp first = PoseDmp::fit(pose(200, 2.0));
  const PoseDmp second = another();
  const PoseDmpSequence sequence({{first, 0.8}, {second, 1.0, 0.5}, {first, 1.0, 0.3}});
  CHECK(sequence.duration() == doctest::Approx(0.8 * 2.0 + 1.0 + 2.0));
  CHECK(sequence.dimension() == 6);
  CHECK(sequence.start() == first.start());
  CHECK(sequence.goal() == first.goal());
  const PoseTrajectory whole = sequence.rollout({}, {}, 1e-3);
  CHECK(whole.time.size() == 4601);
  const PoseTrajectory alone = first.rollout({}, {}, 1e-3);
  for (std::size_t k = 0; k < 1600; k += 7) CHECK(apart(whole.pose[k], alone.pose[k]) < 1e-9);
  for (std::size_t k = 700; k <= 2000; k += 7) CHECK(apart(whole.pose[2600 + k], alone.pose[k]) < 1e-9);
  const PoseTrajectory next = second.rollout({}, {}, 1e-3);
  for (std::size_t k = 510; k < 1000; k += 7) CHECK(apart(whole.pose[1600 + k], next.pose[k]) < 1e-9);
  // Continuous accelerations: steps halve with dt.
  const auto steps = [&](double dt) {
    const RowMatrix a = sequence.rollout({}, {}, dt).acceleration;
    const Eigen::Index n = a.rows();
    return (a.bottomRows(n - 1) - a.topRows(n - 1)).rowwise().norm().maxCoeff();
  };
  CHECK(steps(5e-4) < 0.55 * steps(1e-3));
}

TEST_CASE("a sequence does not depend on how it is stepped, and keeps its path at another duration") {
  const DmpSequence sequence(
      {{Dmp::fit(helix(200, 2.0, .1, .2, 2)), 0.9}, {Dmp::fit(reach(100, 1.0)), 1.0, 0.4}});
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(29, 0.0, 2.8);
  const Trajectory coarse = sequence.rollout_at(times);
  const Trajectory fine = sequence.rollout({}, {}, 1e-3);
  for (Eigen::Index k = 0; k < times.size(); ++k)
    CHECK((coarse.position.row(k) - fine.position.row(100 * k)).norm() < 1e-7);
  const Trajectory slow = sequence.rollout_at(2.0 * times, {}, 2.0 * sequence.duration());
  CHECK((slow.position - coarse.position).norm() < 1e-7);
  CHECK((2.0 * slow.velocity - coarse.velocity).norm() < 1e-6);
  const Eigen::VectorXd goal = sequence.goal() + Eigen::Vector3d(0.1, 0.1, 0.1);
  const Trajectory elsewhere = sequence.rollout(goal);
  CHECK((elsewhere.position.row(elsewhere.position.rows() - 1).transpose() - goal).norm() < 1e-3);
}

TEST_CASE("a run of a sequence tells its part and takes no memory in the loop") {
  const PoseDmp first = PoseDmp::fit(pose(200, 2.0));
  SequenceRun<PoseSpace> run(PoseDmpSequence({{first, 0.8}, {another(), 1.0, 0.5}}));
  const PoseTrajectory wanted = PoseDmpSequence({{first, 0.8}, {another(), 1.0, 0.5}}).rollout({}, {}, 1e-3);
  double farthest = 0.0;
  Status status = Status::running;
  CHECK(allocations_in([&] {
          for (std::size_t i = 1; i <= 2600; ++i) {
            status = run.step(1e-3);
            farthest = std::max(farthest, apart(run.state().point, wanted.pose[i]));
            if (i == 1599 && run.part() != 0) farthest = 1.0;
            if (i == 1601 && run.part() != 1) farthest = 1.0;
          }
        }) == 0);
  CHECK(farthest < 1e-9);
  CHECK(status == Status::finished);
  CHECK(run.time() == doctest::Approx(2.6));
  CHECK(run.step(-1.0) == Status::invalid_input);
}

TEST_CASE("a part slowed by a changing tempo is left at its phase") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  SequenceRun<VectorSpace> run(DmpSequence({{model, 0.7}, {model}}));
  run.step(0.3);
  run.stretch(2.0);
  for (int i = 0; run.part() == 0 && i < 1000; ++i) run.step(1e-2);
  CHECK(run.part() == 1);
  CHECK(run.current().phase() < 0.02);
  CHECK(run.current().duration() == 2.0);
}

TEST_CASE("a sequence with via-points is saved and loaded to the last bit") {
  const PoseDmp first = PoseDmp::fit(pose(200, 2.0));
  const Eigen::Matrix4d via = pose_of(so3::exp({0.2, 0.3, 0.1}), {0.1, 0.2, 0.0});
  const PoseDmpSequence sequence({{first, 0.8, 0.2, {{0.4, via, {}, {0.1, 0.2}}}},
                                  {another(), 1.0, 0.5, {{0.6, via, Vector6(Vector6::Constant(0.1))}}}});
  const std::string text = to_json(sequence);
  const auto again = std::get<PoseDmpSequence>(from_json(text));
  CHECK(to_json(again) == text);
  const PoseTrajectory a = sequence.rollout(), b = again.rollout();
  CHECK(a.acceleration == b.acceleration);
  CHECK(apart(a.pose[800], via) < 1e-8);

  const Demonstration width(grid(200, 2.0), RowMatrix(grid(200, 1.0)));
  const PoseGripperDmp grip = PoseGripperDmp::fit({pose(200, 2.0), width});
  const PoseGripperDmpSequence grips({{grip}, {grip, 1.0, 0.3, {{0.5, grip.goal()}}}});
  CHECK(to_json(std::get<PoseGripperDmpSequence>(from_json(to_json(grips)))) == to_json(grips));
}

TEST_CASE("sequences that cannot be are refused by the part and its field") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  const auto refuse = [](const std::vector<SequencePart<VectorSpace>>& parts, const std::string& words) {
    CHECK_THROWS_WITH_AS(DmpSequence{parts}, doctest::Contains(words.c_str()), InvalidArgument);
  };
  refuse({}, "parts: 0");
  refuse(std::vector<SequencePart<VectorSpace>>(33, {model}), "parts: 33");
  refuse({{model}, {spring(0, 1, 1)}}, "parts[1].model: of 1 dimensions, expected 3");
  refuse({{model, 1.1}}, "parts[0].leave: 1.1");
  refuse({{model}, {model, 1.0, 0.0}}, "parts[1].reach: 0");
  refuse({{model, 1.0, 0.2, {{0.5, Eigen::Vector2d(1, 2)}}}}, "parts[0].via[0].point");
}

TEST_CASE("files of sequences are refused by the place") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  const std::string text = to_json(DmpSequence({{model}, {model, 1.0, 0.3, {{0.5, model.goal()}}}}));
  const auto refuse = [&](const std::string& what, const std::string& by, const std::string& words) {
    std::string changed = text;
    changed.replace(changed.find(what), what.size(), by);
    CHECK_THROWS_WITH_AS(from_json(changed), doctest::Contains(words.c_str()), InvalidArgument);
  };
  refuse("\"leave\": 1.0", "\"leave\": 2.0", "parts[0].leave: 2");
  refuse("\"leave\": 1.0", "\"leave\": \"x\"", "parts[0].leave: expected a number");
  refuse("\"phase\": 0.5", "\"phase\": 5.5", "parts[1].via[0].phase: 5.5");
  refuse("\"kind\": \"dmp\"", "\"kind\": \"pose_dmp\"", "parts[0].model.kind: 'pose_dmp', expected dmp");
  refuse("\"version\": 3", "\"version\": 5", "version: 5");
  refuse("\"parts\"", "\"ports\"", "'parts' is missing");
}
