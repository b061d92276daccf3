// Behind the filter limits are never exceeded and what stands still is never touched, whatever is asked for.
#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/pose_gripper_dmp.hpp>
#include <dmp/safety_filter.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "allocations.hpp"
#include "motions.hpp"

using namespace dmp;
using namespace motions;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// A spring of so many axes, which goes wherever its goal jumps.
Dmp springs(int axes, double duration) {
  DmpParameters p;
  p.options.basis_count = 5;
  p.duration = duration;
  p.start = VectorXd::Zero(axes);
  p.goal = VectorXd::Zero(axes);
  p.start_velocity = VectorXd::Zero(axes);
  p.amplitude = VectorXd::Ones(axes);
  p.weights = RowMatrix::Zero(5, axes);
  p.options.scaling = Scaling::none;
  p.options.goal_filter = 0.0;
  p.options.tempo_filter = 0.0;
  return Dmp(p);
}

SafetyLimits limits_of(int axes) {
  return {VectorXd::Constant(axes, -0.4), VectorXd::Constant(axes, 0.5), VectorXd::Constant(axes, 0.8),
          VectorXd::Constant(axes, 3.0)};
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A reach along x of 0.6 m.
Dmp reach_along_x(double duration = 1.0) {
  const VectorXd t = grid(101, duration);
  RowMatrix y(101, 3);
  for (int k = 0; k < 101; ++k) y.row(k) << 0.6 * minimum_jerk(t[k] / duration), 0.0, 0.0;
  return Dmp::fit(Demonstration(t, y));
}

struct Passed {
  double clearance = INFINITY;
  double speed = 0.0;
  int blocked = 0;
  Vector3d end;
  double length = 0.0;
};

Passed pass(const Dmp& model, SafetyFilter& filter, double seconds, double dt = 0.002) {
  Run run(model);
  Passed passed;
  Vector3d last = run.position();
  for (int i = 0; i < std::lround(seconds / dt); ++i) {
    if (run.step(dt, filter) == Status::blocked) ++passed.blocked;
    passed.clearance = std::min(passed.clearance, filter.clearance());
    passed.speed = std::max(passed.speed, run.velocity().norm());
    passed.length += (Vector3d(run.position()) - last).norm();
    last = run.position();
  }
  passed.end = run.position();
  return passed;
}

Box wall(double x, double thickness, double size) {
  Box box;
  box.pose(0, 3) = x;
  box.half_sizes = {0.5 * thickness, size, size};
  return box;
}

}  // namespace

TEST_CASE("limits are not exceeded by the last bit, however wild what is asked for") {
  std::mt19937 random(1);
  constexpr int kAxes = 8;
  SafetyFilter filter(limits_of(kAxes));
  for (const double dt : {0.001, 0.004, 0.025}) {
    Run run(springs(kAxes, 0.5));
    VectorXd before = run.velocity();
    double position = 0.0, velocity = 0.0, acceleration = 0.0, change = 0.0;
    for (int i = 0; i < 10000; ++i) {
      if (i % 50 == 0) run.set_goal(VectorXd::NullaryExpr(kAxes, [&] { return uniform(random, -2, 2); }));
      if (i % 333 == 0) run.set_duration(uniform(random, 0.05, 2.0));
      if (i % 1000 == 400) run.pause();
      if (i % 1000 == 500) run.resume();
      REQUIRE(run.step(dt, filter) != Status::invalid_input);
      position = std::max({position, run.position().maxCoeff() - 0.5, -0.4 - run.position().minCoeff()});
      velocity = std::max(velocity, run.velocity().cwiseAbs().maxCoeff() - 0.8);
      acceleration = std::max(acceleration, run.acceleration().cwiseAbs().maxCoeff() - 3.0);
      change = std::max(change, (run.velocity() - before).cwiseAbs().maxCoeff() / dt - 3.0);
      before = run.velocity();
    }
    CHECK(position <= 0.0);
    CHECK(velocity <= 0.0);
    CHECK(acceleration <= 0.0);
    CHECK(change < 3e-9);
  }
}

