#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/export.hpp>
#include <dmp/forcing.hpp>
#include <dmp/options.hpp>
#include <dmp/realtime.hpp>
#include <dmp/status.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

namespace dmp {

namespace detail {
class ForcingFit;
struct BatchFit;
struct Timetable;
}  // namespace detail

/// All that an OrientationDmp is: what a model file holds.
struct OrientationDmpParameters {
  DmpOptions options;
  double duration = 1.0;                                     ///< tau of the demonstration, s
  Eigen::Matrix3d start = Eigen::Matrix3d::Identity();       ///< R0, body -> world
  Eigen::Matrix3d goal = Eigen::Matrix3d::Identity();        ///< Rg
  Eigen::Vector3d start_velocity = Eigen::Vector3d::Zero();  ///< omega, rad/s, world frame, at `duration`
  Eigen::Vector3d start_error =
      Eigen::Vector3d::Zero();  ///< Log(Rg R0^T) on its branch, rad; beyond pi where the way is longer
  Eigen::Vector3d amplitude = Eigen::Vector3d::Zero();  ///< range of Log(Rg R^T), axis by axis, rad
  RowMatrix weights;                                    ///< (N x 3) of the forcing term
  /// (M + 1 x 4) w x y z, of OrientationForm::turning: coefficients of the quintic B-spline on M equal spans
  /// of the phase that turns along, the first and the last three times. Empty in the other forms.
  RowMatrix reference;
};

/// A dynamic movement primitive for orientations on SO(3). Immutable: share it between threads.
///
///   UDE form:            tau eta_d = alpha (beta Log(Rg R^T) - eta) + S f(x),   tau Rd = [eta]x R
///   log-linear form:     tau z_d = alpha (-beta p - z) + S f(x),  tau p_d = z,  R = Exp(p) Rg
///
///   turning form:        the log-linear one about a rotation that turns along: R = Exp(p) Q(s), p -> p_g
///
/// (Ude et al. 2014, ICRA, with omega in the world frame; Koutras and Doulgeri 2020 for the second. The
/// logarithm is followed beyond pi: in the first two forms total rotations of up to 2 pi reproduce, about one
/// axis any. In the turning form p stays small whatever the number of turns: docs/formulation.md.) Gains:
/// DmpOptions::orientation_alpha, _beta.
class DMP_EXPORT OrientationDmp {
 public:
  /// As Dmp::fit. Starts and goals of several demonstrations are averaged on SO(3).
  static OrientationDmp fit(const OrientationDemonstration& demonstration, const DmpOptions& options = {});
  static OrientationDmp fit(const std::vector<OrientationDemonstration>& demonstrations,
                            const DmpOptions& options = {});
  /// Throws InvalidArgument unless sizes agree, all numbers are finite and start and goal are rotations.
  explicit OrientationDmp(const OrientationDmpParameters& parameters);

  const OrientationDmpParameters& parameters() const noexcept;
  const DmpOptions& options() const noexcept { return parameters().options; }
  double duration() const noexcept { return parameters().duration; }  ///< s
  const Eigen::Matrix3d& start() const noexcept { return parameters().start; }
  const Eigen::Matrix3d& goal() const noexcept { return parameters().goal; }
  const ForcingTerm& forcing() const noexcept;

  /// As Dmp::rollout; goal is a rotation.
  OrientationTrajectory rollout(const std::optional<Eigen::Matrix3d>& goal = {},
                                std::optional<double> duration = {}, double dt = 1e-3) const;
  OrientationTrajectory rollout_at(const Eigen::VectorXd& times,
                                   const std::optional<Eigen::Matrix3d>& goal = {},
                                   std::optional<double> duration = {}) const;

 private:
  friend struct detail::BatchFit;
  /// From `count` demonstrations; `memory` keeps what later fits may share.
  static OrientationDmp fit_together(const OrientationDemonstration* demonstrations, std::size_t count,
                                     const DmpOptions& options, std::unique_ptr<detail::ForcingFit>& memory);
  friend class OrientationRun;
  OrientationTrajectory roll_out(const detail::Timetable& timetable,
                                 const std::optional<Eigen::Matrix3d>& goal,
                                 std::optional<double> duration) const;

  struct Data;
  std::shared_ptr<const Data> data_;
};

/// One run of an OrientationDmp; see Run.
class DMP_EXPORT OrientationRun {
 public:
  explicit OrientationRun(const OrientationDmp& dmp);
  OrientationRun(const OrientationRun& other);
  OrientationRun(OrientationRun&& other) noexcept;
  OrientationRun& operator=(const OrientationRun& other);
  OrientationRun& operator=(OrientationRun&& other) noexcept;
  ~OrientationRun();

  Status step(double dt) noexcept DMP_REALTIME;
  /// Refused (invalid_input) unless so3::is_rotation; the nearest rotation is taken.
  Status set_goal(const Eigen::Matrix3d& goal) noexcept DMP_REALTIME;
  Status set_duration(double duration) noexcept DMP_REALTIME;
  /// How far the robot lags behind (0 or more): slows the phase by 1 + DmpOptions::phase_stop times it.
  Status set_tracking_error(double error) noexcept DMP_REALTIME;
  /// Comes to rest on the path, and goes on from there; both through DmpOptions::tempo_filter.
  void pause() noexcept DMP_REALTIME;
  void resume() noexcept DMP_REALTIME;
  bool paused() const noexcept DMP_REALTIME;
  /// angular_velocity: rad/s, world frame.
  Status start_from(const Eigen::Matrix3d& rotation,
                    const Eigen::Vector3d& angular_velocity) noexcept DMP_REALTIME;
  void reset() noexcept DMP_REALTIME;

  Eigen::Matrix3d rotation() const noexcept DMP_REALTIME;                     ///< body -> world
  const Eigen::Quaterniond& quaternion() const noexcept DMP_REALTIME;         ///< unit, continuous in sign
  const Eigen::Vector3d& angular_velocity() const noexcept DMP_REALTIME;      ///< rad/s, world frame
  const Eigen::Vector3d& angular_acceleration() const noexcept DMP_REALTIME;  ///< rad/s^2, world frame
  Eigen::Matrix3d goal() const noexcept DMP_REALTIME;                         ///< the one set last
  double time() const noexcept DMP_REALTIME;
  double phase() const noexcept DMP_REALTIME;
  double duration() const noexcept DMP_REALTIME;
  Status status() const noexcept DMP_REALTIME;

 private:
  friend class OrientationDmp;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dmp
