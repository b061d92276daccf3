// A coupling term of your own: the run steers around an obstacle (Hoffmann et al. 2009, ICRA, in the plane).
#include <dmp/dmp.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace {

/// Turns the velocity away from a point, the faster the more straight it heads for it.
class Steering {
 public:
  explicit Steering(const Eigen::Vector2d& obstacle) : obstacle_(obstacle) {}

  // Called in each internal step: noexcept, and no memory is taken.
  Eigen::Vector2d operator()(const dmp::CouplingState<dmp::VectorSpace>& state) const noexcept {
    const Eigen::Vector2d away = obstacle_ - state.point;
    const Eigen::Vector2d velocity = state.velocity / state.speed;  // over phase
    if (velocity.norm() < 1e-9) return Eigen::Vector2d::Zero();
    const Eigen::Vector2d aside(-velocity.y(), velocity.x());
    const double along = away.dot(velocity), across = away.dot(aside);
    const double angle = std::atan2(std::abs(across), along);
    return (across > 0.0 ? -1.0 : 1.0) * kGain * angle * std::exp(-kDecay * angle) * aside;
  }

 private:
  static constexpr double kGain = 60.0;
  static constexpr double kDecay = 3.0;
  Eigen::Vector2d obstacle_;
};

}  // namespace

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);  // s
  dmp::RowMatrix positions(100, 2);                                         // m
  positions << times.array().square() * (3.0 - 2.0 * times.array()), Eigen::ArrayXd::Zero(100);
  const dmp::Dmp reach = dmp::Dmp::fit(dmp::Demonstration(times, positions));

  const Eigen::Vector2d obstacle(0.5, 0.02);  // m
  const Steering steering(obstacle);
  dmp::Run run(reach);
  double clearance = 1.0;
  while (run.step(1e-3, steering) == dmp::Status::running)
    clearance = std::min(clearance, (run.position() - obstacle).norm());
  std::cout << "passes the obstacle at " << clearance << " m, ends " << (run.position() - reach.goal()).norm()
            << " m from the goal\n";
  return clearance > 0.05 && (run.position() - reach.goal()).norm() < 0.02 ? 0 : 1;
}