TEST_CASE("within the limits the motion stays as it is, to the last bit") {
  const PoseDmp model = PoseDmp::fit(pose(100, 2.0));
  PoseRun free(model);
  PoseRun run(model);
  SafetyLimits limits{{}, {}, Vector3d::Constant(100.0), Vector3d::Constant(1000.0), 100.0, 1000.0};
  SafetyFilter filter(limits);
  REQUIRE(filter.set(0, Sphere{{5, 5, 5}, 0.1}) == Status::running);
  for (int i = 0; i < 500; ++i) {
    REQUIRE(free.step(0.004) == run.step(0.004, filter));
    REQUIRE(free.pose() == run.pose());
    REQUIRE(free.acceleration() == run.acceleration());
    REQUIRE(!filter.changed());
  }
  CHECK(filter.clearance() ==
        doctest::Approx((Vector3d(5, 5, 5) - run.pose().topRightCorner<3, 1>()).norm() - 0.1));
}

TEST_CASE("the norm of angular velocity and acceleration is kept, in every form, and the goal is reached") {
  for (const OrientationForm form :
       {OrientationForm::ude, OrientationForm::log_linear, OrientationForm::turning}) {
    DmpOptions options;
    options.orientation_form = form;
    OrientationRun run(OrientationDmp::fit(rotation(200, 1.0, 3.0), options));
    SafetyLimits limits;
    limits.angular_velocity = 1.0;
    limits.angular_acceleration = 4.0;
    SafetyFilter filter(limits);
    run.start_from(run.rotation(), Vector3d::Zero());
    Vector3d before = run.angular_velocity();
    double velocity = 0.0, acceleration = 0.0, drift = 0.0;
    Eigen::Matrix3d last = run.rotation();
    for (int i = 0; i < 8000; ++i) {
      run.step(0.001, filter);
      velocity = std::max(velocity, run.angular_velocity().norm());
      acceleration = std::max({acceleration, (run.angular_velocity() - before).norm() / 0.001,
                               run.angular_acceleration().norm()});
      const Vector3d turned = so3::log(Eigen::Matrix3d(run.rotation() * last.transpose())) / 0.001;
      drift = std::max(drift, (turned - 0.5 * (before + run.angular_velocity())).norm());
      before = run.angular_velocity();
      last = run.rotation();
    }
    CHECK(velocity <= 1.0);
    CHECK(acceleration <= 4.0 * (1 + 1e-9));
    CHECK(drift < 1e-4);  // what is published belongs together
    CHECK(so3::distance(run.rotation(), run.goal()) < 1e-3);
  }
}

TEST_CASE("a sphere, a box, a capsule and a tilted plane in the way are passed, and the goal is reached") {
  const Dmp model = reach_along_x();
  Box turned = wall(0.3, 0.08, 0.05);
  turned.pose.topLeftCorner<3, 3>() = so3::exp({0.3, 0.5, -0.4});
  const std::vector<Obstacle> obstacles = {Sphere{{0.3, 0.02, 0}, 0.08},
                                           turned,
                                           Capsule{{0.3, -0.1, 0.03}, {0.3, 0.2, 0.03}, 0.05},
                                           Plane{{0.3, 0, -0.03}, {0.0, 0.0, 1.0}},
                                           Sphere{{0.3, 0, 0}, 0.08},
                                           wall(0.3, 0.04, 0.15)};
  for (const Obstacle& obstacle : obstacles) {
    SafetyFilter filter({}, 1, {0.02});
    REQUIRE(filter.set(0, obstacle) == Status::running);
    const Passed passed = pass(model, filter, 3.0);
    CHECK(passed.clearance > 0.0195);
    CHECK((passed.end - Vector3d(0.6, 0, 0)).norm() < 1e-3);
    CHECK(passed.length < 1.6 * 0.6);
  }
}

TEST_CASE("clearance does not depend on the duration") {
  double first = 0.0;
  for (const double duration : {1.0, 2.0, 4.0}) {
    const Dmp model = reach_along_x(duration);
    SafetyFilter filter({}, 1, {0.02});
    filter.set(0, Sphere{{0.3, 0.01, 0}, 0.08});
    const Passed passed = pass(model, filter, 1.2 * duration, 0.002 * duration);
    if (duration == 1.0) first = passed.clearance;
    CHECK(std::abs(passed.clearance - first) < 1e-9);
  }
}

TEST_CASE("where no way leads on, the motion stands before what is in the way and says so") {
  const Dmp model = reach_along_x();
  for (const bool limited : {false, true}) {
    SafetyLimits limits;
    if (limited)
      limits = {VectorXd::Constant(3, -2.0), VectorXd::Constant(3, 2.0), VectorXd::Constant(3, 1.0),
                VectorXd::Constant(3, 4.0)};
    SafetyFilter filter(limits, 5);
    filter.set(0, wall(0.4, 0.04, 0.3));  // a pocket, open behind
    for (int side = 0; side < 4; ++side) {
      Box box;
      box.pose(0, 3) = 0.2;
      box.pose(1 + side / 2, 3) = side % 2 ? 0.12 : -0.12;
      box.half_sizes = {0.2, side / 2 ? 0.3 : 0.02, side / 2 ? 0.02 : 0.3};
      filter.set(1 + side, box);
    }
    const Passed passed = pass(model, filter, 3.0);
    CHECK(passed.clearance > 0.004);
    CHECK(passed.blocked > 500);
    CHECK(passed.end[0] < 0.375);
  }
}

