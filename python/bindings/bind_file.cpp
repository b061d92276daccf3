#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <dmp/file.hpp>

#include "bind.hpp"

namespace dmp::python {

namespace py = pybind11;

namespace {

py::object to_object(const Model& model) {
  return std::visit([](const auto& kind) { return py::cast(kind); }, model);
}

template <class Kind>
void def_writers(py::module_& m) {
  m.def(
      "save", [](const Kind& model, const std::filesystem::path& path) { save(model, path.string()); },
      py::arg("model"), py::arg("path"),
      "Writes a model file (JSON), whole or not at all. Raises FileError.");
  m.def(
      "to_json", [](const Kind& model) { return to_json(model); }, py::arg("model"),
      "The text of a model file.");
}

}  // namespace

void bind_file(py::module_& m) {
  def_writers<Dmp>(m);
  def_writers<OrientationDmp>(m);
  def_writers<PoseDmp>(m);
  m.def(
      "load", [](const std::filesystem::path& path) { return to_object(load(path.string())); },
      py::arg("path"),
      "The Dmp, OrientationDmp or PoseDmp in a file, bit for bit as it was saved. Raises FileError, or "
      "InvalidArgument "
      "naming the place.");
  m.def(
      "from_json", [](const std::string& text) { return to_object(from_json(text)); }, py::arg("text"),
      "The model in the text of a model file. Raises InvalidArgument naming the place.");
}

}  // namespace dmp::python
