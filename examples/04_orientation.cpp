// Learn an orientation that was recorded as Euler angles, and turn to another goal.
#include <dmp/orientation_dmp.hpp>
#include <dmp/so3.hpp>

#include <cmath>
#include <iostream>

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(200, 0.0, 2.0);  // s
  dmp::RowMatrix angles(200, 3);  // rad: yaw, pitch, roll about the moving axes
  for (int k = 0; k < 200; ++k)
    angles.row(k) << 0.8 * std::sin(times[k]), 0.5 * std::cos(times[k]), 0.6 * times[k];
  const auto pour = dmp::OrientationDemonstration::from_euler(times, angles, "ZYX");
  const dmp::OrientationDmp model = dmp::OrientationDmp::fit(pour);

  const Eigen::Matrix3d goal = model.goal() * dmp::so3::exp({0.0, 0.0, 0.2});  // 0.2 rad further
  const dmp::OrientationTrajectory plan = model.rollout(goal, 3.0 /* s */, 0.01 /* s */);
  std::cout << "ends at yaw, pitch, roll = " << dmp::so3::to_euler(plan.rotation.back(), "ZYX").transpose()
            << " rad, " << dmp::so3::distance(plan.rotation.back(), goal) << " rad from the goal\n";
  return dmp::so3::distance(plan.rotation.back(), goal) < 1e-3 ? 0 : 1;
}
