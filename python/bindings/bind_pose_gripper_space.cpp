#include "bind.hpp"
#include "bind_space.hpp"

namespace dmp::python {

void bind_pose_gripper_space(py::module_& m) { bind_space<PoseGripperSpace, PoseGripperRun>(m); }

}  // namespace dmp::python
