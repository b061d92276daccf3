#pragma once

#include <dmp/dmp.hpp>
#include <dmp/orientation_dmp.hpp>

#include <Eigen/Core>
#include <tuple>

namespace dmp {

/// All that a PoseDmp is: what a model file holds.
struct DMP_EXPORT PoseDmpParameters {
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
  /// (N x 2) of Scaling::advance: weights of the forcing term that takes the offset of the position and that
  /// of the orientation from 0 to 1 as the demonstration advances. Empty in the other scalings.
  RowMatrix advance;

  /// Every field beside the options and those that may be empty, by its name in a model file.
  static constexpr auto fields() {
    using P = PoseDmpParameters;
    return std::make_tuple(std::pair("duration", &P::duration), std::pair("start", &P::start),
                           std::pair("goal", &P::goal), std::pair("start_twist", &P::start_twist),
                           std::pair("start_error", &P::start_error), std::pair("amplitude", &P::amplitude),
                           std::pair("weights", &P::weights));
  }
  /// Fields that may be empty, which a model file leaves out then.
  static constexpr auto optional_fields() {
    return std::make_tuple(std::pair("reference", &PoseDmpParameters::reference),
                           std::pair("advance", &PoseDmpParameters::advance));
  }
};

/// R^3 x SO(3) as matrices [R p; 0 1]: a VectorSpace of three dimensions for p beside a RotationSpace for R.
struct DMP_EXPORT PoseSpace {
  using Point = Eigen::Matrix4d;
  using PointArgument = const Eigen::Matrix4d&;
  using PointView = Eigen::Matrix4d;
  using Tangent = Eigen::Matrix<double, 6, 1>;  ///< linear velocity of the origin, angular velocity
  using TangentArgument = const Eigen::Matrix<double, 6, 1>&;
  using Path = Poses;  ///< (T)
  using Demonstration = PoseDemonstration;
  using Trajectory = PoseTrajectory;
  using Parameters = PoseDmpParameters;
  struct Output {
    VectorSpace::Output first;     ///< of the position
    RotationSpace::Output second;  ///< of the orientation
  };
};

/// A dynamic movement primitive for poses [R p; 0 1]: a Dmp for p and an OrientationDmp for R with one phase,
/// one set of kernels and one duration, advanced in the same steps. p does not depend on R.
using PoseDmp = Primitive<PoseSpace>;
template <>
struct SpaceOf<PoseDemonstration> {
  using type = PoseSpace;
};
template <>
struct SpaceOf<Poses> {
  using type = PoseSpace;
};
extern template class Primitive<PoseSpace>;
extern template class Stepper<PoseSpace>;

namespace detail {

/// What a run of poses shows, for the runs of all spaces that hold one.
inline Eigen::Matrix4d pose_in(const PoseSpace::Output& output) noexcept {
  return pose_of(output.second.quaternion.toRotationMatrix(), output.first.position);
}
inline PoseSpace::Tangent twist_in(const PoseSpace::Output& output) noexcept {
  PoseSpace::Tangent twist;
  twist << output.first.velocity, output.second.angular_velocity;
  return twist;
}
inline PoseSpace::Tangent twist_rate_in(const PoseSpace::Output& output) noexcept {
  PoseSpace::Tangent rate;
  rate << output.first.acceleration, output.second.angular_acceleration;
  return rate;
}

}  // namespace detail

/// One run of a PoseDmp, for one control loop; see Stepper.
class DMP_EXPORT PoseRun : public Stepper<PoseSpace> {
 public:
  using Stepper::Stepper;
  Eigen::Matrix4d pose() const noexcept DMP_REALTIME { return detail::pose_in(output()); }    ///< [R p; 0 1]
  Eigen::Vector3d position() const noexcept DMP_REALTIME { return output().first.position; }  ///< m
  Eigen::Matrix3d rotation() const noexcept DMP_REALTIME { return quaternion().toRotationMatrix(); }
  /// unit, continuous in sign
  const Eigen::Quaterniond& quaternion() const noexcept DMP_REALTIME { return output().second.quaternion; }
  /// m/s, rad/s, world frame
  Eigen::Matrix<double, 6, 1> twist() const noexcept DMP_REALTIME { return detail::twist_in(output()); }
  /// m/s^2, rad/s^2, world frame
  Eigen::Matrix<double, 6, 1> acceleration() const noexcept DMP_REALTIME {
    return detail::twist_rate_in(output());
  }
};

}  // namespace dmp
