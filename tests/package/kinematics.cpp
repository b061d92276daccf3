// A controller that links dmp::kinematics: reads a URDF and finds joints for a pose.
#include <dmp/error.hpp>
#include <dmp/inverse_kinematics.hpp>

#include <string>

namespace {

const std::string kArm = R"(<robot name="arm"><link name="a"/><link name="b"/><link name="c"/>
  <joint name="turn" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" velocity="1" effort="1"/></joint></robot>)";

}  // namespace

int main() {
  const dmp::Arm arm = dmp::Arm::from_urdf(kArm);
  const Eigen::VectorXd joints = Eigen::Vector2d(0.5, 0.7);
  const dmp::IkResult found = dmp::InverseKinematics(arm).solve(arm.forward_kinematics(joints));
  try {
    dmp::Arm::from_urdf("<robot/>");
    return 1;
  } catch (const dmp::InvalidArgument&) {
  }
  return found.ok() && (found.joints - joints).norm() < 1e-5 ? 0 : 1;
}
