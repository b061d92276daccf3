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

}  // namespace

void bind_file(py::module_& m) {
  m.def(
      "load", [](const std::filesystem::path& path) { return to_object(load(path.string())); },
      py::arg("path"),
      "The model in a file (a Dmp, OrientationDmp, PoseDmp or PoseGripperDmp), bit for bit as it was saved. "
      "Raises FileError, or InvalidArgument naming the place.");
  m.def(
      "from_json", [](const std::string& text) { return to_object(from_json(text)); }, py::arg("text"),
      "The model in the text of a model file. Raises InvalidArgument naming the place.");
}

}  // namespace dmp::python
