// Rhythmic motions: round and round about a centre, frequency, amplitude and centre changed on the way.
#include <doctest/doctest.h>
#include <dmp/cycle.hpp>
#include <dmp/file.hpp>
#include <dmp/pose_gripper_dmp.hpp>
#include <dmp/sequence.hpp>

#include <random>
#include <string>
#include <vector>

#include "allocations.hpp"
#include "motions.hpp"

using namespace dmp;
using namespace motions;

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

DmpOptions rhythmic(int kernels = 50) {
  DmpOptions options;
  options.motion = Motion::rhythmic;
  options.basis_count = kernels;
  options.derivatives = Derivatives::interpolate;
  return options;
}

/// A closed curve of five harmonics at a phase.
Eigen::Vector3d curve(double s) {
  Eigen::Vector3d y(0.4, -0.1, 0.3);
  for (int h = 1; h <= 5; ++h)
    y += 0.1 / h *
         Eigen::Vector3d(std::cos(2 * M_PI * h * s + h), std::sin(2 * M_PI * h * s),
                         std::cos(2 * M_PI * h * s));
  return y;
}
Eigen::Matrix3d wobble(double s, double angle, int turns) {
  const Eigen::Vector3d p =
      angle * Eigen::Vector3d(std::cos(2 * M_PI * s), std::sin(2 * M_PI * s), 0.3 * std::sin(4 * M_PI * s)) /
      1.02;
  return so3::exp(p) * so3::exp(2 * M_PI * turns * s * Eigen::Vector3d(1, 2, 3).normalized()) *
         so3::exp({0.3, 0.2, 0.1});
}

Demonstration cycle(int count, double period) {
  RowMatrix y(count + 1, 3);
  for (int k = 0; k <= count; ++k) y.row(k) = curve(static_cast<double>(k) / count);
  return {grid(count + 1, period), y};
}
OrientationDemonstration turning(int count, double period, double angle, int turns) {
  Rotations r;
  for (int k = 0; k <= count; ++k) r.push_back(wobble(static_cast<double>(k) / count, angle, turns));
  return {grid(count + 1, period), r};
}
PoseDemonstration stirring(int count, double period) {
  Poses poses;
  for (int k = 0; k <= count; ++k) {
    const double s = static_cast<double>(k) / count;
    poses.push_back(pose_of(wobble(s, 0.4, 1), curve(s)));
  }
  return {grid(count + 1, period), poses};
}

}  // namespace

TEST_CASE("a closed curve goes round and round, cycle after cycle") {
  const Dmp model = Dmp::fit(cycle(200, 2.0), rhythmic());
  CHECK(model.duration() == 2.0);
  CHECK(model.options().scaling == Scaling::none);
  Run run(model);
  double error = 0.0;
  for (int k = 1; k <= 5000; ++k) {
    CHECK(run.step(2e-3) == Status::running);
    error = std::max(error, (run.position() - curve(run.phase())).norm());
  }
  CHECK(run.phase() == doctest::Approx(5.0));
  CHECK(error < 1e-6);
}

TEST_CASE("locally weighted regression goes round as well") {
  DmpOptions options = rhythmic();
  options.regression = Regression::lwr;
  const Dmp model = Dmp::fit(cycle(200, 2.0), options);
  const Trajectory t = model.rollout_at(Eigen::VectorXd::LinSpaced(101, 4.0, 6.0));
  for (Eigen::Index k = 0; k < 101; ++k)
    CHECK((t.position.row(k).transpose() - curve(t.time[k] / 2.0)).norm() < 1e-5);
}

TEST_CASE("left alone, the number of kernels is found") {
  DmpOptions options;
  options.motion = Motion::rhythmic;
  const Dmp model = Dmp::fit(cycle(200, 2.0), options);
  CHECK(model.options().basis_count <= 100);
  CHECK(
      (model.rollout_at(Eigen::VectorXd::Constant(1, 5.0)).position.row(0).transpose() - curve(2.5)).norm() <
      1e-4);
}

TEST_CASE("orientations go round with whole turns a cycle, far from their centre, too") {
  for (const auto& [angle, turns, limit] : {std::tuple{0.9, 0, 1e-7}, std::tuple{2.7, 0, 2e-5},
                                            std::tuple{0.9, 1, 1e-7}, std::tuple{0.9, -2, 1e-7}}) {
    const OrientationDmp model = OrientationDmp::fit(turning(400, 2.0, angle, turns), rhythmic(100));
    CHECK(model.options().orientation_form == OrientationForm::turning);
    OrientationRun run(model);
    double error = 0.0, rate = 0.0;
    Eigen::Quaterniond before = run.quaternion();
    for (int k = 1; k <= 3000; ++k) {
      run.step(2e-3);
      error = std::max(error, so3::distance(run.rotation(), wobble(run.phase(), angle, turns)));
      CHECK(before.dot(run.quaternion()) > 0.9);  // continuous in sign
      before = run.quaternion();
      const double h = 1e-5;
      const Eigen::Matrix3d step =
          wobble(run.phase() + h, angle, turns) * wobble(run.phase() - h, angle, turns).transpose();
      rate = std::max(rate, (so3::log(step) / (2 * h) / 2.0 - run.angular_velocity()).norm());
    }
    CHECK(error < limit);
    CHECK(rate < 1e-3);
  }
}

