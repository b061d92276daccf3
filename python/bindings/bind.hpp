#pragma once
// One function per file: each adds one concept's classes and functions to the module.

#include <pybind11/pybind11.h>

namespace dmp::python {

void bind_so3(pybind11::module_& m);
void bind_options(pybind11::module_& m);
void bind_demonstration(pybind11::module_& m);
void bind_vector_space(pybind11::module_& m);
void bind_rotation_space(pybind11::module_& m);
void bind_pose_space(pybind11::module_& m);
void bind_pose_gripper_space(pybind11::module_& m);
void bind_dtw(pybind11::module_& m);
void bind_learning(pybind11::module_& m);
void bind_file(pybind11::module_& m);
void bind_kinematics(pybind11::module_& m);
void bind_joint_tracker(pybind11::module_& m);
void bind_cycle(pybind11::module_& m);
void bind_via(pybind11::module_& m);
void bind_safety(pybind11::module_& m);
void bind_given(pybind11::module_& m);
void bind_timing(pybind11::module_& m);

}  // namespace dmp::python
