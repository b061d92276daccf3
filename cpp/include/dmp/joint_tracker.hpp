#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>
#include <dmp/ik_status.hpp>
#include <dmp/realtime.hpp>

#include <Eigen/Core>
#include <memory>

namespace dmp {

/// Documented defaults; JointTracker throws InvalidArgument for values out of range.
struct TrackOptions {
  double position_tolerance = 1e-6;  ///< m, > 0: when a pose counts as met
  double angle_tolerance = 1e-6;     ///< rad, > 0
  double angle_weight =
      0.1;  ///< m per rad, > 0: "closest" weighs the angle error so against the position error
  /// Which directions of the pose are constrained, in its own axes: see IkOptions::weight.
  Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Ones();
  /// rad per m that the tip moves, >= 0: null-space gain away from joint limits.
  double limit_pull = 1.0;
};

/// The differential inverse kinematics of a control loop: joints that go along with a pose that moves.
///
/// Each track() begins at the joints of the one before and moves every joint by at most velocity limit x dt,
/// within the joint limits, as close to the pose as that allows. Nothing is searched: where another posture
/// would be needed, the pose is missed and the status says why. One per loop or thread: it takes its memory
/// in the constructor. The same calls give the same joints to the last bit.
class DMP_EXPORT JointTracker {
 public:
  /// `start` (n): where the robot stands. A joint up to 1e-3 rad or m beyond a limit comes back onto it
  /// within its velocity limit: see limit_excess(). Throws InvalidArgument if it is not n finite values
  /// within that, for an option out of range, or for an arm of more than 16 free joints.
  JointTracker(Arm arm, const Eigen::VectorXd& start, const TrackOptions& options = {});
  JointTracker(const JointTracker& other);
  JointTracker(JointTracker&&) noexcept;
  JointTracker& operator=(JointTracker other) noexcept;
  ~JointTracker();

  /// One step of `dt` seconds (> 0) towards `pose`, tip in base, [R p; 0 1] with R in SO(3) to 1e-3.
  /// invalid_input if the arguments are none: then nothing changes.
  IkStatus track(const Eigen::Matrix4d& pose, double dt) noexcept DMP_REALTIME;
  /// Where the robot stands after all, e.g. as measured; velocity becomes 0. invalid_input, and no change,
  /// unless q is n finite values within the limits, or up to 1e-3 rad or m beyond, as for the constructor.
  IkStatus set_joints(const Eigen::VectorXd& q) noexcept DMP_REALTIME;

  /// (n) rad or m, within the limits or on the way back onto them.
  const Eigen::VectorXd& joints() const noexcept DMP_REALTIME;
  const Eigen::VectorXd& velocity() const noexcept DMP_REALTIME;  ///< (n) rad/s or m/s, of the last step
  double position_error() const noexcept DMP_REALTIME;            ///< m, of the last step, by KDL
  double angle_error() const noexcept DMP_REALTIME;               ///< rad, of the last step, by KDL
  /// rad or m: how far the joints that were given last lay beyond a limit; 0 within.
  double limit_excess() const noexcept DMP_REALTIME;

  const Arm& arm() const;
  const TrackOptions& options() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dmp
