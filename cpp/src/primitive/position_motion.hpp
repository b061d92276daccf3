#pragma once

#include <dmp/options.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>

#include "primitive/forcing_scale.hpp"
#include "primitive/spring_damper.hpp"

namespace dmp::detail {

/// The forcing term at the start, the middle and the end of a step.
struct ForcingNodes {
  const double* start;
  const double* middle;
  const double* end;
};

/// The transformation system of positions: its state and how it moves over a step of the phase.
class PositionMotion {
 public:
  /// start, goal, amplitude (d); z (d) = tau yd at the start.
  PositionMotion(const DmpOptions& options, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                 const Eigen::VectorXd& z, const Eigen::VectorXd& amplitude);

  /// Begins at y with z, the goal not filtered.
  void begin(const Eigen::Ref<const Eigen::VectorXd>& y, const Eigen::Ref<const Eigen::VectorXd>& z) noexcept;
  void set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept;
  /// Before the first step: the goal at once, without the filter.
  void start_with_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept;

  void advance(double step, const ForcingNodes& forcing) noexcept;
  void set_phase(double) noexcept {}
  /// Velocity and acceleration while the phase goes at `speed` (ds/dt) and speeds up at `speed_rate`;
  /// `forcing` is the term as it is now. False if they, or the position, are not finite.
  bool look(double speed, double speed_rate, const double* forcing) noexcept;
  /// Makes what was looked at the outputs.
  void publish() noexcept;

  const Eigen::VectorXd& position() const noexcept { return position_; }
  const Eigen::VectorXd& velocity() const noexcept { return velocity_; }
  const Eigen::VectorXd& acceleration() const noexcept { return acceleration_; }
  const Eigen::VectorXd& goal() const noexcept { return target_; }

 private:
  void jump_to_goal() noexcept;
  void rescale() noexcept;
  double approach(Eigen::Index d, double share) noexcept;
  void follow_goal(double farthest) noexcept;
  void advance_exactly(double step, const double* start, const double* middle, const double* end) noexcept;
  void advance_to_moving_goal(double step, const double* start, const double* middle,
                              const double* end) noexcept;
  void advance_euler(double step, const double* end) noexcept;
  /// The forcing term times its scale, in place `node` of the scratch memory.
  const double* scaled(const double* forcing, int node) noexcept;

  Integrator integrator_;
  bool unscaled_;
  double goal_filter_;
  SpringDamper spring_;
  ForcingScale scale_;
  Eigen::VectorXd start_;
  Eigen::VectorXd y_;
  Eigen::VectorXd z_;
  Eigen::VectorXd goal_;    // as filtered
  Eigen::VectorXd target_;  // as set
  bool settled_ = true;     // goal_ == target_
  RowMatrix scratch_;       // (3 x d) scaled forcing
  Eigen::VectorXd displacement_;
  Eigen::VectorXd next_velocity_;  // to be looked at before they are given out
  Eigen::VectorXd next_acceleration_;
  Eigen::VectorXd position_;  // outputs: the last finite ones
  Eigen::VectorXd velocity_;
  Eigen::VectorXd acceleration_;
};

}  // namespace dmp::detail
