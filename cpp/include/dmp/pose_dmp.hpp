#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/dmp.hpp>
#include <dmp/export.hpp>
#include <dmp/orientation_dmp.hpp>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

namespace dmp {

/// All that a PoseDmp is: what a model file holds.
struct PoseDmpParameters {
  DmpOptions options;
  double duration = 1.0;                                ///< s
  Eigen::Matrix4d start = Eigen::Matrix4d::Identity();  ///< [R0 p0; 0 1]
  Eigen::Matrix4d goal = Eigen::Matrix4d::Identity();
  Eigen::Matrix<double, 6, 1> start_twist =
      Eigen::Matrix<double, 6, 1>::Zero();                ///< m/s, then rad/s, world frame
  Eigen::Vector3d start_error = Eigen::Vector3d::Zero();  ///< Log(Rg R0^T) on its branch, rad
  Eigen::Matrix<double, 6, 1> amplitude =
      Eigen::Matrix<double, 6, 1>::Zero();  ///< ranges of p [m] and Log(Rg R^T) [rad]
  RowMatrix weights;                        ///< (N x 6): three of the position, three of the orientation
  /// (M + 1 x 4) w x y z, of OrientationForm::turning: coefficients of the quintic B-spline on M equal spans
  /// of the phase that turns along, the first and the last three times. Empty in the other forms.
  RowMatrix reference;
};

/// A dynamic movement primitive for poses [R p; 0 1]: a Dmp for p and an OrientationDmp for R with one phase,
/// one set of kernels and one duration, advanced in the same steps. p does not depend on R. Immutable.
class DMP_EXPORT PoseDmp {
 public:
  static PoseDmp fit(const PoseDemonstration& demonstration, const DmpOptions& options = {});
  static PoseDmp fit(const std::vector<PoseDemonstration>& demonstrations, const DmpOptions& options = {});
  explicit PoseDmp(const PoseDmpParameters& parameters);

  const PoseDmpParameters& parameters() const noexcept;
  const DmpOptions& options() const noexcept { return parameters().options; }
  double duration() const noexcept { return parameters().duration; }  ///< s
  const Eigen::Matrix4d& start() const noexcept { return parameters().start; }
  const Eigen::Matrix4d& goal() const noexcept { return parameters().goal; }
  const ForcingTerm& forcing() const noexcept;

  /// As Dmp::rollout; goal is a pose.
  PoseTrajectory rollout(const std::optional<Eigen::Matrix4d>& goal = {}, std::optional<double> duration = {},
                         double dt = 1e-3) const;
  PoseTrajectory rollout_at(const Eigen::VectorXd& times, const std::optional<Eigen::Matrix4d>& goal = {},
                            std::optional<double> duration = {}) const;

 private:
  friend struct detail::BatchFit;
  /// From `count` demonstrations; `memory` keeps what later fits may share.
  static PoseDmp fit_together(const PoseDemonstration* demonstrations, std::size_t count,
                              const DmpOptions& options, std::unique_ptr<detail::ForcingFit>& memory);
  friend class PoseRun;
  PoseTrajectory roll_out(const detail::Timetable& timetable, const std::optional<Eigen::Matrix4d>& goal,
                          std::optional<double> duration) const;

  struct Data;
  std::shared_ptr<const Data> data_;
};

/// One run of a PoseDmp; see Run.
class DMP_EXPORT PoseRun {
 public:
  explicit PoseRun(const PoseDmp& dmp);
  PoseRun(const PoseRun& other);
  PoseRun(PoseRun&& other) noexcept;
  PoseRun& operator=(const PoseRun& other);
  PoseRun& operator=(PoseRun&& other) noexcept;
  ~PoseRun();

  Status step(double dt) noexcept DMP_REALTIME;
  /// Refused (invalid_input) unless finite, with a rotation (so3::is_rotation; the nearest is taken)
  /// and the last row 0 0 0 1.
  Status set_goal(const Eigen::Matrix4d& goal) noexcept DMP_REALTIME;
  Status set_duration(double duration) noexcept DMP_REALTIME;
  /// How far the robot lags behind (0 or more): slows the phase by 1 + DmpOptions::phase_stop times it.
  Status set_tracking_error(double error) noexcept DMP_REALTIME;
  /// Comes to rest on the path, and goes on from there; both through DmpOptions::tempo_filter.
  void pause() noexcept DMP_REALTIME;
  void resume() noexcept DMP_REALTIME;
  bool paused() const noexcept DMP_REALTIME;
  /// twist: linear velocity of the origin [m/s], angular velocity [rad/s], world frame.
  Status start_from(const Eigen::Matrix4d& pose,
                    const Eigen::Matrix<double, 6, 1>& twist) noexcept DMP_REALTIME;
  void reset() noexcept DMP_REALTIME;

  Eigen::Matrix4d pose() const noexcept DMP_REALTIME;      ///< [R p; 0 1]
  Eigen::Vector3d position() const noexcept DMP_REALTIME;  ///< m
  Eigen::Matrix3d rotation() const noexcept DMP_REALTIME;
  const Eigen::Quaterniond& quaternion() const noexcept DMP_REALTIME;
  Eigen::Matrix<double, 6, 1> twist() const noexcept DMP_REALTIME;         ///< m/s, rad/s, world frame
  Eigen::Matrix<double, 6, 1> acceleration() const noexcept DMP_REALTIME;  ///< m/s^2, rad/s^2, world frame
  Eigen::Matrix4d goal() const noexcept DMP_REALTIME;
  double time() const noexcept DMP_REALTIME;
  double phase() const noexcept DMP_REALTIME;
  double duration() const noexcept DMP_REALTIME;
  Status status() const noexcept DMP_REALTIME;

 private:
  friend class PoseDmp;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dmp