TEST_CASE("limits come first: too fast for the room that is left, it brakes in time, or within limits") {
  std::mt19937 random(3);
  int blocked = 0;
  for (int scene = 0; scene < 60; ++scene) {
    SafetyLimits limits{{}, {}, Vector3d::Constant(1.5), Vector3d::Constant(uniform(random, 2.0, 8.0))};
    SafetyFilter filter(limits, 3, {0.02});
    for (int j = 0; j < 3; ++j)
      filter.set(j,
                 Sphere{{uniform(random, 0.15, 0.5), uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1)},
                        uniform(random, 0.01, 0.06)});
    Run run(reach_along_x(uniform(random, 0.5, 1.0)));
    VectorXd before = run.velocity();
    bool begins_clear = true;
    for (int i = 0; i < 2000; ++i) {
      if (run.step(0.002, filter) == Status::blocked) ++blocked;
      begins_clear = begins_clear && (i > 0 || filter.clearance() > 0.03);
      if (!begins_clear) break;
      REQUIRE(filter.clearance() > 0.009);
      REQUIRE((run.velocity() - before).cwiseAbs().maxCoeff() <= 0.002 * limits.acceleration[0] * (1 + 1e-9));
      before = run.velocity();
    }
  }
  CHECK(blocked > 0);
}

TEST_CASE("an obstacle that moves is given way to, and its velocity carries it on") {
  const Dmp model = reach_along_x();
  SafetyFilter filter({}, 1, {0.02});
  filter.set(0, Sphere{{0.3, 0.25, 0.0}, 0.06, {0.0, -0.5, 0.0}});
  const Passed passed = pass(model, filter, 2.0);
  CHECK(passed.clearance > 0.019);
  CHECK((passed.end - Vector3d(0.6, 0, 0)).norm() < 1e-3);
  CHECK(std::get<Sphere>(*filter.obstacle(0)).center[1] == doctest::Approx(0.25 - 1.0).epsilon(1e-9));
}

TEST_CASE("nothing winds up: once the obstacle is gone the motion goes on without a jump") {
  Run run(reach_along_x());
  SafetyFilter filter({VectorXd(), VectorXd(), Vector3d::Constant(2.0), Vector3d::Constant(20.0)}, 1);
  SafetyFilter closed = filter;
  closed.set(0, Plane{{0.3, 0, 0}, {-1, 0, 0}});
  for (int i = 0; i < 1500; ++i) run.step(0.002, closed);
  CHECK(run.status() == Status::blocked);
  CHECK(run.velocity().norm() < 1e-3);
  CHECK(run.position()[0] == doctest::Approx(0.29).epsilon(0.01));
  double fastest = 0.0;
  for (int i = 0; i < 1500; ++i) {
    run.step(0.002, filter);
    fastest = std::max(fastest, run.velocity().norm());
  }
  CHECK(fastest < 2.0);
  CHECK((run.position() - run.goal()).norm() < 1e-4);
  CHECK(run.status() == Status::finished);
}

TEST_CASE("with a phase stop the motion waits before an obstacle and then has its shape") {
  DmpOptions options;
  options.phase_stop = 100.0;
  Run run(Dmp::fit(helix(200, 2.0, 0.1, 0.2, 2), options));
  SafetyFilter filter({}, 1);
  const Vector3d start = run.position();
  Plane plane;
  plane.point = start + Vector3d(0, -0.02, 0);
  plane.normal = Vector3d::UnitY();
  filter.set(0, plane);
  for (int i = 0; i < 1000; ++i) run.step(0.002, filter);
  const double waiting = run.phase();
  CHECK(waiting < 0.6);
  filter.clear();
  while (run.step(0.002, filter) == Status::running) CHECK(run.time() < 10.0);
  CHECK((run.position() - run.goal()).norm() < 1e-3);
}

