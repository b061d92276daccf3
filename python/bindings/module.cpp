#include <dmp/error.hpp>

#include "bind.hpp"

PYBIND11_MODULE(_core, m) {
  namespace py = pybind11;
  m.doc() =
      "Dynamic movement primitives and inverse kinematics: the C++ libraries dmp::core and dmp::kinematics.";
  m.attr("__version__") = DMP_VERSION;
  py::register_exception<dmp::InvalidArgument>(m, "InvalidArgument", PyExc_ValueError);
  py::register_exception<dmp::FileError>(m, "FileError", PyExc_OSError);
  dmp::python::bind_so3(m);
  dmp::python::bind_demonstration(m);
  dmp::python::bind_options(m);
  dmp::python::bind_dmp(m);
  dmp::python::bind_orientation_dmp(m);
  dmp::python::bind_pose_dmp(m);
  dmp::python::bind_batch(m);
  dmp::python::bind_align(m);
  dmp::python::bind_learning(m);
  dmp::python::bind_file(m);
  dmp::python::bind_kinematics(m);
  dmp::python::bind_joint_tracker(m);
  dmp::python::bind_timing(m);
}
