#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/dtw.hpp>

#include "arrays.hpp"
#include "bind.hpp"

namespace dmp::python {
namespace {

py::array_t<std::int64_t> from_path(const Alignment& alignment) {
  py::array_t<std::int64_t> array({static_cast<py::ssize_t>(alignment.path.size()), py::ssize_t{2}});
  std::int64_t* out = array.mutable_data();
  for (const auto& [first, second] : alignment.path) {
    *out++ = first;
    *out++ = second;
  }
  return array;
}

/// Poses (T, 4, 4) or rows (T, d) or (T,).
Alignment align_arrays(const Array& a, const Array& b, double angle_weight, std::optional<double> band) {
  if (a.ndim() == 3 || b.ndim() == 3) {
    const Poses first = to_poses(a, "a"), second = to_poses(b, "b");
    const py::gil_scoped_release release;
    return align(first, second, angle_weight, band);
  }
  const RowMatrix first = to_matrix(a, "a"), second = to_matrix(b, "b");
  const py::gil_scoped_release release;
  return align(first, second, band);
}

}  // namespace

void bind_dtw(py::module_& m) {
  py::class_<Alignment>(m, "Alignment", "Which samples of two motions belong together.")
      .def_property_readonly(
          "path", &from_path,
          "(K, 2) indices into the first and the second, from the first of both to the last of "
          "both; each row goes on by one sample in one motion or in both")
      .def_readonly("distance", &Alignment::distance,
                    "sum over the path of the distances of its pairs; divide by len(path) for the mean")
      .def("__len__", [](const Alignment& alignment) { return alignment.path.size(); });
  m.def("align", &align_arrays, py::arg("a"), py::arg("b"), py::kw_only(), py::arg("angle_weight") = 0.2,
        py::arg("band") = py::none(),
        "Dynamic time warping (Sakoe and Chiba 1978, steps of weight 1 each) of rows (T, d) and (S, d) by "
        "their "
        "Euclidean distance, or of poses (T, 4, 4) and (S, 4, 4) by |pa - pb| + angle_weight * angle(Ra, Rb) "
        "[m; angle_weight in m/rad]. `band`: how many samples of b a pair may lie off the straight line from "
        "the "
        "first pair to the last, widened where no path would fit. Raises InvalidArgument, naming the sample, "
        "for "
        "numbers that are not finite, no samples, matrices that are no rotations, different columns.");
  m.def(
      "frechet",
      [](const Array& a, const Array& b) {
        const RowMatrix first = to_matrix(a, "a"), second = to_matrix(b, "b");
        const py::gil_scoped_release release;
        return frechet(first, second);
      },
      py::arg("a"), py::arg("b"),
      "Discrete Frechet distance of paths (T, d) and (S, d), in their unit: the shortest leash that lets a "
      "walker "
      "on each reach the end, both going forward only, from sample to sample (Eiter and Mannila 1994).");
}

}  // namespace dmp::python
