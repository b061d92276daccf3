#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/average.hpp>
#include <dmp/fit_report.hpp>
#include <dmp/spread.hpp>

#include "arrays.hpp"
#include "bind.hpp"

namespace dmp::python {
namespace {

template <class Matrices>
py::array_t<double> stacked(const Matrices& matrices) {
  const py::ssize_t count = static_cast<py::ssize_t>(matrices.size());
  const py::ssize_t size = count > 0 ? matrices[0].rows() : 0;
  py::array_t<double> array({count, size, size});
  for (py::ssize_t k = 0; k < count; ++k)
    Eigen::Map<RowMatrix>(array.mutable_data() + k * size * size, size, size) =
        matrices[static_cast<std::size_t>(k)];
  return array;
}

void bind_spread(py::module_& m) {
  py::class_<Spread>(m, "Spread",
                     "Where demonstrations of one motion lie over the phase, each taken at t / duration.")
      .def_property_readonly(
          "phase", [](const Spread& s) { return from_vector(s.phase); }, "(K,) 0 to 1")
      .def_property_readonly(
          "mean", [](const Spread& s) { return from_matrix(s.mean); }, "(K, d)")
      .def_property_readonly(
          "covariance", [](const Spread& s) { return stacked(s.covariance); },
          "(K, d, d) of one demonstration about the mean");
  py::class_<PoseSpread>(m, "PoseSpread", "Where demonstrations of one motion lie over the phase, for poses.")
      .def_property_readonly(
          "phase", [](const PoseSpread& s) { return from_vector(s.phase); }, "(K,) 0 to 1")
      .def_property_readonly(
          "mean", [](const PoseSpread& s) { return from_poses(s.mean); }, "(K, 4, 4)")
      .def_property_readonly(
          "covariance", [](const PoseSpread& s) { return stacked(s.covariance); },
          "(K, 6, 6) of position [m] and rotation vector from the mean [rad, world frame]");
  const char* doc =
      "Mean and covariance of demonstrations at `count` even phases. Raises InvalidArgument for none, or for "
      "different "
      "dimensions.";
  m.def("spread", py::overload_cast<const std::vector<Demonstration>&, Eigen::Index>(&spread),
        py::arg("demonstrations"), py::arg("count") = 101, doc);
  m.def("spread", py::overload_cast<const std::vector<PoseDemonstration>&, Eigen::Index>(&spread),
        py::arg("demonstrations"), py::arg("count") = 101, doc);
}

template <class Model, class Demonstration>
void def_assess(py::module_& m) {
  m.def(
      "assess",
      [](const Model& model, const std::vector<Demonstration>& demonstrations, double position,
         double angle) {
        const py::gil_scoped_release release;
        return assess(model, demonstrations, {position, angle});
      },
      py::arg("model"), py::arg("demonstrations"), py::arg("position") = Tolerance{}.position,
      py::arg("angle") = Tolerance{}.angle,
      "How a model reproduces a list of demonstrations, and what was found in them. `position` and `angle` "
      "(rad) are the "
      "RMSE that the suggested number of kernels shall reach.");
  m.def("average", py::overload_cast<const std::vector<Model>&>(&average), py::arg("models"),
        "The model with the mean of all weights, starts, goals, start velocities and durations. Raises "
        "InvalidArgument for "
        "models that differ in options or dimension; a joint fit is right everywhere.");
}

}  // namespace

void bind_learning(py::module_& m) {
  py::class_<FitReport>(
      m, "FitReport",
      "How a model reproduces demonstrations. Columns: dimensions of a position; components of the "
      "rotation vector between the orientations; for poses three of each.")
      .def_property_readonly(
          "rmse", [](const FitReport& r) { return from_vector(r.rmse); }, "(d,)")
      .def_property_readonly(
          "largest", [](const FitReport& r) { return from_vector(r.largest); }, "(d,)")
      .def_property_readonly(
          "noise", [](const FitReport& r) { return from_vector(r.noise); },
          "(d,) standard deviation found in the data")
      .def_property_readonly(
          "removed", [](const FitReport& r) { return from_vector(r.removed); },
          "(d,) root of the mean square that smoothing took out; 0 unless it was asked for")
      .def_readonly(
          "evidence", &FitReport::evidence,
          "what each demonstration shows of noise: a list of NoiseEstimate, of its positions, of its "
          "orientations, or of both")
      .def_readonly("largest_log", &FitReport::largest_log, "rad, the largest |Log(Rg R^T)| on the way")
      .def_readonly("condition", &FitReport::condition, "of the regression's matrix")
      .def_readonly("suggested_basis_count", &FitReport::suggested_basis_count,
                    "the fewest of 10, 20, 40, .. 1280 kernels that reach the tolerance; 0: none does")
      .def_readonly("warnings", &FitReport::warnings);
  def_assess<Dmp, Demonstration>(m);
  def_assess<OrientationDmp, OrientationDemonstration>(m);
  def_assess<PoseDmp, PoseDemonstration>(m);
  bind_spread(m);
}

}  // namespace dmp::python
