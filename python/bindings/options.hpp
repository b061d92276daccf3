#pragma once

#include <pybind11/pybind11.h>
#include <dmp/options.hpp>

#include <optional>
#include <string>

namespace dmp::python {

namespace py = pybind11;

/// `options` (the defaults if None) with some of its fields replaced. Throws InvalidArgument for an unknown
/// one.
DmpOptions options_with(const std::optional<DmpOptions>& options, const py::kwargs& fields);

/// Whether a class of options has this field.
template <class Options>
bool is_field(const py::handle& name) {
  const py::object property = py::module_::import("builtins").attr("property");
  const py::object member = py::type::of<Options>().attr("__dict__").attr("get")(name);
  return py::isinstance(member, property) && !member.attr("fset").is_none();
}

/// `options` (the defaults if None) with the keywords written over its fields.
template <class Options>
Options with_fields(const std::optional<Options>& options, const py::kwargs& fields) {
  py::object object = py::cast(options.value_or(Options{}));
  for (const auto& [name, value] : fields) {
    if (!is_field<Options>(name))
      throw py::type_error("unknown option '" + py::str(name).cast<std::string>() + "'.");
    py::setattr(object, name, py::reinterpret_borrow<py::object>(value));
  }
  return object.cast<Options>();
}

/// What a class of options is made from in Python: its fields as keywords.
template <class Options>
Options with_keywords(const py::kwargs& fields) {
  return with_fields<Options>(std::nullopt, fields);
}

}  // namespace dmp::python
