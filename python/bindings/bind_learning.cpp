#include <pybind11/native_enum.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/fit_report.hpp>
#include <dmp/spread.hpp>
#include <dmp/status.hpp>

#include "arrays.hpp"
#include "bind.hpp"
#include "options.hpp"

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

template <class Demonstration>
void def_spread(py::module_& m, const char* doc) {
  m.def(
      "spread",
      [](const std::vector<Demonstration>& demonstrations, Eigen::Index count) {
        return spread(demonstrations, count);
      },
      py::arg("demonstrations"), py::arg("count") = 101, doc);
}

void bind_spread(py::module_& m) {
  py::class_<Spread>(m, "Spread",
                     "Where demonstrations of one motion lie over the phase, each taken at t / duration.")
      .def_property_readonly(
          "phase", [](const Spread& s) { return shown(s.phase); }, "(K,) 0 to 1")
      .def_property_readonly(
          "mean", [](const Spread& s) { return shown(s.mean); }, "(K, d)")
      .def_property_readonly(
          "covariance", [](const Spread& s) { return stacked(s.covariance); },
          "(K, d, d) of one demonstration about the mean");
  py::class_<PoseSpread>(m, "PoseSpread", "Where demonstrations of one motion lie over the phase, for poses.")
      .def_property_readonly(
          "phase", [](const PoseSpread& s) { return shown(s.phase); }, "(K,) 0 to 1")
      .def_property_readonly(
          "mean", [](const PoseSpread& s) { return shown(s.mean); }, "(K, 4, 4)")
      .def_property_readonly(
          "covariance", [](const PoseSpread& s) { return stacked(s.covariance); },
          "(K, 6, 6) of position [m] and rotation vector from the mean [rad, world frame]");
  using OrientationSpread = SpreadOf<RotationSpace>;
  py::class_<OrientationSpread>(m, "OrientationSpread",
                                "Where demonstrations of one motion lie over the phase, for orientations.")
      .def_property_readonly(
          "phase", [](const OrientationSpread& s) { return shown(s.phase); }, "(K,) 0 to 1")
      .def_property_readonly(
          "mean", [](const OrientationSpread& s) { return shown(s.mean); }, "(K, 3, 3)")
      .def_property_readonly(
          "covariance", [](const OrientationSpread& s) { return stacked(s.covariance); },
          "(K, 3, 3) of the rotation vector from the mean [rad, world frame]");
  const char* const doc =
      "Mean and covariance of demonstrations at `count` even phases. Raises InvalidArgument for none, or for "
      "different "
      "dimensions.";
  def_spread<Demonstration>(m, doc);
  def_spread<PoseDemonstration>(m, doc);
}

void bind_basis(py::module_& m) {
  using B = GaussianBasis;
  py::class_<B>(m, "GaussianBasis", "Gaussian kernels over the phase.")
      .def_static("equal_in_time", &B::equal_in_time, py::arg("count"), py::arg("alpha_x"),
                  py::arg("overlap"), "Kernels of one width in time; neighbours cross at exp(-overlap / 4).")
      .def_static("source", &B::source, py::arg("count"), py::arg("alpha_x"),
                  "Kernels in x = exp(-alpha_x s) by DeWolf's rule.")
      .def_property_readonly("count", &B::count, "N")
      .def_property_readonly("alpha_x", &B::alpha_x)
      .def_property_readonly(
          "centers", [](const B& b) { return shown(b.centers()); }, "(N,) in x")
      .def(
          "activations",
          [](const B& b, const Array& phase, bool normalised) {
            return from_matrix(b.activations(to_vector(phase, "phase"), normalised));
          },
          py::arg("phase"), py::arg("normalised") = false,
          "The kernels (T, N) at phases (T,); rows sum to 1 if normalised.")
      .def(
          "features",
          [](const B& b, const Array& phase) { return from_matrix(b.features(to_vector(phase, "phase"))); },
          py::arg("phase"),
          "What the forcing term is linear in (T, N): features(phase) @ weights is the forcing term.");
}

