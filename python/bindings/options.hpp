#pragma once

#include <pybind11/pybind11.h>
#include <dmp/options.hpp>

#include <optional>

namespace dmp::python {

namespace py = pybind11;

/// `options` (the defaults if None) with some of its fields replaced. Throws InvalidArgument for an unknown
/// one.
DmpOptions options_with(const std::optional<DmpOptions>& options, const py::kwargs& fields);

}  // namespace dmp::python
