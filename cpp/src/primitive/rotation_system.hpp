#pragma once

#include <dmp/orientation_dmp.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "primitive/ends.hpp"
#include "primitive/forcing_scale.hpp"
#include "primitive/goal_filter.hpp"
#include "primitive/offset_space.hpp"
#include "primitive/spring_damper.hpp"
#include "primitive/turning_system.hpp"

namespace dmp::detail {

/// The transformation system of rotations: its state (R, eta = tau omega, e = Log(Rg R^T) on its branch) and
/// how it moves over a step of the phase. The same interface as VectorSystem.
class RotationSystem {
 public:
  RotationSystem(const DmpOptions& options, const Ends<RotationSpace>& ends);

  static constexpr Eigen::Index dimension() noexcept { return 3; }
  void begin(const Eigen::Matrix3d& rotation, RotationSpace::TangentArgument eta) noexcept;
  void set_goal(const Eigen::Matrix3d& goal) noexcept;
  void start_with_goal(const Eigen::Matrix3d& goal) noexcept;

  bool unscaled() const noexcept { return turning_ ? turning_->unscaled() : scale_.is_one(); }
  bool advances() const noexcept { return turning_ ? turning_->advances() : scale_.advances(); }
  void scale(double* forcing, const double* advance) const noexcept {
    if (turning_) return turning_->scale(forcing, advance);
    scale_.apply(forcing, advance);
  }
  void to_drive(double* tangent) const noexcept;

  void set_phase(double s) noexcept {
    if (turning_) turning_->set_phase(s);
  }
  void advance(double step, const Nodes& drive) noexcept;
  bool compute_outputs(double speed, double speed_rate, const double* drive) noexcept;
  void publish() noexcept;
  /// Adds an offset to the outputs, its derivatives per s; what moves on stays as it is.
  void displace(const Shift& by) noexcept { OffsetIn<RotationSpace>::displace(outputs_, by); }

  /// As VectorSystem has them.
  void hold() noexcept;
  bool confine(SafetyStep& filter, Eigen::Index first, bool place, double speed, double& pull) noexcept;
  static constexpr Eigen::Index axes() noexcept { return 0; }

  RotationSpace::Output output() const noexcept { return outputs_; }
  RotationSpace::PointView goal() const noexcept { return goal_.target().toRotationMatrix(); }
  RotationSpace::PointView point() const noexcept;
  void velocity(double speed, double* out) const noexcept;

 private:
  Eigen::Vector3d eta() const noexcept;
  void jump_to_goal() noexcept;
  void rescale() noexcept;
  void advance_goal(double step) noexcept;
  /// e_ anew, after the goal or R changed by other than a step, and z_ so that omega stays.
  void follow_goal() noexcept;
  void follow_error() noexcept;
  void advance_ude(double step, const Nodes& drive) noexcept;
  void advance_log_linear(double step, const Nodes& drive) noexcept;
  void advance_euler(double step, const double* drive) noexcept;
  void turn_to(const Eigen::Vector3d& p) noexcept;
  /// Log(goal q^-1), on the branch nearest to e unless the principal one is wanted.
  Eigen::Vector3d error(const Eigen::Quaterniond& goal, const Eigen::Quaterniond& q) const noexcept;
  /// eta' = alpha (beta e - eta) + drive
  Eigen::Vector3d acceleration(const Eigen::Vector3d& e, const Eigen::Vector3d& eta,
                               const double* drive) const noexcept;

  std::optional<TurningSystem> turning_;  // in the turning form, which leaves e_ and z_ alone
  Integrator integrator_;
  OrientationForm form_;
  LogBranch branch_;
  SpringDamper spring_;
  ForcingScale scale_;
  GoalFilter<Eigen::Quaterniond> goal_;
  Eigen::Quaterniond start_;
  Eigen::Vector3d model_error_;   // Log(Rg R0^T) of the demonstration, on its branch
  Eigen::Vector3d displacement_;  // the same of this run
  Eigen::Quaterniond q_;
  Eigen::Vector3d eta_;  // in the forms of p set by compute_outputs
  Eigen::Vector3d e_;
  Eigen::Vector3d z_ = Eigen::Vector3d::Zero();               // p' of the log-linear form, p = -e_
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();  // Exp(p)
  RotationSpace::Outputs next_{};                             // computed, not published yet
  RotationSpace::Outputs outputs_;
  RotationSpace::Outputs held_;  // where the step began
};

}  // namespace dmp::detail
