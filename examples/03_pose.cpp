#include <cmath>
#include <dmp/file.hpp>
#include <dmp/so3.hpp>
#include <iostream>

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(200, 0.0, 2.0);  // s
  dmp::Poses poses;
  for (const double t : times)
    poses.push_back(dmp::pose_of(dmp::so3::exp({0.2 * t, 0.0, 0.5 * t}),
                                 {0.1 * std::sin(t), 0.1 * std::cos(t), 0.05 * t}));
  const dmp::PoseDmp model = dmp::PoseDmp::fit(dmp::PoseDemonstration(times, poses));
  dmp::PoseRun run(model);  // all memory is taken here
  int steps = 0;
  while (run.step(1e-3) == dmp::Status::running) ++steps;  // noexcept, no allocation: for a 1 kHz loop
  std::cout << steps << " steps\n" << run.pose() << "\n\n" << run.twist().transpose() << "\n";
}
