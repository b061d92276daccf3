#pragma once
// What calls of the loop say in Python.

#include <pybind11/pybind11.h>
#include <dmp/error.hpp>
#include <dmp/status.hpp>

#include <string>

namespace dmp::python {

namespace py = pybind11;

/// What a refused call of the loop says in Python.
inline void require_accepted(Status status, const std::string& message) {
  if (status == Status::invalid_input) throw InvalidArgument(message);
}

/// True while the motion runs, False when it has finished.
inline bool is_running(Status status, double dt) {
  switch (status) {
    case Status::running:
      return true;
    case Status::finished:
      return false;
    case Status::invalid_input:
      throw InvalidArgument("dt: " + std::to_string(dt) + ", expected a time in s from 0 to 10 durations.");
    default:
      PyErr_SetString(PyExc_FloatingPointError,
                      "step: the state is no longer finite; the last finite output is kept. Call reset().");
      throw py::error_already_set();
  }
}

}  // namespace dmp::python
