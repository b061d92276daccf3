// A pose is passed that is seen on the way, and another motion goes on from where the first one is.
#include <dmp/pose_dmp.hpp>
#include <dmp/sequence.hpp>
#include <dmp/so3.hpp>

#include <cmath>
#include <cstdio>

namespace {

/// A reach of 0.4 m along x that turns by `turn` rad, from `at` on.
dmp::PoseDmp reach(double at, double turn) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(101, 0.0, 2.0);
  dmp::Poses poses;
  for (const double t : time) {
    const double s = t / 2.0, way = s * s * s * (10 - 15 * s + 6 * s * s);
    poses.push_back(dmp::pose_of(dmp::so3::exp({0, 0, turn * way}), {at + 0.4 * way, 0.0, 0.3}));
  }
  return dmp::PoseDmp::fit(dmp::PoseDemonstration(time, poses));
}

}  // namespace

int main() {
  const dmp::PoseDmp there = reach(0.0, 0.8), back = reach(0.4, -0.8);
  dmp::PoseRun run(there), next(back);
  while (run.phase() < 0.3) run.step(1e-3);

  // In the loop, without memory: a pose to pass at six tenths, changed within a quarter of the phase.
  Eigen::Matrix4d via = run.ahead(0.6).point;
  via(2, 3) += 0.1;
  if (run.via(0.6, via, dmp::Reach(0.25)) == dmp::Status::too_late) std::puts("too late");
  while (run.phase() < 0.6 - 1e-9) run.step(1e-3);
  std::printf("missed by %.1e m\n", (run.position() - via.topRightCorner<3, 1>()).norm());

  // On with the next motion, at speed.
  const Eigen::Matrix<double, 6, 1> acceleration = run.acceleration();
  run.join(next, 0.4);
  std::printf("the acceleration jumps by %.1e\n", (run.acceleration() - acceleration).norm());
  while (run.step(1e-3) == dmp::Status::running) continue;
  std::printf("ends %.1e m from the goal\n", (run.position() - back.goal().topRightCorner<3, 1>()).norm());

  // The same as one value, which is saved and planned like a model.
  const dmp::PoseDmpSequence both({{there, 0.6}, {back, 1.0, 0.4}});
  std::printf("%.1f s in all\n", both.duration());
}