TEST_CASE("frequency, amplitude and centre change on the way without a jump of the acceleration") {
  const PoseDmp model = PoseDmp::fit(stirring(300, 1.0), rhythmic());
  Eigen::Matrix4d centre = model.goal();
  centre.topRightCorner<3, 1>() += Eigen::Vector3d(0.1, 0, 0.05);
  const auto largest = [&](double dt) {
    PoseRun run(model);
    double jump = 0.0;
    Vector6 before = run.acceleration();
    for (int k = 0; k < static_cast<int>(4.0 / dt); ++k) {
      if (std::abs(run.time() - 1.0) < dt / 4) run.set_amplitude(0.5);
      if (std::abs(run.time() - 2.0) < dt / 4) run.set_goal(centre);
      if (std::abs(run.time() - 3.0) < dt / 4) run.set_duration(0.5);
      run.step(dt);
      jump = std::max(jump, (run.acceleration() - before).norm());
      before = run.acceleration();
    }
    return jump;
  };
  CHECK(largest(5e-4) < 0.55 * largest(1e-3));
  PoseRun run(model);
  run.set_amplitude(0.5);
  CHECK(run.amplitude() == 0.5);
  run.set_goal(centre);
  run.step(5.25);
  const Eigen::Vector3d mean = model.goal().topRightCorner<3, 1>();
  const Eigen::Vector3d wanted = centre.topRightCorner<3, 1>() + 0.5 * (curve(0.25) - mean);
  CHECK((run.position() - wanted).norm() < 1e-5);
  CHECK(run.set_amplitude(-1.0) == Status::invalid_input);
  CHECK(run.set_amplitude(std::nan("")) == Status::invalid_input);
}

TEST_CASE("from rest at the centre it comes into the same cycle") {
  const Dmp model = Dmp::fit(cycle(200, 1.0), rhythmic());
  Run run(model);
  run.start_from(model.goal(), Eigen::Vector3d::Zero());
  run.step(4.0);
  CHECK((run.position() - curve(4.0)).norm() < 1e-6);
  CHECK(run.start_from(model.goal(), Eigen::VectorXd(Eigen::Vector3d::Zero()), 0.5) == Status::running);
  run.step(0.6);
  CHECK((run.position() - curve(0.6)).norm() < 1e-6);
}

TEST_CASE("via-points of later cycles are passed, and a discrete motion joins at any phase") {
  const PoseDmp stir = PoseDmp::fit(stirring(300, 1.0), rhythmic());
  PoseRun run(stir);
  Eigen::Matrix4d via = stir.goal();
  CHECK(run.via(2.3, via) == Status::running);
  CHECK(run.via(12.0, via) == Status::invalid_input);
  run.step(2.3);
  CHECK((run.pose() - via).norm() < 1e-8);
  const PoseDmp away = PoseDmp::fit(pose(200, 2.0));
  const PoseDmpSequence sequence({{away}, {stir, 5.3, 0.5}, {away, 1.0, 0.5}});
  CHECK(sequence.duration() == doctest::Approx(2.0 + 5.3 + 2.0));
  const auto steps = [&](double dt) {
    const RowMatrix a = sequence.rollout({}, {}, dt).acceleration;
    return (a.bottomRows(a.rows() - 1) - a.topRows(a.rows() - 1)).rowwise().norm().maxCoeff();
  };
  CHECK(steps(5e-4) < 0.55 * steps(1e-3));
  const std::string text = to_json(sequence);
  CHECK(to_json(std::get<PoseDmpSequence>(from_json(text))) == text);
}

TEST_CASE("a rhythmic model is saved with its motion, and read again to the last bit") {
  const PoseDmp model = PoseDmp::fit(stirring(300, 1.0), rhythmic());
  const std::string text = to_json(model);
  CHECK(text.find("\"motion\": \"rhythmic\"") != std::string::npos);
  CHECK(text.find("\"version\": 3") != std::string::npos);
  const auto again = std::get<PoseDmp>(from_json(text));
  CHECK(to_json(again) == text);
  CHECK(again.options() == model.options());
  PoseRun a(model), b(again);
  a.step(3.7), b.step(3.7);
  CHECK(a.pose() == b.pose());
  CHECK(to_json(PoseDmp::fit(pose(200, 2.0))).find("motion\"") == std::string::npos);
}

