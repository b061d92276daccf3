// The loop of a robot at 1 kHz: the goal moves while the arm does, and the clock of the motion slows down as
// far as the robot falls behind, so that it goes on where it was held up. The time of every cycle is
// recorded. Usage: 15_robot_loop arm.urdf
//
// Phase stopping: Ijspeert et al., Neural Computation 25, 2013; DmpOptions::phase_stop is its gain.
#include <dmp/inverse_kinematics.hpp>
#include <dmp/joint_tracker.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/so3.hpp>

#include <time.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

namespace {

constexpr double kPeriod = 1e-3;            // s
constexpr double kPhaseStop = 200.0;        // 1/rad: 5 mrad behind, the phase goes on at half its speed
constexpr double kLag = 0.01;               // s, of the robot's own controller
constexpr int kMoved = 700;                 // the tick at which the goal is seen elsewhere
constexpr int kHeld = 1200, kLetGo = 1700;  // someone holds the arm

dmp::PoseDmp learned() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(200, 0.0, 2.0);  // s
  dmp::Poses poses;                                                         // tool in link0, m
  for (const double t : times) {
    const double u = t / 2.0, s = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);  // from rest to rest
    poses.push_back(
        dmp::pose_of(dmp::so3::exp({0.0, M_PI / 2 + 0.2 * s, 0.0}), {0.5, 0.4 * (s - 0.5), 0.6 + 0.1 * s}));
  }
  dmp::DmpOptions options;
  options.phase_stop = kPhaseStop;
  return dmp::PoseDmp::fit(dmp::PoseDemonstration(times, poses), options);
}

// What a robot's own controller does with the joints that it is sent; here they are followed with a lag.
class Robot {
 public:
  explicit Robot(const Eigen::VectorXd& joints) : measured_(joints) {}
  const Eigen::VectorXd& measured() const { return measured_; }
  void command(const Eigen::VectorXd& joints, bool held) {
    if (!held) measured_ += kPeriod / kLag * (joints - measured_);
  }

 private:
  Eigen::VectorXd measured_;
};

double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

int main(int count, char** arguments) {
  const dmp::Arm arm = dmp::Arm::from_urdf_file(count > 1 ? arguments[1] : "arm.urdf", "link0", "tool");
  dmp::PoseRun run(learned());
  const dmp::IkResult first = dmp::InverseKinematics(arm).solve(run.pose());
  if (!first.ok()) return 1;
  dmp::JointTracker tracker(arm, first.joints);
  Robot robot(first.joints);
  Eigen::Matrix4d goal = run.goal();
  std::vector<double> cycles;
  cycles.reserve(20000);  // all memory is taken before the loop

  double farthest = 0.0;
  int ticks = 0;
  for (dmp::Status status = dmp::Status::running; status == dmp::Status::running && ticks < 20000; ++ticks) {
    const double began = cpu_seconds();
    if (ticks == kMoved) {
      goal(1, 3) += 0.05;
      run.set_goal(goal);
    }
    const double behind = (tracker.joints() - robot.measured()).cwiseAbs().maxCoeff();
    run.set_tracking_error(behind);
    status = run.step(kPeriod);
    tracker.track(run.pose(), kPeriod);
    robot.command(tracker.joints(), ticks >= kHeld && ticks < kLetGo);
    cycles.push_back(cpu_seconds() - began);
    farthest = std::max(farthest, behind);
  }
  for (int settle = 0; settle < 500; ++settle) {  // the goal filter and the robot's lag run out
    run.step(kPeriod);
    tracker.track(run.pose(), kPeriod);
    robot.command(tracker.joints(), false);
  }
  const Eigen::Vector3d end = arm.forward_kinematics(robot.measured()).topRightCorner<3, 1>();
  const double miss = (end - goal.topRightCorner<3, 1>()).norm();
  std::sort(cycles.begin(), cycles.end());
  std::cout << ticks << " ticks for a motion of 2 s that was held up for 0.5 s; at most " << farthest
            << " rad behind, " << 1e3 * miss << " mm from the moved goal\ncycles: median "
            << 1e6 * cycles[cycles.size() / 2] << " us, 99.9 % "
            << 1e6 * cycles[cycles.size() - 1 - cycles.size() / 1000] << " us of CPU\n";
  // Without phase stopping the robot would fall behind by 0.88 rad.
  return ticks > 2300 && farthest < 0.5 && miss < 1e-3 ? 0 : 1;
}
