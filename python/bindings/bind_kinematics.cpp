#include "bind.hpp"
namespace dmp::python {
void bind_kinematics(pybind11::module_&) {}
}  // namespace dmp::python
