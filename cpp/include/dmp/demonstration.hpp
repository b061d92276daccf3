#pragma once

#include <dmp/export.hpp>
#include <dmp/noise.hpp>
#include <dmp/spline.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

namespace dmp {

namespace detail {
class LazyGrid;
/// What denoising found in the samples of a demonstration, found once for it and its copies.
template <class Demonstrated>
struct Cleaned;
}  // namespace detail

/// Positions over time as they were recorded, in any number of dimensions, with the derivatives of the
/// interpolating quintic spline. Times count from the first sample.
class DMP_EXPORT Demonstration {
 public:
  /// times (T) s, strictly increasing, uniform or not; positions (T x dims), T >= 2.
  /// Throws InvalidArgument, naming the sample, for wrong sizes, numbers that are not finite, time that
  /// stands still or runs backwards.
  Demonstration(const Eigen::VectorXd& times, const RowMatrix& positions);

  Eigen::Index size() const noexcept { return time_.size(); }
  Eigen::Index dimension() const noexcept { return position_.cols(); }
  double duration() const noexcept { return time_[size() - 1]; }  ///< s
  const Eigen::VectorXd& time() const noexcept { return time_; }  ///< (T) s, from 0
  const RowMatrix& position() const noexcept { return position_; }

  /// Other positions (T x dims) at the same times: what the spline needs of the times alone is shared.
  Demonstration with(const RowMatrix& positions) const;

  /// Position, velocity and acceleration on the spline at times (n) in s from the start. Throws
  /// InvalidArgument for a time that is not finite.
  Trajectory at(const Eigen::VectorXd& times) const;

  /// The same motion on the smoothing spline (Spline::smoothing): the noise is found in the data and taken
  /// out.
  Demonstration smoothed(Smoothing* report = nullptr) const;

  /// The same motion without its noise, where the samples show that they carry any, otherwise as it is; see
  /// NoiseEstimate. The report says what was found.
  Demonstration denoised(NoiseEstimate* report = nullptr) const;
  /// The same motion, of whose samples some were filled in: measured (T), 0 for those, 1 for the others. They
  /// show the way, but no noise. Throws InvalidArgument for another number.
  Demonstration with_measured(const Eigen::VectorXd& measured) const;

 private:
  friend class PoseDemonstration;
  Demonstration denoised(detail::LazyGrid& grid, NoiseEstimate* report) const;
  Demonstration(Eigen::VectorXd time, RowMatrix position, Spline spline);
  Eigen::VectorXd time_;
  RowMatrix position_;
  Spline spline_;
  Eigen::VectorXd measured_;  // empty: all
  std::shared_ptr<detail::Cleaned<Demonstration>> cleaned_;
};

/// Orientations over time, with the angular velocities and accelerations (world frame) of the quintic spline
/// through the sign-continuous quaternions. Total rotations beyond 2 pi are fine.
class DMP_EXPORT OrientationDemonstration {
 public:
  /// times (T) s as above; rotations (T) body -> world. Throws InvalidArgument, naming the sample, for a
  /// matrix that is no rotation (a reflection, not orthogonal to 1e-3) and for two samples more than pi/2
  /// apart, between which the way is not known.
  OrientationDemonstration(const Eigen::VectorXd& times, const Rotations& rotations);
  /// angles (T x 3) rad; `convention` as in so3::from_euler.
  static OrientationDemonstration from_euler(const Eigen::VectorXd& times, const RowMatrix& angles,
                                             const std::string& convention);
  /// quaternions (T x 4) body -> world, of length 1 to 1e-2, in the order "wxyz" or "xyzw"; q and -q are one
  /// rotation. Throws InvalidArgument also for another order or length.
  static OrientationDemonstration from_quaternions(const Eigen::VectorXd& times, const RowMatrix& quaternions,
                                                   const std::string& order);

  Eigen::Index size() const noexcept { return time_.size(); }
  double duration() const noexcept { return time_[size() - 1]; }  ///< s
  const Eigen::VectorXd& time() const noexcept { return time_; }  ///< (T) s, from 0
  const Rotations& rotation() const noexcept { return rotation_; }

  /// Other rotations (T) at the same times, as Demonstration::with.
  OrientationDemonstration with(const Rotations& rotations) const;

  /// Rotation, angular velocity and acceleration on the spline at times (n) in s from the start. Throws
  /// InvalidArgument for a time that is not finite.
  OrientationTrajectory at(const Eigen::VectorXd& times) const;

  /// The same motion with its quaternions on the smoothing spline, renormalised. The report has one number
  /// each, in rad about every axis.
  OrientationDemonstration smoothed(Smoothing* report = nullptr) const;
  /// As Demonstration::denoised, in rad.
  OrientationDemonstration denoised(NoiseEstimate* report = nullptr) const;
  OrientationDemonstration with_measured(const Eigen::VectorXd& measured) const;

 private:
  friend class PoseDemonstration;
  OrientationDemonstration denoised(detail::LazyGrid& grid, NoiseEstimate* report) const;
  OrientationDemonstration(Eigen::VectorXd time, Rotations rotation, Spline spline);
  /// At the times of `grid`, whose spline goes through samples; `what` names the rotations where one is bad.
  static OrientationDemonstration on(const Eigen::VectorXd& time, const Spline& grid,
                                     const Rotations& rotations, const char* what);
  Eigen::VectorXd time_;
  Rotations rotation_;
  Spline spline_;
  Eigen::VectorXd measured_;
  std::shared_ptr<detail::Cleaned<OrientationDemonstration>> cleaned_;
};

/// Positions and orientations of one body, at the same times.
class DMP_EXPORT PoseDemonstration {
 public:
  /// times (T) s; poses (T) [R p; 0 1], body -> world, p in m. Throws InvalidArgument as the two above.
  PoseDemonstration(const Eigen::VectorXd& times, const Poses& poses);
  /// positions (T x 3) m; quaternions (T x 4) as in OrientationDemonstration::from_quaternions.
  static PoseDemonstration from_quaternions(const Eigen::VectorXd& times, const RowMatrix& positions,
                                            const RowMatrix& quaternions, const std::string& order);

  Eigen::Index size() const noexcept { return position_.size(); }
  double duration() const noexcept { return position_.duration(); }          ///< s
  const Eigen::VectorXd& time() const noexcept { return position_.time(); }  ///< (T) s, from 0
  Poses pose() const;                                                        ///< (T)
  const Demonstration& position() const noexcept { return position_; }
  const OrientationDemonstration& orientation() const noexcept { return orientation_; }
  /// Other poses (T) at the same times, as Demonstration::with.
  PoseDemonstration with(const Poses& poses) const;
  /// Both parts smoothed.
  PoseDemonstration smoothed(Smoothing* position = nullptr, Smoothing* orientation = nullptr) const;
  /// Each part without its noise, where it has any; see Demonstration::denoised.
  PoseDemonstration denoised(NoiseEstimate* position = nullptr, NoiseEstimate* orientation = nullptr) const;
  PoseDemonstration with_measured(const Eigen::VectorXd& measured) const;

 private:
  PoseDemonstration(Demonstration position, OrientationDemonstration orientation);
  Demonstration position_;
  OrientationDemonstration orientation_;
  std::shared_ptr<detail::Cleaned<PoseDemonstration>> cleaned_;
};

/// [R p; 0 1]
DMP_EXPORT Eigen::Matrix4d pose_of(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& position) noexcept;

}  // namespace dmp