void bind_targets(py::module_& m) {
  using T = ForcingTarget;
  py::class_<T>(m, "ForcingTarget", "What a forcing term should be along one demonstration.")
      .def(py::init([](const Array& phase, const Array& value, const std::optional<Array>& scale) {
             T target{to_vector(phase, "phase"), to_matrix(value, "value"), {}};
             target.scale =
                 scale ? to_vector(*scale, "scale") : Eigen::VectorXd::Ones(target.value.cols()).eval();
             return target;
           }),
           py::arg("phase"), py::arg("value"), py::arg("scale") = py::none(),
           "phase (K,), increasing; value (K, dims); scale (dims,), 1 unless given.")
      .def_property_readonly(
          "phase", [](const T& t) { return shown(t.s); }, "(K,)")
      .def_property_readonly(
          "value", [](const T& t) { return shown(t.value); }, "(K, dims)")
      .def_property_readonly(
          "scale", [](const T& t) { return shown(t.scale); },
          "(dims,): value = scale * (basis.features(phase) @ weights)");
  m.def(
      "fit_forcing",
      [](const GaussianBasis& basis, const std::vector<T>& targets, const std::optional<DmpOptions>& options,
         const py::kwargs& fields) {
        const DmpOptions chosen = options_with(options, fields).resolved();
        const auto fitted = [&] {
          const py::gil_scoped_release release;
          return fit_forcing(basis, targets, chosen);
        };
        return from_matrix(fitted());
      },
      py::arg("basis"), py::arg("targets"), py::arg("options") = py::none(),
      "The weights (N, dims) of one forcing term for all targets together, by the options' regression.");
}

}  // namespace

Learner learner_of(const py::object& function) {
  return [&function](const GaussianBasis& basis, const std::vector<ForcingTarget>& targets) {
    const py::gil_scoped_acquire held;
    return to_matrix(function(basis, targets).cast<Array>(), "learner: weights");
  };
}

void bind_learning(py::module_& m) {
  py::native_enum<Status>(m, "Status", "enum.Enum", "What a call inside the control loop says.")
      .value("running", Status::running)
      .value("finished", Status::finished)
      .value("invalid_input", Status::invalid_input)
      .value("not_finite", Status::not_finite)
      .value("too_late", Status::too_late)
      .value("blocked", Status::blocked)
      .finalize();
  py::class_<EndPeaks>(
      m, "EndPeaks",
      "Accelerations (m/s^2, rad/s^2) in the first and the last 3 % of a demonstration: the largest of the "
      "model, and the largest second difference of the samples, which hold no more.")
      .def_readonly("start", &EndPeaks::start, "of the model, in the first 3 %")
      .def_readonly("goal", &EndPeaks::goal, "of the model, in the last 3 %")
      .def_readonly("start_samples", &EndPeaks::start_samples, "what the samples hold there")
      .def_readonly("goal_samples", &EndPeaks::goal_samples, "what the samples hold there");
  py::class_<FitReport>(
      m, "FitReport",
      "How a model reproduces demonstrations. Columns: dimensions of a position; components of the "
      "rotation vector between the orientations; for poses three of each.")
      .def_property_readonly(
          "rmse", [](const FitReport& r) { return shown(r.rmse); }, "(d,)")
      .def_property_readonly(
          "largest", [](const FitReport& r) { return shown(r.largest); }, "(d,)")
      .def_property_readonly(
          "noise", [](const FitReport& r) { return shown(r.noise); },
          "(d,) standard deviation found in the data")
      .def_property_readonly(
          "removed", [](const FitReport& r) { return shown(r.removed); },
          "(d,) root of the mean square that smoothing took out; 0 unless it was asked for")
      .def_readonly(
          "evidence", &FitReport::evidence,
          "what each demonstration shows of noise: a list of NoiseEstimate, of its positions, of its "
          "orientations, or of both")
      .def_readonly("ends", &FitReport::ends,
                    "the accelerations at the ends of each demonstration: a list of EndPeaks, as evidence")
      .def_readonly("largest_log", &FitReport::largest_log, "rad, the largest |Log(Rg R^T)| on the way")
      .def_readonly("condition", &FitReport::condition, "of the regression's matrix")
      .def_readonly("suggested_basis_count", &FitReport::suggested_basis_count,
                    "the fewest of 10, 20, 40, .. 1280 kernels that reach the tolerance; 0: none does")
      .def_readonly("warnings", &FitReport::warnings);
  bind_basis(m);
  bind_targets(m);
  bind_spread(m);
}

}  // namespace dmp::python
