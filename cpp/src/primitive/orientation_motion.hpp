#pragma once

#include <dmp/options.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "primitive/forcing_scale.hpp"
#include "primitive/position_motion.hpp"
#include "primitive/spring_damper.hpp"
#include "primitive/turning_reference.hpp"

namespace dmp::detail {

/// The transformation system of orientations: its state (R, eta = tau omega, e = Log(Rg R^T) on its branch)
/// and how it moves over a step of the phase.
class OrientationMotion {
 public:
  /// start_error: Log(Rg R0^T) of the demonstration, on its branch; eta = tau omega at the start.
  /// reference: of the turning form, else empty.
  OrientationMotion(const DmpOptions& options, const Eigen::Matrix3d& start, const Eigen::Matrix3d& goal,
                    const Eigen::Vector3d& start_error, const Eigen::Vector3d& eta,
                    const Eigen::Vector3d& amplitude, const RowMatrix& reference);

  void begin(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& eta) noexcept;
  void set_goal(const Eigen::Quaterniond& goal) noexcept;
  /// Before the first step: the goal at once, without the filter.
  void start_with_goal(const Eigen::Quaterniond& goal) noexcept;

  void advance(double step, const ForcingNodes& forcing) noexcept;
  /// Where in the phase it is: what the turning form turns with.
  void set_phase(double s) noexcept { phase_ = s; }
  /// As of PositionMotion.
  bool look(double speed, double speed_rate, const double* forcing) noexcept;
  void publish() noexcept;

  const Eigen::Quaterniond& rotation() const noexcept { return rotation_; }
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  const Eigen::Vector3d& acceleration() const noexcept { return acceleration_; }
  const Eigen::Quaterniond& goal() const noexcept { return target_; }

 private:
  /// p of R = Exp(p) Q(s), which moves as a position does.
  struct Turning {
    TurningReference reference;
    PositionMotion p;
    Eigen::Quaterniond first;  // Q^-1 at the start
    Eigen::Quaterniond last;   // and at the end
  };

  void begin_turning(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& eta) noexcept;
  void set_turning_goal(bool at_once) noexcept;
  bool look_turning(double speed, double speed_rate, const double* forcing) noexcept;
  void jump_to_goal() noexcept;
  void rescale() noexcept;
  /// e_ anew, after the goal or R changed by other than a step, and z_ so that omega stays.
  void follow_goal() noexcept;
  void follow_error() noexcept;
  void advance_ude(double step, const double* start, const double* middle, const double* end) noexcept;
  void advance_log_linear(double step, const double* start, const double* middle, const double* end) noexcept;
  void turn_to(const Eigen::Vector3d& p) noexcept;
  void advance_euler(double step, const double* end) noexcept;
  /// Log(goal q^-1), on the branch nearest to e unless the principal one is wanted.
  Eigen::Vector3d error(const Eigen::Quaterniond& goal, const Eigen::Quaterniond& q) const noexcept;
  /// eta' = alpha (beta e - eta) + f
  Eigen::Vector3d acceleration(const Eigen::Vector3d& e, const Eigen::Vector3d& eta,
                               const double* f) const noexcept;
  /// The goal after another piece of the phase: Exp((1 - exp(-alpha_g piece)) Log(R* Rg^T)) Rg.
  Eigen::Quaterniond filtered_goal(double piece) const noexcept;
  const double* scaled(const double* forcing, int node) noexcept;

  std::optional<Turning> turning_;
  double phase_ = 0.0;
  Integrator integrator_;
  OrientationForm form_;
  LogBranch branch_;
  bool unscaled_;
  double goal_filter_;
  SpringDamper spring_;
  ForcingScale scale_;
  Eigen::Vector3d model_error_;
  Eigen::Quaterniond q_;
  Eigen::Vector3d eta_;  // in the log-linear form from z_, when it is looked at
  Eigen::Vector3d e_;
  Eigen::Vector3d z_;          // p' of the log-linear form, p = -e_
  Eigen::Quaterniond turn_;    // Exp(p)
  Eigen::Quaterniond goal_;    // as filtered
  Eigen::Quaterniond target_;  // as set
  Eigen::Quaterniond start_;
  Eigen::Vector3d displacement_;  // Log(Rg R0^T) of this run, on its branch
  bool settled_ = true;
  Eigen::Matrix<double, 4, 3, Eigen::RowMajor> scratch_ =
      Eigen::Matrix<double, 4, 3, Eigen::RowMajor>::Zero();
  Eigen::Vector3d next_velocity_ = Eigen::Vector3d::Zero();  // to be looked at before they are given out
  Eigen::Vector3d next_acceleration_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation_;  // outputs: the last finite ones
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
};

}  // namespace dmp::detail
