#pragma once
// What the bindings of the three kinds of model and of run have in common.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/error.hpp>
#include <dmp/file.hpp>
#include <dmp/status.hpp>

#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "options.hpp"
#include "values.hpp"

namespace dmp::python {

/// What a refused call of the loop says in Python.
inline void require_accepted(Status status, const char* message) {
  if (status == Status::invalid_input) throw InvalidArgument(message);
}

/// True while the motion runs, False when it has finished.
template <class Run>
bool step(Run& run, double dt) {
  switch (run.step(dt)) {
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

template <class Run>
void def_run(py::class_<Run>& run) {
  run.def("step", &step<Run>, py::arg("dt"),
          "Moves on by dt seconds. True while the motion runs, False when it has finished; raises "
          "FloatingPointError when "
          "the state is not finite.")
      .def(
          "set_tracking_error",
          [](Run& r, double error) {
            require_accepted(r.set_tracking_error(error), "error: expected a finite distance, 0 or more.");
          },
          py::arg("error"),
          "How far the robot lags behind: slows the phase by 1 + options.phase_stop times it.")
      .def("pause", &Run::pause, "Comes to rest on the path, through options.tempo_filter.")
      .def("resume", &Run::resume, "Goes on from there.")
      .def_property_readonly("paused", &Run::paused)
      .def("reset", &Run::reset,
           "Begins anew at the demonstrated start, with the goal and duration that were set last.")
      .def("__copy__", [](const Run& r) { return Run(r); })
      .def(
          "__deepcopy__", [](const Run& r, const py::dict&) { return Run(r); }, py::arg("memo"))
      .def_property_readonly("time", &Run::time, "s since the start")
      .def_property_readonly("phase", &Run::phase, "0 at the start, 1 at the end")
      .def_property(
          "duration", &Run::duration,
          [](Run& r, double duration) {
            require_accepted(r.set_duration(duration), "duration: expected a time in s, 1e-9 to 1e15.");
          },
          "s, of the whole motion from now on; the path stays the same")
      .def_property_readonly("status", &Run::status);
}

/// fit, options, duration, forcing weights and pickling of a model class.
template <class Dmp, class Demonstration>
void def_model(py::class_<Dmp>& model) {
  using Demonstrations = std::vector<Demonstration>;
  model
      .def_static(
          "fit",
          [](const Demonstration& demonstration, const std::optional<DmpOptions>& options,
             const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const py::gil_scoped_release release;
            return Dmp::fit(demonstration, chosen);
          },
          py::arg("demonstration"), py::arg("options") = py::none(),
          "Learns from a demonstration, or from a list of them together. `options` is a DmpOptions; its "
          "fields may be "
          "given as keywords too: fit(demonstration, basis_count=50, regression=\"ridge\").")
      .def_static(
          "fit",
          [](const Demonstrations& demonstrations, const std::optional<DmpOptions>& options,
             const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const py::gil_scoped_release release;
            return Dmp::fit(demonstrations, chosen);
          },
          py::arg("demonstrations"), py::arg("options") = py::none())
      .def_property_readonly(
          "options", [](const Dmp& dmp) { return dmp.options(); }, "A copy: what the model was learned with.")
      .def_property_readonly("duration", &Dmp::duration, "tau of the demonstration, s")
      .def_property_readonly(
          "weights", [](const Dmp& d) { return from_matrix(d.parameters().weights); },
          "(N, dims) of the forcing term")
      .def(
          "forcing",
          [](const Dmp& d, const Array& phase) {
            return from_matrix(d.forcing().evaluate(to_vector(phase, "phase")));
          },
          py::arg("phase"), "The forcing term (T, dims) at phases (T,), 0 at the start and 1 at the end.")
      .def(
          "activations",
          [](const Dmp& d, const Array& phase, bool normalised) {
            return from_matrix(d.forcing().basis().activations(to_vector(phase, "phase"), normalised));
          },
          py::arg("phase"), py::arg("normalised") = false,
          "The kernels (T, N) at phases (T,); rows sum to 1 if normalised.")
      .def("__repr__",
           [](const py::object& model) {
             const Dmp& d = model.cast<const Dmp&>();
             return "<" + py::type::of(model).attr("__name__").cast<std::string>() + ": " +
                    std::to_string(d.options().basis_count) + " kernels, " + short_number(d.duration()) +
                    " s>";
           })
      .def(py::pickle([](const Dmp& d) { return to_json(Model(d)); },
                      [](const std::string& text) { return std::get<Dmp>(from_json(text)); }));
}

/// rollout and rollout_at; `to_goal(array or None, name)` reads a goal of this kind of model.
template <class Dmp, class Goal>
void def_rollout(py::class_<Dmp>& model,
                 std::optional<Goal> (*to_goal)(const std::optional<Array>&, const char*)) {
  model
      .def(
          "rollout",
          [to_goal](const Dmp& d, const std::optional<Array>& goal, std::optional<double> duration,
                    double dt) {
            const auto target = to_goal(goal, "goal");
            const py::gil_scoped_release release;
            return d.rollout(target, duration, dt);
          },
          py::arg("goal") = py::none(), py::arg("duration") = py::none(), py::arg("dt") = 1e-3,
          "The motion from the demonstrated start to `goal` (shaped as the property goal; the demonstrated "
          "one unless "
          "given) within `duration` s (the demonstrated one unless given), at 0, dt, ... up to the duration. "
          "Raises "
          "InvalidArgument for a wrong shape, a number that is not finite or not positive, more than 10^7 "
          "samples, or a "
          "motion that does not stay finite.")
      .def(
          "rollout_at",
          [to_goal](const Dmp& d, const Array& times, const std::optional<Array>& goal,
                    std::optional<double> duration) {
            const auto target = to_goal(goal, "goal");
            const Eigen::VectorXd moments = to_vector(times, "times");
            const py::gil_scoped_release release;
            return d.rollout_at(moments, target, duration);
          },
          py::arg("times"), py::arg("goal") = py::none(), py::arg("duration") = py::none(),
          "The same at times (T,) in s, increasing from 0 or later.");
}

}  // namespace dmp::python
