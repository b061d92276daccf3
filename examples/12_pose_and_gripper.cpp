// Learn the pose of a tool and the opening of its gripper in one phase, save them, and go to a new goal.
#include <dmp/file.hpp>
#include <dmp/pose_gripper_dmp.hpp>
#include <dmp/so3.hpp>

#include <cmath>
#include <iostream>

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(100, 0.0, 2.0);  // s
  dmp::Poses poses;
  dmp::RowMatrix opening(100, 1);  // m
  for (int k = 0; k < 100; ++k) {
    const double s = times[k] / 2.0, way = s * s * (3.0 - 2.0 * s);
    poses.push_back(dmp::pose_of(dmp::so3::exp({0.0, 0.0, way}), {0.4 * way, 0.0, 0.3 * std::sin(M_PI * s)}));
    opening(k, 0) = 0.04 * (1.0 - way);  // closes on the way
  }
  const auto grasp = dmp::PoseGripperDmp::fit(dmp::PoseGripperDemonstration(times, poses, opening));
  dmp::save(grasp, "grasp.json");

  dmp::PoseGripperRun run(dmp::load_pose_gripper_dmp("grasp.json"));
  Eigen::Matrix4d there = grasp.goal().first;
  there(1, 3) += 0.1;                                                  // m
  const Eigen::VectorXd narrow = Eigen::VectorXd::Constant(1, 0.005);  // m, it closes on something
  run.set_goal({there, narrow});
  while (run.step(1e-3) == dmp::Status::running) continue;
  for (int k = 0; k < 1000; ++k) run.step(1e-3);  // the spring holds the goal
  std::cout << "at\n" << run.pose() << "\nopen by " << run.gripper()[0] << " m\n";
  return (run.pose() - there).norm() < 1e-3 && std::abs(run.gripper()[0] - 0.005) < 1e-5 ? 0 : 1;
}