TEST_CASE("a via-point is passed exactly after the filter has changed the motion") {
  Run run(reach_along_x());
  SafetyFilter filter({}, 1);
  filter.set(0, Sphere{{0.15, 0.01, 0}, 0.05});
  REQUIRE(run.via(0.8, Vector3d(0.55, 0.05, 0.05)) == Status::running);
  for (int i = 0; i < 400; ++i) run.step(0.002, filter);
  CHECK((run.position() - Vector3d(0.55, 0.05, 0.05)).norm() < 1e-9);
}

TEST_CASE("rhythmic motions, poses with a gripper and couplings go through it too") {
  DmpOptions options;
  options.motion = Motion::rhythmic;
  const VectorXd t = grid(201, 1.0);
  RowMatrix y(201, 3);
  for (int k = 0; k < 201; ++k)
    y.row(k) << 0.2 * std::cos(2 * M_PI * t[k]), 0.2 * std::sin(2 * M_PI * t[k]), 0.0;
  SafetyFilter filter({}, 1, {0.02});
  filter.set(0, Sphere{{-0.2, 0.0, 0.0}, 0.05});
  CHECK(pass(Dmp::fit(Demonstration(t, y), options), filter, 6.0).clearance > 0.0195);

  const PoseDemonstration demonstration = pose(100, 1.0);
  PoseGripperRun grip(
      PoseGripperDmp::fit({demonstration, Demonstration(demonstration.time(), RowMatrix::Random(100, 1))}));
  SafetyLimits limits;
  limits.velocity = Eigen::Vector4d(10, 10, 10, 0.5);
  SafetyFilter four(limits, 1);
  for (int i = 0; i < 500; ++i) {
    REQUIRE(grip.step(0.002, four) != Status::invalid_input);
    CHECK(std::abs(grip.gripper_velocity()[0]) <= 0.5);
  }

  Run pushed(reach_along_x());
  SafetyFilter slow({VectorXd(), VectorXd(), Vector3d::Constant(0.3), VectorXd()});
  for (int i = 0; i < 500; ++i) {
    pushed.step(
        0.002, [](const CouplingState<VectorSpace>&) noexcept { return VectorXd(Vector3d(0, 500, 0)); },
        slow);
    CHECK(pushed.velocity().cwiseAbs().maxCoeff() <= 0.3);
  }
}

TEST_CASE("a filtered loop takes no memory" * doctest::skip(!COUNTS_MALLOC)) {
  PoseRun run(PoseDmp::fit(pose(100, 2.0)));
  SafetyFilter filter({Vector3d::Constant(-1), Vector3d::Constant(1), Vector3d::Constant(0.5),
                       Vector3d::Constant(2), 1.0, 5.0},
                      3);
  const Vector3d place = run.pose().topRightCorner<3, 1>();
  const long count = allocations_in([&] {
    filter.set(0, Sphere{place + Vector3d(0.05, -0.05, 0.02), 0.02});
    filter.set(1, Box{Eigen::Matrix4d::Identity(), Vector3d::Constant(0.03)});
    filter.set(2, Capsule{place + Vector3d(0, 0, 0.1), place + Vector3d(0, 0.2, 0.1), 0.02, {0, 0.01, 0}});
    for (int i = 0; i < 3000; ++i) {
      if (i == 1000) run.via(0.9, run.pose());
      if (i == 2000) filter.remove(1);
      run.step(0.001, filter);
    }
  });
  CHECK(count == 0);
  CHECK(run.pose().allFinite());
}

TEST_CASE("what a filter cannot be is refused by the name of the field") {
  const auto refused = [](const SafetyLimits& limits, int room, const SafetyOptions& options) {
    try {
      const SafetyFilter filter(limits, room, options);
    } catch (const InvalidArgument& error) {
      return std::string(error.what()).substr(0, std::string(error.what()).find(':'));
    }
    return std::string();
  };
  const double nan = std::nan("");
  CHECK(refused({}, 0, {}) == "obstacles");
  CHECK(refused({}, 8, {0.0}) == "margin");
  CHECK(refused({}, 8, {0.01, -1.0}) == "radius");
  CHECK(refused({}, 8, {0.01, 0.0, nan}) == "gain");
  CHECK(refused({}, 8, {0.01, 0.0, 30.0, 0.0}) == "largest_step");
  CHECK(refused({{}, {}, Vector3d(1, 0, 1), {}}, 8, {}) == "velocity[1]");
  CHECK(refused({{}, {}, Vector3d(1, nan, 1), {}}, 8, {}) == "velocity[1]");
  CHECK(refused({{}, {}, Vector3d(1, 1, 1), VectorXd::Ones(2)}, 8, {}) == "acceleration");
  CHECK(refused({Vector3d(0, 0, 0), Vector3d(1, 1, 0), {}, {}}, 8, {}) == "upper[2]");
  SafetyLimits turning;
  turning.angular_velocity = -1.0;
  CHECK(refused(turning, 8, {}) == "angular_velocity");
}

