#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/pose_dmp.hpp>

#include "motions.hpp"
#include "run_values.hpp"

using namespace dmp;
using namespace motions;
using Eigen::Matrix4d;

namespace {
Rotations rotations_of(const Poses& poses) {
  Rotations r;
  for (const Matrix4d& pose : poses) r.push_back(pose.topLeftCorner<3, 3>());
  return r;
}
}  // namespace

TEST_CASE("a pose is its position and its orientation learned apart, in one phase") {
  const PoseDemonstration demonstration = pose(500, 2.0);
  for (const double dt : {.05, .005, .001}) {
    const PoseTrajectory both = PoseDmp::fit(demonstration, stated()).rollout({}, {}, dt);
    const Trajectory position = Dmp::fit(demonstration.position(), stated()).rollout({}, {}, dt);
    const OrientationTrajectory orientation =
        OrientationDmp::fit(demonstration.orientation(), stated()).rollout({}, {}, dt);
    for (Eigen::Index k = 0; k < both.time.size(); ++k) {
      const Eigen::Vector3d p = both.pose[k].topRightCorner<3, 1>();
      CHECK((p - position.position.row(k).transpose()).norm() < 1e-12);
      CHECK(so3::distance(both.pose[k].topLeftCorner<3, 3>(), orientation.rotation[k]) < 1e-12);
      CHECK((both.twist.row(k).head(3) - position.velocity.row(k)).norm() < 1e-11);
      CHECK((both.twist.row(k).tail(3) - orientation.angular_velocity.row(k)).norm() < 1e-11);
    }
  }
}

TEST_CASE("sine, cosine, line and Euler angles together come back as [R p; 0 1]") {
  const PoseDemonstration demonstration = pose(1000, 4.995);
  const PoseDmp dmp = PoseDmp::fit(demonstration);
  const PoseTrajectory rollout = dmp.rollout_at(demonstration.time());
  CHECK(rollout.pose.size() == 1000);
  CHECK(rollout.pose[500].row(3) == Eigen::RowVector4d(0, 0, 0, 1));
  CHECK(angles(rotations_of(rollout.pose), demonstration.orientation().rotation()).rmse < 1e-5);
  for (std::size_t k = 0; k < 1000; ++k)
    CHECK((rollout.pose[k] - demonstration.pose()[k]).topRightCorner<3, 1>().norm() < 1e-4);
}

TEST_CASE("a new goal and a new duration are reached in the time given") {
  const PoseDmp dmp = PoseDmp::fit(pose(300, 2.0));
  const Matrix4d goal = pose_of(so3::exp({.1, .3, 0}) * dmp.goal().topLeftCorner<3, 3>(), {.2, .1, .3});
  const PoseTrajectory rollout = dmp.rollout(goal, 5.0, .01);
  CHECK(rollout.time[rollout.time.size() - 1] == doctest::Approx(5.0));
  CHECK((rollout.pose.back().topRightCorner<3, 1>() - Eigen::Vector3d(.2, .1, .3)).norm() < 5e-3);
  CHECK(so3::distance(rollout.pose.back().topLeftCorner<3, 3>(), goal.topLeftCorner<3, 3>()) < 2e-2);
}

TEST_CASE("a run is steered online and refuses what is no pose") {
  const PoseDmp dmp = PoseDmp::fit(pose(300, 2.0));
  PoseRun run(dmp);
  CHECK((run.pose() - dmp.start()).norm() < 1e-14);
  while (run.step(1e-3) == Status::running) {
  }
  CHECK((run.pose() - dmp.rollout({}, {}, 1e-3).pose.back()).norm() < 1e-12);
  Matrix4d goal = dmp.goal();
  goal(0, 3) += .1;
  CHECK(run.set_goal(goal) == Status::finished);
  for (int i = 0; i < 3000; ++i) run.step(1e-3);
  CHECK((run.pose() - goal).norm() < 1e-6);
  Matrix4d bad = goal;
  bad(3, 3) = 2.0;
  CHECK(run.set_goal(bad) == Status::invalid_input);
  bad = goal;
  bad(0, 0) = 2.0;
  CHECK(run.set_goal(bad) == Status::invalid_input);
  bad = goal;
  bad(0, 3) = NAN;
  CHECK(run.set_goal(bad) == Status::invalid_input);
  CHECK((run.goal() - goal).norm() < 1e-12);
  PoseRun other = run;
  run.reset();
  CHECK((run.pose() - dmp.start()).norm() < 1e-14);
  CHECK((other.pose() - goal).norm() < 1e-6);
}

TEST_CASE("a run begins at any pose with any twist") {
  const PoseDmp dmp = PoseDmp::fit(pose(300, 2.0));
  PoseRun run(dmp);
  Eigen::Matrix<double, 6, 1> twist;
  twist << .1, 0, -.1, .2, .3, 0;
  const Matrix4d start = pose_of(so3::exp({.2, 0, .1}), {1, 2, 3});
  CHECK(run.start_from(start, twist) == Status::running);
  CHECK((run.pose() - start).norm() < 1e-14);
  CHECK((run.twist() - twist).norm() < 1e-14);
  for (int i = 0; i < 4000; ++i) run.step(1e-3);
  CHECK((run.pose() - dmp.goal()).norm() < 1e-4);
}

TEST_CASE("a pose that cannot be given out whole is not given out in part") {
  PoseRun run(PoseDmp::fit(pose(200, 1.0)));
  run.step(0.1);
  const Eigen::Matrix4d before = run.pose();
  Eigen::Matrix4d elsewhere = before;
  elsewhere(0, 3) += 42.0;
  Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
  twist[4] = 1e307;
  CHECK(run.start_from(elsewhere, twist) == Status::not_finite);
  CHECK(run.pose() == before);
}

TEST_CASE("runs of poses are values") {
  run_values::check<PoseRun>(PoseDmp::fit(pose(300, 2.0)), PoseDmp::fit(pose(100, 1.0)),
                             [](const PoseRun& run) { return run.pose(); });
}

TEST_CASE("no poses teach nothing") {
  CHECK_THROWS_WITH_AS(PoseDmp::fit(std::vector<PoseDemonstration>{}),
                       doctest::Contains("demonstrations: none"), InvalidArgument);
}
