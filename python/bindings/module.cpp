#include <dmp/error.hpp>

#include "bind.hpp"
#include "bind_tempo.hpp"

namespace {

/// Bytes of a message that are no UTF-8 (of a path, say) are written as \xff: without them it would be no
/// text.
void raise(const pybind11::object& type, const std::exception& error) {
  const std::string text = error.what();
  const auto message = pybind11::reinterpret_steal<pybind11::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<pybind11::ssize_t>(text.size()), "backslashreplace"));
  PyErr_SetObject(type.ptr(), message.ptr());
}

template <class Error>
void register_error(pybind11::module_& m, const char* name, PyObject* base) {
  static pybind11::object type;  // never destroyed: the interpreter goes first
  type = pybind11::exception<Error>(m, name, base);
  type.inc_ref();
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(type, error);
    }
  });
}

/// error.argument: as it was set, else what the message names first.
void add_argument(const pybind11::object& type) {
  namespace py = pybind11;
  const py::object get = py::cpp_function([](const py::object& error) -> py::object {
    if (py::hasattr(error, "_argument")) return error.attr("_argument");
    return py::str(dmp::InvalidArgument::argument_of(py::str(error).cast<std::string>()));
  });
  const py::object set = py::cpp_function([](const py::object& error, const std::string& argument) {
    py::setattr(error, "_argument", py::str(argument));
  });
  const py::object property = py::module_::import("builtins").attr("property");
  py::setattr(type, "argument",
              property(get, set, py::none(),
                       "Name of the argument that cannot be used; empty where it is no one of them."));
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  namespace py = pybind11;
  m.doc() =
      "Dynamic movement primitives and inverse kinematics: the C++ libraries dmp::core and dmp::kinematics.";
  m.attr("__version__") = DMP_VERSION;
  register_error<dmp::InvalidArgument>(m, "InvalidArgument", PyExc_ValueError);
  add_argument(m.attr("InvalidArgument"));
  register_error<dmp::FileError>(m, "FileError", PyExc_OSError);
  dmp::python::bind_so3(m);
  dmp::python::bind_demonstration(m);
  dmp::python::bind_options(m);
  dmp::python::bind_learning(m);
  dmp::python::bind_cycle(m);
  dmp::python::bind_via(m);
  dmp::python::bind_safety(m);
  dmp::python::bind_given(m);
  dmp::python::bind_vector_space(m);
  dmp::python::bind_rotation_space(m);
  dmp::python::bind_pose_space(m);
  dmp::python::bind_pose_gripper_space(m);
  dmp::python::bind_dtw(m);
  dmp::python::bind_file(m);
  dmp::python::bind_kinematics(m);
  dmp::python::bind_joint_tracker(m);
  dmp::python::bind_timing(m);
  dmp::python::bind_pacing(m);
  dmp::python::bind_path_fit(m);
}
