// Step through a motion as a control loop does, and change the goal and the tempo on the way.
#include <dmp/dmp.hpp>

#include <cmath>
#include <iostream>

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);  // s
  dmp::RowMatrix positions(100, 2);                                         // m
  positions << times.array().square() * (3.0 - 2.0 * times.array()),
      0.5 * (M_PI * times.array()).sin().square();
  const dmp::Dmp reach = dmp::Dmp::fit(dmp::Demonstration(times, positions));

  dmp::Run run(reach);  // takes all its memory here; one for each loop or thread
  const Eigen::VectorXd moved = Eigen::Vector2d(1.2, 0.1);
  const double dt = 1e-3;  // s
  int steps = 0;
  while (run.step(dt) == dmp::Status::running) {  // noexcept, takes no memory
    ++steps;
    if (steps == 300 && run.set_goal(moved) != dmp::Status::running) return 1;
    if (steps == 600) run.set_duration(1.5);  // s; the path stays the same
  }
  for (int k = 0; k < 500; ++k) run.step(dt);  // the spring holds the goal
  std::cout << steps << " steps, at " << run.position().transpose() << " m, moving at "
            << run.velocity().norm() << " m/s\n";
  return (run.position() - moved).norm() < 1e-3 ? 0 : 1;
}
