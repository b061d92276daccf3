// A coupling of the user's own is part of the equation of motion, in each internal step.
#include <doctest/doctest.h>
#include <dmp/pose_gripper_dmp.hpp>

#include <algorithm>
#include <limits>

#include "allocations.hpp"
#include "motions.hpp"

using namespace dmp;
using namespace motions;

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

const auto kNothing = [](const auto& state) noexcept {
  return std::decay_t<decltype(state.velocity)>::Zero(state.velocity.size()).eval();
};

}  // namespace

TEST_CASE("a constant coupling shifts the point of rest by c over the stiffness") {
  const Dmp model = spring(0.0, 1.0, 2.0);  // stiffness 25 * 6.25
  Run run(model);
  const auto push = [](const CouplingState<VectorSpace>&, auto& drive) noexcept { drive[0] += 31.25; };
  for (int i = 0; i < 400; ++i) run.step(0.05, push);
  CHECK(run.position()[0] == doctest::Approx(1.2).epsilon(1e-12));
  for (int i = 0; i < 400; ++i) run.step(0.05);
  CHECK(run.position()[0] == doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE("an acceleration divided by speed^2 is what the output gains, of all forms of the orientation") {
  for (const OrientationForm form :
       {OrientationForm::ude, OrientationForm::log_linear, OrientationForm::turning}) {
    DmpOptions options;
    options.orientation_form = form;
    PoseRun run(PoseDmp::fit(pose(100, 2.0), options));
    for (int i = 0; i < 700; ++i) run.step(1e-3);
    const Vector6 before = run.acceleration();
    const Vector6 wanted = (Vector6() << 1, -2, 3, 0.5, -0.4, 0.3).finished();  // m/s^2, rad/s^2, world frame
    run.step(0.0, [&](const CouplingState<PoseSpace>& state) noexcept {
      return Vector6(wanted / (state.speed * state.speed));
    });
    CHECK((run.acceleration() - before - wanted).norm() < 1e-12);
  }
}

TEST_CASE("a coupling sees the run as it stands") {
  for (const OrientationForm form :
       {OrientationForm::ude, OrientationForm::log_linear, OrientationForm::turning}) {
    DmpOptions options;
    options.orientation_form = form;
    PoseRun run(PoseDmp::fit(pose(100, 2.0), options));
    run.step(0.3);
    CouplingState<PoseSpace> seen;
    run.step(0.0, [&](const CouplingState<PoseSpace>& state) noexcept {
      seen = state;
      return Vector6(Vector6::Zero());
    });
    CHECK(seen.phase == run.phase());
    CHECK(seen.speed == 0.5);
    CHECK((seen.point - run.pose()).norm() < 1e-14);
    CHECK((seen.velocity - run.twist()).norm() < 1e-13);
    CHECK(seen.goal == run.goal());
  }
}

TEST_CASE("within a long step a coupling sees where the internal steps are, in every form") {
  for (const OrientationForm form :
       {OrientationForm::ude, OrientationForm::log_linear, OrientationForm::turning}) {
    DmpOptions options;
    options.orientation_form = form;
    const OrientationDmp model = OrientationDmp::fit(rotation(100, 2.0, 3.0), options);
    OrientationRun fine(model);
    OrientationRun run(model);
    double farthest = 0.0;
    int pieces = 0;
    run.step(0.5, [&](const CouplingState<RotationSpace>& state) noexcept {
      fine.step(2.0 * (state.phase - fine.phase()));
      farthest = std::max({farthest, (state.point - fine.rotation()).norm(),
                           (state.velocity - fine.angular_velocity()).norm()});
      ++pieces;
      return Eigen::Vector3d(Eigen::Vector3d::Zero());
    });
    CHECK(pieces == 51);
    CHECK(farthest < 1e-9);
  }
}

TEST_CASE("a coupling of nothing changes nothing, to the last bit, whatever the scaling") {
  for (const Scaling scaling : {Scaling::none, Scaling::per_axis_relative, Scaling::rotation_dilation}) {
    DmpOptions options;
    options.scaling = scaling;
    const PoseDmp model = PoseDmp::fit(pose_with_goal_apart(100, 1.0), options);
    PoseRun alone(model);
    PoseRun coupled(model);
    Eigen::Matrix4d goal = model.goal();
    goal(0, 3) += 0.1;
    for (int i = 0; i < 300; ++i) {
      if (i == 100) alone.set_goal(goal), coupled.set_goal(goal);
      alone.step(3e-3);
      coupled.step(3e-3, kNothing);
      REQUIRE(alone.pose() == coupled.pose());
      REQUIRE(alone.acceleration() == coupled.acceleration());
    }
  }
}

TEST_CASE("a coupling takes no memory in the loop") {
  PoseRun run(PoseDmp::fit(pose(100, 1.0)));
  CHECK(allocations_in([&] {
          for (int i = 0; i < 1000; ++i)
            run.step(1e-3,
                     [](const CouplingState<PoseSpace>& state) noexcept { return Vector6(-state.velocity); });
        }) == 0);
}

TEST_CASE("what a coupling cannot mean makes the run not finite, with the last finite output kept") {
  const Dmp model = Dmp::fit(reach(100, 1.0));
  const auto wrong_size = [](const CouplingState<VectorSpace>&) noexcept { return Eigen::Vector2d(1, 1); };
  const auto not_a_number = [](const CouplingState<VectorSpace>&) noexcept {
    return Eigen::Vector3d(0, std::numeric_limits<double>::quiet_NaN(), 0);
  };
  Run first(model);
  CHECK(first.step(1e-3, wrong_size) == Status::not_finite);
  Run second(model);
  CHECK(second.step(1e-3, not_a_number) == Status::not_finite);
  CHECK(second.position().allFinite());
  second.reset();
  CHECK(second.step(1e-3) == Status::running);
}

TEST_CASE("a paused run does not ask its coupling, and goes on where it stood") {
  const PoseDmp model = PoseDmp::fit(pose(100, 2.0));
  PoseRun run(model), plain(model);
  const auto divides = [](const CouplingState<PoseSpace>& state) noexcept {
    return Vector6(Vector6::Zero() / (state.speed * state.speed));  // as the documentation has it
  };
  for (int i = 0; i < 500; ++i) {
    run.step(1e-3, divides);
    plain.step(1e-3);
  }
  run.pause();
  plain.pause();
  for (int i = 0; i < 8000; ++i) {
    CHECK(run.step(1e-3, divides) == Status::running);
    plain.step(1e-3);
  }
  CHECK(run.twist().norm() == 0.0);
  run.resume();
  plain.resume();
  while (plain.step(1e-3) == Status::running) run.step(1e-3, divides);
  CHECK(run.step(1e-3, divides) == Status::finished);
  CHECK((run.pose() - plain.pose()).norm() < 1e-9);
}
