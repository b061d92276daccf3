#include "bind.hpp"
#include "bind_space.hpp"

namespace dmp::python {

void bind_rotation_space(py::module_& m) { bind_space<RotationSpace, OrientationRun>(m); }

}  // namespace dmp::python
