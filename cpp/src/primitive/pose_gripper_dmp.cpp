#include <dmp/pose_gripper_dmp.hpp>

#include "primitive/instantiate.hpp"

namespace dmp {

DMP_INSTANTIATE(PoseGripperSpace);

}  // namespace dmp
