// A loop at 1 kHz on Linux: memory locked, a real-time priority where it is allowed, absolute deadlines,
// overruns counted.
#include <dmp/pose_dmp.hpp>
#include <dmp/so3.hpp>

#include <sched.h>
#include <sys/mman.h>
#include <time.h>

#include <cmath>
#include <iostream>

namespace {

constexpr long kPeriod = 1000000;  // ns

dmp::PoseDmp learned() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(200, 0.0, 2.0);  // s
  dmp::Poses poses;
  for (const double t : times)
    poses.push_back(dmp::pose_of(dmp::so3::exp({0.2 * t, 0.0, 0.5 * t}),
                                 {0.1 * std::sin(t), 0.1 * std::cos(t), 0.05 * t}));
  return dmp::PoseDmp::fit(dmp::PoseDemonstration(times, poses));
}

timespec after(timespec time, long nanoseconds) {
  time.tv_nsec += nanoseconds;
  time.tv_sec += time.tv_nsec / 1000000000;
  time.tv_nsec %= 1000000000;
  return time;
}

bool passed(const timespec& deadline) {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec > deadline.tv_sec || (now.tv_sec == deadline.tv_sec && now.tv_nsec > deadline.tv_nsec);
}

}  // namespace

int main() {
  dmp::PoseRun run(learned());  // all memory is taken before it is locked
  run.set_duration(0.5);
  const bool locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;  // needs CAP_IPC_LOCK
  const sched_param priority{80};
  const bool fifo = sched_setscheduler(0, SCHED_FIFO, &priority) == 0;  // needs CAP_SYS_NICE
  int overruns = 0, ticks = 0;
  timespec deadline;
  clock_gettime(CLOCK_MONOTONIC, &deadline);
  dmp::Status status = dmp::Status::running;
  for (; status == dmp::Status::running; ++ticks) {
    status = run.step(1e-9 * kPeriod);  // here a robot would be sent run.pose() and run.twist()
    deadline = after(deadline, kPeriod);
    if (passed(deadline)) ++overruns;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr);
  }
  std::cout << ticks << " ticks, " << overruns << " overruns, memory " << (locked ? "" : "not ") << "locked, "
            << (fifo ? "SCHED_FIFO" : "normal priority") << "\n";
  return status == dmp::Status::finished ? 0 : 1;
}
