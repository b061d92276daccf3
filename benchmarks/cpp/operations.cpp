// One operation of the core, repeated: what scripts count instructions of and what prints thread-CPU times.
//   operations NAME REPEATS     runs it REPEATS times and prints nothing (for callgrind)
//   operations                  prints a table of medians
#include <dmp/batch.hpp>
#include <dmp/file.hpp>
#include <dmp/so3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "stopwatch.hpp"

namespace {

using namespace dmp;

constexpr int kSamples = 1000;
constexpr double kStep = 0.005;  // s

double minimum_jerk(double s) { return s * s * s * (10 - 15 * s + 6 * s * s); }

Eigen::VectorXd times() { return kStep * Eigen::VectorXd::LinSpaced(kSamples, 0.0, kSamples - 1.0); }

RowMatrix reach() {
  RowMatrix y(kSamples, 3);
  for (int k = 0; k < kSamples; ++k)
    y.row(k) = minimum_jerk(k / (kSamples - 1.0)) * Eigen::RowVector3d(.3, -.2, .4);
  return y;
}

Poses poses() {
  const RowMatrix y = reach();
  Poses result;
  for (int k = 0; k < kSamples; ++k) {
    const double u = 3.0 * k / (kSamples - 1.0);
    result.push_back(pose_of(so3::from_euler({.8 * std::sin(u), .5 * std::cos(u), .6 * u}, "ZYX"), y.row(k)));
  }
  return result;
}

/// Nothing is chosen by the data, so that the counts are those of the same model from release to release.
DmpOptions stated() {
  DmpOptions options;
  options.basis_count = 100;
  options.regression = Regression::lwr;
  options.derivatives = Derivatives::interpolate;
  return options;
}

DmpOptions log_linear() {
  DmpOptions options = stated();
  options.orientation_form = OrientationForm::log_linear;
  return options;
}

template <class Run>
std::function<void()> stepping(Run run) {
  return [run = std::move(run)]() mutable {
    if (run.step(kStep) == Status::finished) run.reset();
  };
}

std::map<std::string, std::function<void()>> operations() {
  const Eigen::VectorXd t = times();
  const RowMatrix y = reach();
  const Poses p = poses();
  const Demonstration positions(t, y);
  const PoseDemonstration both(t, p);
  const Dmp dmp = Dmp::fit(positions, stated());
  const PoseDmp pose = PoseDmp::fit(both, stated());
  return {
      {"step_position", stepping(Run(dmp))},
      {"step_pose", stepping(PoseRun(pose))},
      {"step_pose_log_linear", stepping(PoseRun(PoseDmp::fit(both, log_linear())))},
      {"step_pose_at_rest",  // long after the end: as fast as any, unless something turned denormal
       [run =
            [&] {
              PoseRun held(pose);
              for (int i = 0; i < 2000; ++i) held.step(5.0);
              return held;
            }()]() mutable { run.step(kStep); }},
      {"fit_position", [t, y] { Dmp::fit(Demonstration(t, y), stated()); }},
      {"fit_pose", [t, p] { PoseDmp::fit(PoseDemonstration(t, p), stated()); }},
      {"fit_position_automatic", [t, y] { Dmp::fit(Demonstration(t, y)); }},
      {"fit_pose_automatic", [t, p] { PoseDmp::fit(PoseDemonstration(t, p)); }},
      {"fit_100_positions", [t, ys = std::vector<RowMatrix>(100, y)] { fit_each(t, ys, stated()); }},
      {"fit_100_poses", [t, ps = std::vector<Poses>(100, p)] { fit_each(t, ps, stated()); }},
      {"rollout_position", [dmp] { dmp.rollout({}, {}, kStep); }},
      {"rollout_pose", [pose] { pose.rollout({}, {}, kStep); }},
  };
}

}  // namespace

int main(int argc, char** argv) {
  const auto all = operations();
  if (argc == 3) {
    const auto& operation = all.at(argv[1]);
    for (long i = std::atol(argv[2]); i > 0; --i) operation();
    return 0;
  }
  for (const auto& [name, operation] : all)
    std::printf("%-22s %10.3f us\n", name.c_str(), 1e6 * median_seconds(operation));
}
