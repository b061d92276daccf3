// A reach that keeps limits and goes around a ball that comes across.
#include <dmp/dmp.hpp>
#include <dmp/safety_filter.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const int count = 101;
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(count, 0.0, 2.0);
  dmp::RowMatrix path(count, 3);
  for (int k = 0; k < count; ++k) {
    const double s = time[k] / 2.0;
    path.row(k) << 0.6 * s * s * s * (10 - 15 * s + 6 * s * s), 0.1 * std::sin(M_PI * s), 0.3;
  }
  const dmp::Dmp model = dmp::Dmp::fit(dmp::Demonstration(time, path));

  dmp::SafetyLimits limits;
  limits.velocity = Eigen::Vector3d::Constant(0.8);      // m/s
  limits.acceleration = Eigen::Vector3d::Constant(5.0);  // m/s^2
  dmp::SafetyOptions options;
  options.margin = 0.02;  // m
  dmp::SafetyFilter filter(limits, 2, options);
  filter.set(0, dmp::Sphere{{0.3, 0.4, 0.3}, 0.08, {0.0, -0.25, 0.0}});  // comes across at 0.25 m/s
  filter.set(1, dmp::Plane{{0.0, 0.0, 0.2}, {0.0, 0.0, 1.0}});           // a table

  dmp::Run run(model);
  double clearance = filter.options().margin;
  int blocked = 0;
  for (int k = 0; k < 3000; ++k) {
    // A tracker of the ball would say here where it is now: filter.set(0, ..).
    if (run.step(1e-3, filter) == dmp::Status::blocked) ++blocked;
    clearance = std::min(clearance, filter.clearance());
  }
  std::printf("nearest: %.3f m, blocked in %d steps, %.1e m from the goal\n", clearance, blocked,
              (run.position() - run.goal()).norm());
  return clearance > 0.0 && (run.position() - run.goal()).norm() < 1e-3 ? 0 : 1;
}