TEST_CASE("a rhythmic run takes no memory in the loop") {
  PoseRun run(PoseDmp::fit(stirring(300, 1.0), rhythmic()));
  const Eigen::Matrix4d centre = run.goal();
  CHECK(allocations_in([&] {
          for (int k = 0; k < 3000; ++k) {
            if (k == 500) run.set_amplitude(0.5);
            if (k == 900) run.set_goal(centre);
            if (k == 1000) run.set_duration(0.5);
            if (k == 1200) run.via(run.phase() + 0.5, centre);
            run.step(1e-3);
          }
        }) == 0);
}

TEST_CASE("what is no cycle, and options that a rhythmic motion has no choice in, are refused") {
  const auto refuse = [](const DmpOptions& options, const Demonstration& demonstration,
                         const std::string& words) {
    CHECK_THROWS_WITH_AS(Dmp::fit(demonstration, options), doctest::Contains(words.c_str()), InvalidArgument);
  };
  refuse(rhythmic(), reach(100, 1.0), "find_cycle");
  DmpOptions options = rhythmic();
  options.scaling = Scaling::per_axis;
  refuse(options, cycle(200, 1.0), "options.scaling");
  options = rhythmic();
  options.kernels = Kernels::source;
  refuse(options, cycle(200, 1.0), "options.kernels");
  refuse(rhythmic(3), cycle(200, 1.0), "basis_count: 3");
  CHECK_THROWS_WITH_AS(OrientationDmp::fit(rotation(100, 1.0, 3.0), rhythmic()),
                       doctest::Contains("find_cycle"), InvalidArgument);
}

TEST_CASE("period, transient and cycle are found in a recording whose tempo wanders") {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 1e-3);
  const int n = 2000;
  const double duration = 10.0, period = 1.1;
  RowMatrix y(n, 3);
  Eigen::VectorXd phase(n);
  for (int k = 0; k < n; ++k) {
    const double t = duration * k / (n - 1);
    phase[k] = t / period + 0.15 * std::sin(2 * M_PI * t / 6.0);
    y.row(k) = curve(phase[k]);
    if (t < 0.6) y.row(k) += 0.3 * (1 - t / 0.6) * Eigen::RowVector3d(1, -1, 0.5);
    for (int d = 0; d < 3; ++d) y(k, d) += noise(generator);
  }
  const Cycle<Demonstration> found = find_cycle(Demonstration(grid(n, duration), y));
  CHECK(found.report.period == doctest::Approx(period).epsilon(0.05));
  CHECK(found.report.begins > 0.2);
  CHECK(found.report.begins < 2.0);
  CHECK(found.report.unexplained < 0.05);
  CHECK(found.report.lengths.size() >= 7);
  CHECK(found.demonstration.size() == 201);
  CHECK((found.demonstration.position().row(0) - found.demonstration.position().row(200)).norm() == 0.0);
  // The cycle is the curve, from some phase on.
  double best = 1.0;
  for (int shift = 0; shift < 1000; ++shift) {
    double worst = 0.0;
    for (int k = 0; k <= 200; k += 10)
      worst = std::max(
          worst,
          (found.demonstration.position().row(k).transpose() - curve(k / 200.0 + shift / 1000.0)).norm());
    best = std::min(best, worst);
  }
  CHECK(best < 0.01);
}

TEST_CASE("cycles of poses are found with their turns, and learned") {
  const int n = 1500;
  Poses poses;
  const Eigen::VectorXd t = grid(n, 6.0);
  for (int k = 0; k < n; ++k) {
    const double s = t[k] / 1.2 + 0.03 * std::sin(t[k]);
    poses.push_back(pose_of(wobble(s, 0.5, 1), curve(s)));
  }
  const Cycle<PoseDemonstration> found = find_cycle(PoseDemonstration(t, poses));
  CHECK(found.report.period == doctest::Approx(1.2).epsilon(0.01));
  const PoseDmp model = PoseDmp::fit(found.demonstration, rhythmic());
  CHECK(model.parameters().reference.row(1).tail<3>().norm() == doctest::Approx(1.0));
  const PoseTrajectory again = model.rollout_at(Eigen::VectorXd::LinSpaced(50, 0.0, 3.0 * model.duration()));
  for (const Eigen::Matrix4d& one : again.pose) {
    double nearest = 10.0;
    for (const Eigen::Matrix4d& other : poses) nearest = std::min(nearest, (one - other).norm());
    CHECK(nearest < 0.05);
  }
}

TEST_CASE("recordings without a period are refused with what was found") {
  const auto refuse = [](const Demonstration& recording, const CycleOptions& options,
                         const std::string& words) {
    CHECK_THROWS_WITH_AS(find_cycle(recording, options), doctest::Contains(words.c_str()), InvalidArgument);
  };
  refuse(reach(200, 2.0), {}, "no period");
  refuse({grid(100, 1.0), RowMatrix::Constant(100, 2, 0.3)}, {}, "does not move");
  refuse(cycle(200, 1.0), {}, "Expected a motion that repeats");
  refuse(cycle(200, 1.0), {-1.0}, "minimum_period");
  refuse(cycle(200, 1.0), {0.0, 0}, "harmonics");
}
