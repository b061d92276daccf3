// Any bytes as a URDF: an InvalidArgument, or an arm whose forward kinematics at any joints is a pose.
#include <dmp/arm.hpp>
#include <dmp/error.hpp>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

void check(const dmp::Arm& arm) {
  if (arm.joint_count() == 0) return;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(arm.joint_count());
  const Eigen::Matrix4d pose = arm.forward_kinematics(zero);
  const Eigen::Matrix3d rotation = pose.topLeftCorner<3, 3>();
  if (!pose.allFinite() || !rotation.isUnitary(1e-6)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    check(dmp::Arm::from_urdf(std::string(reinterpret_cast<const char*>(data), size)));
  } catch (const dmp::InvalidArgument&) {
  }
  return 0;
}
