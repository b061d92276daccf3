// A stirring motion is found in a recording, learned, and carried out faster, smaller and elsewhere.
#include <dmp/cycle.hpp>
#include <dmp/dmp.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

int main() {
  // Eight rounds of about 1.2 s: people are not periodic.
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(1000, 0.0, 10.0);
  dmp::RowMatrix position(time.size(), 3);
  for (Eigen::Index k = 0; k < time.size(); ++k) {
    const double phase = 2.0 * M_PI * (time[k] / 1.2 + 0.1 * std::sin(time[k]));
    position.row(k) << 0.4 + 0.06 * std::cos(phase), 0.06 * std::sin(phase),
        0.2 + 0.01 * std::sin(2.0 * phase);
  }
  const dmp::Cycle<dmp::Demonstration> found = dmp::find_cycle({time, position});
  std::printf("%d cycles of %.2f s\n", static_cast<int>(found.report.lengths.size()), found.report.period);

  dmp::DmpOptions options;
  options.motion = dmp::Motion::rhythmic;
  const dmp::Dmp stir = dmp::Dmp::fit(found.demonstration, options);
  dmp::Run run(stir);
  run.start_from(stir.goal(), Eigen::Vector3d::Zero(), 0.5);  // from rest at the centre
  while (run.time() < 2.0) run.step(1e-3);

  // On the way, without a jump of the acceleration.
  run.set_duration(0.8);
  run.set_amplitude(0.5);
  run.set_goal(stir.goal() + Eigen::Vector3d(0.1, 0.0, 0.0));
  double radius = 0.0;
  while (run.time() < 10.0) {
    run.step(1e-3);
    if (run.time() > 9.0) radius = std::max(radius, (run.position() - run.goal()).head<2>().norm());
  }
  std::printf("after %.1f rounds %.0f mm from the centre\n", run.phase(), 1e3 * radius);
}