TEST_CASE("in the loop what is refused changes nothing") {
  SafetyFilter filter(limits_of(2), 2);
  CHECK(filter.set(2, Sphere{}) == Status::invalid_input);
  CHECK(filter.set(0, Sphere{Vector3d::Zero(), -1.0}) == Status::invalid_input);
  CHECK(filter.set(0, Plane{Vector3d::Zero(), Vector3d::Zero()}) == Status::invalid_input);
  CHECK(filter.set_tracking_error(std::nan("")) == Status::invalid_input);
  CHECK(filter.obstacle(0) == nullptr);
  Run run(reach_along_x());
  CHECK(run.step(0.01, filter) == Status::invalid_input);  // three axes, limits of two
  SafetyFilter any;
  CHECK(run.step(-0.01, any) == Status::invalid_input);
  CHECK(run.step(11.0, any) == Status::invalid_input);
  CHECK(run.time() == 0.0);
  any.set(0, Sphere{});
  Run joints(springs(7, 1.0));
  CHECK(joints.step(0.01, any) == Status::invalid_input);  // no place for obstacles
}

TEST_CASE("the distance to an obstacle is that of its nearest point, and the normal its gradient") {
  std::mt19937 random(5);
  const auto vector = [&](double size) {
    return Vector3d(uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size));
  };
  for (int i = 0; i < 2000; ++i) {
    Box box{Eigen::Matrix4d::Identity(), vector(0.3).cwiseAbs()};
    box.pose.topLeftCorner<3, 3>() = so3::exp(vector(2.0));
    box.pose.topRightCorner<3, 1>() = vector(0.5);
    const std::vector<Obstacle> all = {Sphere{vector(0.5), 0.1}, box, Capsule{vector(0.5), vector(0.5), 0.1},
                                       Plane{vector(0.5), vector(1.0)}};
    const Vector3d point = vector(1.0);
    for (const Obstacle& obstacle : all) {
      const Nearness near = nearness(obstacle, point);
      CHECK(near.normal.norm() == doctest::Approx(1.0));
      if (near.distance < 1e-3) continue;
      CHECK(std::abs(nearness(obstacle, point - near.distance * near.normal).distance) < 1e-9);
      CHECK(nearness(obstacle, point + 0.1 * near.normal).distance == doctest::Approx(near.distance + 0.1));
    }
  }
}

TEST_CASE(
    "with tight limits, too, what lies exactly in the way is passed: a wall, and a gap that is closed") {
  SafetyLimits limits;
  limits.velocity = Vector3d::Constant(1.5);
  limits.acceleration = Vector3d::Constant(5.0);
  Box left = wall(0.35, 0.03, 0.1), right = left;
  left.pose(1, 3) = 0.105;
  right.pose(1, 3) = -0.105;
  for (const bool gap : {false, true}) {
    SafetyFilter filter(limits, 2, {0.02});
    filter.set(0, gap ? left : wall(0.4, 0.03, 0.12));
    if (gap) filter.set(1, right);
    const Passed passed = pass(reach_along_x(), filter, 3.0);
    CHECK(passed.clearance > 0.0195);
    CHECK((passed.end - Vector3d(0.6, 0, 0)).norm() < 5e-3);
  }
}

TEST_CASE(
    "what turns up so late that its margin is lost is braked before, along the path and within limits") {
  SafetyLimits limits;
  limits.acceleration = Vector3d::Constant(6.0);
  SafetyFilter filter(limits, 1, {0.04});
  Run run(reach_along_x());
  for (int i = 0; i < 200; ++i) run.step(0.002, filter);
  const double speed = run.velocity()[0];
  const double stop = 0.5 * speed * speed / 6.0;
  filter.set(0,
             wall(run.position()[0] + stop + 0.03 + 0.02, 0.04, 1.0));  // the margin cannot be kept, half can
  bool blocked = false;
  Vector3d before = run.velocity();
  for (int i = 0; i < 300; ++i) {
    blocked = run.step(0.002, filter) == Status::blocked || blocked;
    REQUIRE(filter.clearance() > 0.02);
    REQUIRE((run.velocity() - before).cwiseAbs().maxCoeff() <= 0.002 * 6.0 * (1 + 1e-9));
    before = run.velocity();
  }
  CHECK(blocked);
}
