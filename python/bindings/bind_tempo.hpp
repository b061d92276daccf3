#pragma once
// Binders of what a motion's tempo is made of: the pace of joints, and their fit to an arm.

#include <pybind11/pybind11.h>

namespace dmp::python {

void bind_pacing(pybind11::module_& m);
void bind_path_fit(pybind11::module_& m);

}  // namespace dmp::python
