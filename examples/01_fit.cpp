// Learn a reach from samples, keep it in a file, and go to another goal at another tempo.
#include <dmp/file.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);  // s
  dmp::RowMatrix positions(100, 3);                                         // m
  for (int k = 0; k < 100; ++k) {
    const double s = times[k];
    const double minimum_jerk = s * s * s * (10 - 15 * s + 6 * s * s);
    positions.row(k) << 0.3 * minimum_jerk, -0.2 * minimum_jerk, 0.1 * std::sin(M_PI * minimum_jerk);
  }
  dmp::DmpOptions options;  // every choice there is; the defaults reproduce the demonstration
  options.basis_count = 50;
  dmp::save(dmp::Dmp::fit(dmp::Demonstration(times, positions), options), "reach.json");

  const dmp::Dmp reach = dmp::load_dmp("reach.json");
  const Eigen::VectorXd cup = Eigen::Vector3d(0.35, -0.1, 0.05);
  const dmp::Trajectory plan = reach.rollout(cup, 2.0 /* s */, 1e-3 /* s */);
  const Eigen::RowVectorXd last = plan.position.row(plan.position.rows() - 1);
  std::cout << plan.time.size() << " samples, last at " << last << " m\n";
  std::remove("reach.json");
  return (last - cup.transpose()).norm() < 1e-3 ? 0 : 1;
}
