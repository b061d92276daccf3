#pragma once

#include <dmp/dmp.hpp>

#include <Eigen/Core>

#include "primitive/ends.hpp"
#include "primitive/forcing_scale.hpp"
#include "primitive/goal_filter.hpp"
#include "primitive/offset_space.hpp"
#include "primitive/spring_damper.hpp"
#include "safety/safety_step.hpp"

namespace dmp::detail {

/// The transformation system of vectors: its state (y, z = tau yd, g) and how it moves over a step of the
/// phase. Each axis is a linear spring and damper, stepped exactly.
class VectorSystem {
 public:
  VectorSystem(const DmpOptions& options, const Ends<VectorSpace>& ends);

  Eigen::Index dimension() const noexcept { return y_.size(); }
  /// Begins at y with z, the goal not filtered.
  void begin(VectorSpace::PointArgument y, VectorSpace::TangentArgument z) noexcept;
  void set_goal(VectorSpace::PointArgument goal) noexcept;
  /// Before the first step: the goal at once, without the filter.
  void start_with_goal(VectorSpace::PointArgument goal) noexcept;

  /// Whether the drive is the forcing term as it is.
  bool unscaled() const noexcept { return scale_.is_one(); }
  /// Whether the scale asks for the forcing term of the advance.
  bool advances() const noexcept { return scale_.advances(); }
  /// S f in place: the forcing term (d) for where this run starts and goes, with that of the advance of each
  /// part.
  void scale(double* forcing, const double* advance) const noexcept { scale_.apply(forcing, advance); }
  /// A tangent (d) as a drive; of vectors they are the same.
  void to_drive(double*) const noexcept {}

  /// Where in the phase it is.
  void set_phase(double) noexcept {}
  void advance(double step, const Nodes& drive) noexcept;
  /// Velocity and acceleration while the phase goes at `speed` (ds/dt) and speeds up at `speed_rate`; `drive`
  /// is the one now. False if they, or the position, are not finite.
  bool compute_outputs(double speed, double speed_rate, const double* drive) noexcept;
  /// Makes what was computed the outputs.
  void publish() noexcept;
  /// Adds an offset to the outputs, its derivatives per s; what moves on stays as it is.
  void displace(const Shift& by) noexcept { OffsetIn<VectorSpace>::displace(outputs_, by); }

  /// Keeps the outputs, for `confine` to know where a step began.
  void hold() noexcept;
  /// Lets the filter change the outputs, and what moves on with them while the phase goes at `speed`; whether
  /// it did. `first`: axes that stand before these; `place`: obstacles are for them. `pull` becomes the
  /// farthest that the spring would have to be stretched for what the filter changed.
  bool confine(SafetyStep& filter, Eigen::Index first, bool place, double speed, double& pull) noexcept;
  /// Another state, on the way to the same goal.
  void reseat(VectorSpace::PointArgument y, VectorSpace::TangentArgument z) noexcept;
  Eigen::Index axes() const noexcept { return y_.size(); }

  VectorSpace::Output output() const noexcept { return outputs_; }
  VectorSpace::PointView goal() const noexcept { return goal_.target(); }
  VectorSpace::PointView point() const noexcept { return y_; }
  /// (d) while the phase goes at `speed`.
  void velocity(double speed, double* out) const noexcept;

 private:
  void rescale() noexcept;
  void follow_goal() noexcept;
  void advance_exactly(const Nodes& drive) noexcept;
  void advance_to_moving_goal(double step, const Nodes& drive) noexcept;
  void advance_euler(double step, const double* drive) noexcept;

  Integrator integrator_;
  SpringDamper spring_;
  ForcingScale scale_;
  GoalFilter<Eigen::VectorXd> goal_;
  Eigen::VectorXd start_;
  Eigen::VectorXd y_;
  Eigen::VectorXd z_;
  Eigen::VectorXd away_;       // scratch: goal - start, goal - target
  VectorSpace::Outputs next_;  // computed, not published yet
  VectorSpace::Outputs outputs_;
  VectorSpace::Outputs held_;  // where the step began
};

}  // namespace dmp::detail
