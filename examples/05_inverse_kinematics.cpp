// Joints for a learned motion: a path of poses, followed by a URDF arm and slowed down to its limits.
// Usage: 05_inverse_kinematics arm.urdf
#include <dmp/inverse_kinematics.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/so3.hpp>
#include <dmp/time_scaling.hpp>

#include <cmath>
#include <iostream>

int main(int count, char** arguments) {
  const dmp::Arm arm = dmp::Arm::from_urdf_file(count > 1 ? arguments[1] : "arm.urdf", "link0", "tool");
  dmp::InverseKinematics ik(arm);  // one for each thread

  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);  // s
  dmp::Poses poses;                                                         // tool in link0, m
  for (const double t : times)
    poses.push_back(dmp::pose_of(dmp::so3::exp({0.0, M_PI / 2 + 0.3 * t, 0.0}),
                                 {0.5, 0.2 * std::sin(M_PI * (t - 0.5)), 0.6 + 0.1 * t}));
  const dmp::PoseDmp wipe = dmp::PoseDmp::fit(dmp::PoseDemonstration(times, poses));

  const dmp::IkResult first = ik.solve(wipe.start());  // the closest joints, and why they are not exact
  std::cout << "start: " << dmp::name_of(first.status) << ", " << first.position_error << " m off\n";

  const dmp::PoseTrajectory plan = wipe.rollout({}, {}, 0.01);
  dmp::JointTrajectory joints = ik.follow(plan.time, plan.pose);
  const Eigen::VectorXd acceleration = Eigen::VectorXd::Constant(arm.joint_count(), 10.0);  // rad/s^2
  joints = dmp::stretched(joints, dmp::duration_factor(joints, arm.velocity_limit(), acceleration));
  std::cout << joints.report.summary() << "\nfastest at " << joints.time[joints.time.size() - 1] << " s\n";
  return first.ok() && joints.report.complete() ? 0 : 1;
}
