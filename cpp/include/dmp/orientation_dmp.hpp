#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/primitive.hpp>
#include <dmp/stepper.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <tuple>

namespace dmp {

/// All that an OrientationDmp is: what a model file holds.
struct DMP_EXPORT OrientationDmpParameters {
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
  /// (N x 1) of Scaling::advance: weights of the forcing term that takes an offset from 0 to 1 as the
  /// demonstration advances. Empty in the other scalings.
  RowMatrix advance;

  /// Every field beside the options and those that may be empty, by its name in a model file.
  static constexpr auto fields() {
    using P = OrientationDmpParameters;
    return std::make_tuple(std::pair("duration", &P::duration), std::pair("start", &P::start),
                           std::pair("goal", &P::goal), std::pair("start_velocity", &P::start_velocity),
                           std::pair("start_error", &P::start_error), std::pair("amplitude", &P::amplitude),
                           std::pair("weights", &P::weights));
  }
  /// Fields that may be empty, which a model file leaves out then.
  static constexpr auto optional_fields() {
    return std::make_tuple(std::pair("reference", &OrientationDmpParameters::reference),
                           std::pair("advance", &OrientationDmpParameters::advance));
  }
};

/// SO(3): rotations body -> world; tangents are rotation vectors in the world frame.
struct DMP_EXPORT RotationSpace {
  using Point = Eigen::Matrix3d;
  using PointArgument = const Eigen::Matrix3d&;
  using PointView = Eigen::Matrix3d;
  using Tangent = Eigen::Vector3d;
  using TangentArgument = const Eigen::Vector3d&;
  using Path = Rotations;  ///< (T)
  using Demonstration = OrientationDemonstration;
  using Trajectory = OrientationTrajectory;
  using Parameters = OrientationDmpParameters;
  /// Of a run, as it stands: whoever keeps a reference reads the newest.
  struct Outputs {
    Eigen::Quaterniond quaternion;         ///< unit, continuous in sign
    Eigen::Vector3d angular_velocity;      ///< rad/s, world frame
    Eigen::Vector3d angular_acceleration;  ///< rad/s^2, world frame
  };
  using Output = const Outputs&;
};

/// A dynamic movement primitive for orientations on SO(3).
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
using OrientationDmp = Primitive<RotationSpace>;
template <>
struct SpaceOf<OrientationDemonstration> {
  using type = RotationSpace;
};
template <>
struct SpaceOf<Rotations> {
  using type = RotationSpace;
};
extern template class Primitive<RotationSpace>;
extern template class Stepper<RotationSpace>;

/// One run of an OrientationDmp, for one control loop; see Stepper.
class DMP_EXPORT OrientationRun : public Stepper<RotationSpace> {
 public:
  using Stepper::Stepper;
  /// body -> world
  Eigen::Matrix3d rotation() const noexcept DMP_REALTIME { return output().quaternion.toRotationMatrix(); }
  /// unit, continuous in sign
  const Eigen::Quaterniond& quaternion() const noexcept DMP_REALTIME { return output().quaternion; }
  /// rad/s, world frame
  const Eigen::Vector3d& angular_velocity() const noexcept DMP_REALTIME { return output().angular_velocity; }
  /// rad/s^2, world frame
  const Eigen::Vector3d& angular_acceleration() const noexcept DMP_REALTIME {
    return output().angular_acceleration;
  }
};

}  // namespace dmp
