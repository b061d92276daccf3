#pragma once

#include <dmp/pose_dmp.hpp>
#include <dmp/product.hpp>

#include <Eigen/Core>

namespace dmp {

/// A pose and what the gripper does meanwhile: its opening, or the joints of a hand (one column each).
using PoseGripperSpace = Product<PoseSpace, VectorSpace>;
using PoseGripperDemonstration = PoseGripperSpace::Demonstration;
using PoseGripperTrajectory = PoseGripperSpace::Trajectory;
using PoseGripperDmpParameters = PoseGripperSpace::Parameters;

/// A dynamic movement primitive for the pose of a tool and its gripper, in one phase.
using PoseGripperDmp = Primitive<PoseGripperSpace>;
extern template class Primitive<PoseGripperSpace>;
extern template class Stepper<PoseGripperSpace>;

/// One run of a PoseGripperDmp, for one control loop; see Stepper.
class DMP_EXPORT PoseGripperRun : public Stepper<PoseGripperSpace> {
 public:
  using Stepper::Stepper;
  Eigen::Matrix4d pose() const noexcept DMP_REALTIME { return detail::pose_in(output().first); }
  /// m/s, rad/s, world frame
  PoseSpace::Tangent twist() const noexcept DMP_REALTIME { return detail::twist_in(output().first); }
  /// m/s^2, rad/s^2, world frame
  PoseSpace::Tangent acceleration() const noexcept DMP_REALTIME {
    return detail::twist_rate_in(output().first);
  }
  const Eigen::VectorXd& gripper() const noexcept DMP_REALTIME { return output().second.position; }
  const Eigen::VectorXd& gripper_velocity() const noexcept DMP_REALTIME { return output().second.velocity; }
};

}  // namespace dmp
