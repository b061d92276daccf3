#include "bind.hpp"
#include "bind_space.hpp"

namespace dmp::python {

void bind_pose_space(py::module_& m) { bind_space<PoseSpace, PoseRun>(m); }

}  // namespace dmp::python
