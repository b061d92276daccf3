// A camera's thread sees where the cup stands and posts the goal; the control loop takes the latest one.
// Neither waits for the other: the mailbox has no lock.
#include <dmp/mailbox.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/so3.hpp>

#include <chrono>
#include <cmath>
#include <iostream>
#include <thread>

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(200, 0.0, 1.0);  // s
  dmp::Poses poses;
  for (const double t : times)
    poses.push_back(
        dmp::pose_of(dmp::so3::exp({0.0, 0.0, 0.8 * t}), {0.4 * t, 0.1 * std::sin(3.0 * t), 0.2}));
  dmp::PoseRun run(dmp::PoseDmp::fit(dmp::PoseDemonstration(times, poses)));

  const Eigen::Matrix4d goal = run.goal();
  dmp::Mailbox<Eigen::Matrix4d> goals(goal);
  std::thread camera([&goals, goal] {  // 100 looks at a cup that drifts by 0.1 m
    Eigen::Matrix4d seen = goal;
    for (int look = 1; look <= 100; ++look) {
      seen(1, 3) = goal(1, 3) + 0.001 * look;
      goals.post(seen);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });

  int changes = 0;
  Eigen::Matrix4d wanted = goal;
  auto next = std::chrono::steady_clock::now();
  for (int tick = 0; tick < 1500; ++tick) {  // 1 kHz; at rest over the goal at the end
    if (goals.take(wanted)) {
      run.set_goal(wanted);
      ++changes;
    }
    if (run.step(1e-3) == dmp::Status::not_finite) return 1;
    std::this_thread::sleep_until(next += std::chrono::milliseconds(1));
  }
  camera.join();
  const double miss = (run.position() - wanted.topRightCorner<3, 1>()).norm();
  std::cout << changes << " goals taken, at the end " << 1e3 * miss << " mm from the last\n";
  return miss < 1e-3 && wanted(1, 3) - goal(1, 3) > 0.0999 ? 0 : 1;
}
