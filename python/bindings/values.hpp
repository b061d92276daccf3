#pragma once
// What Python expects of a value: to be printed, compared and pickled.

#include <pybind11/pybind11.h>

#include <cstdio>
#include <string>
#include <vector>

#include "options.hpp"

namespace dmp::python {

/// The attributes of `value` that can be set, arrays as lists: those that its class of C++ has, also where a
/// class of Python adds to that.
template <class Options>
py::dict fields_of(const py::object& value) {
  py::dict fields;
  for (const py::handle name : py::type::of<Options>().attr("__dict__")) {
    if (!is_field<Options>(name)) continue;
    const py::object field = value.attr(name);
    fields[name] = py::hasattr(field, "tolist") ? py::object(field.attr("tolist")()) : field;
  }
  return fields;
}

/// Name(field=.., ..) with the fields that are not as by default.
template <class Options>
std::string shown_fields(const py::object& value) {
  const py::object enumerator = py::module_::import("enum").attr("Enum");
  const py::dict usual = fields_of<Options>(py::cast(Options{}));
  std::string text;
  for (const auto& [name, field] : fields_of<Options>(value)) {
    if (field.equal(usual[name])) continue;
    const py::str written = py::isinstance(field, enumerator) ? py::str(field) : py::repr(field);
    text +=
        (text.empty() ? "" : ", ") + py::str(name).cast<std::string>() + "=" + written.cast<std::string>();
  }
  return py::type::of(value).attr("__name__").cast<std::string>() + "(" + text + ")";
}

/// repr, ==, copy and pickle of a class whose attributes are all that it is.
template <class Options>
void def_fields(py::class_<Options>& options) {
  options.def("__repr__", &shown_fields<Options>)
      .def("__eq__",
           [](const py::object& a, const py::object& b) {
             return py::type::of(a).is(py::type::of(b)) && fields_of<Options>(a).equal(fields_of<Options>(b));
           })
      .def("__copy__", [](const Options& o) { return o; })
      .def(
          "__deepcopy__", [](const Options& o, const py::dict&) { return o; }, py::arg("memo"))
      .def(py::pickle([](const py::object& o) { return fields_of<Options>(o); },
                      [](const py::dict& fields) {
                        const py::object value = py::cast(Options{});
                        for (const auto& [name, field] : fields) py::setattr(value, name, field);
                        return value.cast<Options>();
                      }));
}

/// Text that may be in another encoding than UTF-8, whose bytes Python then keeps as it does those of file
/// names.
inline py::str readable(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
}
inline py::list readable(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(readable(text));
  return list;
}

/// A number as Python's "%.6g" prints it.
inline std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// <Name: 101 samples, 0 to 2 s, what>
template <class Time>
std::string shown_samples(const std::string& name, const Time& time, const std::string& what = "") {
  std::string text = "<" + name + ": " + std::to_string(time.size()) + " samples";
  if (time.size() > 0)
    text += ", " + short_number(time[0]) + " to " + short_number(time[time.size() - 1]) + " s";
  return text + (what.empty() ? "" : ", " + what) + ">";
}

}  // namespace dmp::python
