#pragma once
// Everything that Python has of a primitive, for any space: model, parameters, run, trajectories, batches.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <dmp/average.hpp>
#include <dmp/batch.hpp>
#include <dmp/error.hpp>
#include <dmp/file.hpp>
#include <dmp/fit_report.hpp>
#include <dmp/safety_filter.hpp>
#include <dmp/status.hpp>

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "adaptation.hpp"
#include "arrays.hpp"
#include "distributions.hpp"
#include "loop.hpp"
#include "options.hpp"
#include "sequences.hpp"
#include "spaces.hpp"
#include "trajectories.hpp"
#include "values.hpp"

namespace dmp::python {

/// A learner of the user's own; it must not outlive `function`.
Learner learner_of(const py::object& function);

// Parameters

inline void read_field(double& field, const py::object& value, const char*) { field = value.cast<double>(); }
inline void read_field(RowMatrix& field, const py::object& value, const char* name) {
  field = to_matrix(value.cast<Array>(), name);
}
inline void read_field(Eigen::Matrix3d& field, const py::object& value, const char* name) {
  field = to_rotation(value.cast<Array>(), name);
}
inline void read_field(Eigen::Matrix4d& field, const py::object& value, const char* name) {
  field = to_pose(value.cast<Array>(), name);
}
template <int N>
void read_field(Eigen::Matrix<double, N, 1>& field, const py::object& value, const char* name) {
  const Eigen::VectorXd given = to_vector(value.cast<Array>(), name);
  if (N != Eigen::Dynamic && given.size() != N)
    throw InvalidArgument(std::string(name) + ": " + std::to_string(given.size()) + " numbers, expected " +
                          std::to_string(N) + ".");
  field = given;
}
template <class First, class Second>
void read_field(std::pair<First, Second>& field, const py::object& value, const char* name) {
  const auto both = value.cast<std::pair<py::object, py::object>>();
  read_field(field.first, both.first, name);
  read_field(field.second, both.second, name);
}

template <class Space>
void bind_parameters(py::module_& m) {
  using P = typename Space::Parameters;
  const Naming& naming = InPython<Space>::naming;
  const std::string doc =
      std::string("All that a ") + naming.model + " is: what a model file holds. Fields as keywords.";
  py::class_<P> parameters(m, naming.parameters, doc.c_str());
  parameters.def(py::init(&with_keywords<P>)).def_readwrite("options", &P::options);
  const auto def = [&](const char* name, auto field) {
    parameters.def_property(
        name, [field](const P& p) { return show_field(p.*field); },
        [field, name](P& p, const py::object& value) { read_field(p.*field, value, name); });
  };
  const auto def_all = [&](const auto&... field) { (def(field.first, field.second), ...); };
  std::apply(def_all, P::fields());
  std::apply(def_all, P::optional_fields());
  parameters.def("__repr__", [name = naming.parameters](const P& p) {
    return std::string(name) + "(" + std::to_string(p.weights.rows()) + " x " +
           std::to_string(p.weights.cols()) + " weights, " + short_number(p.duration) + " s)";
  });
}

// Runs

/// A Python function as a coupling. What it raises is kept for after the step: nothing leaves the loop.
template <class Space>
struct PythonCoupling {
  const py::object& function;
  mutable std::exception_ptr raised;

  void operator()(const CouplingState<Space>& state, typename Coupling<Space>::Drive& drive) const noexcept {
    if (raised) return;
    try {
      const Eigen::VectorXd value = to_vector(function(state).template cast<Array>(), "coupling");
      if (value.size() != drive.size())
        throw InvalidArgument("coupling: returned " + std::to_string(value.size()) + " numbers, expected " +
                              std::to_string(drive.size()) + ".");
      drive += value;
    } catch (...) {
      raised = std::current_exception();
    }
  }
};

/// A step with a coupling; where that raises, the run stays as it was, and the filter, if there is one.
template <class Run, class Space>
Status step_coupled(Run& run, double dt, const py::object& function, SafetyFilter* filter) {
  Run before(run);
  const std::optional<SafetyFilter> filter_before =
      filter ? std::optional<SafetyFilter>(*filter) : std::nullopt;
  const PythonCoupling<Space> coupling{function, {}};
  const Status status = filter ? run.step(dt, coupling, *filter) : run.step(dt, coupling);
  if (!coupling.raised) return status;
  run = before;
  if (filter) *filter = *filter_before;
  std::rethrow_exception(coupling.raised);
}

/// The same as is_running, where the filter may be what refuses the step.
template <class Run>
bool is_running_filtered(const Run& run, Status status, double dt) {
  if (status == Status::blocked) return run.phase() < 1.0 - 1e-9;
  if (status == Status::invalid_input)
    throw InvalidArgument(
        "step: dt (" + short_number(dt) +
        ") is not a time in s from 0 to 10 durations and 10^5 of the filter's largest steps, or "
        "the filter is for another motion: its limits have another number of axes, or it has "
        "obstacles and the motion is not one of up to three axes, or of a pose.");
  return is_running(status, dt);
}

template <class Space>
void bind_run_state(py::module_& m) {
  using S = CouplingState<Space>;
  const Naming& naming = InPython<Space>::naming;
  py::class_<S>(m, naming.run_state, "What a coupling sees: the run at the start of an internal step.")
      .def_readonly("phase", &S::phase, "s, 0 at the start, 1 at the end")
      .def_readonly("speed", &S::speed, "ds/dt as it is now, 1/s")
      .def_property_readonly(
          "point", [](const S& s) { return show_field(s.point); }, naming.point)
      .def_property_readonly(
          "velocity", [](const S& s) { return show_field(s.velocity); },
          "per s; of rotations rad/s, world frame")
      .def_property_readonly("goal", [](const S& s) { return show_field(s.goal); }, "the one set last");
}

template <class Space, class Run>
void bind_run(py::module_& m) {
  using Given = typename InPython<Space>::Given;
  static const Naming& naming = InPython<Space>::naming;
  const std::string doc = std::string("One run of a ") + naming.model + ", for one control loop.";
  py::class_<Run> run(m, naming.run, doc.c_str());
  run.def(py::init<const Primitive<Space>&>(), py::arg("dmp"))
      .def(
          "step",
          [](Run& r, double dt, const std::optional<py::function>& coupling, SafetyFilter* filter) {
            const Status status = coupling ? step_coupled<Run, Space>(r, dt, *coupling, filter)
                                  : filter ? r.step(dt, *filter)
                                           : r.step(dt);
            return filter ? is_running_filtered(r, status, dt) : is_running(status, dt);
          },
          py::arg("dt"), py::arg("coupling") = py::none(), py::arg("filter") = py::none(),
          "Moves on by dt seconds. True while the motion runs, False when it has finished; raises "
          "FloatingPointError when the state is not finite. `coupling(state)`, called in each internal step, "
          "returns what is added to the forcing term (d,): an acceleration divided by state.speed**2. Where "
          "it "
          "raises, the run stays as it was. `filter`, a SafetyFilter, changes where the run is so that "
          "limits are "
          "kept and obstacles not touched; status is Status.blocked where they leave no way on.")
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
      .def_property_readonly("status", &Run::status)
      .def_property(
          "amplitude", &Run::amplitude,
          [](Run& r, double amplitude) {
            require_accepted(r.set_amplitude(amplitude), "amplitude: expected a finite factor, 0 or more.");
          },
          "what the forcing term is multiplied by, 1 at first: of a rhythmic motion what it goes away from "
          "its "
          "centre; approached as a goal is")
      .def_property(
          "goal", [](const Run& r) { return show_field(typename Space::Point(r.goal())); },
          [](Run& r, const Given& goal) {
            require_accepted(r.set_goal(InPython<Space>::to_point(goal, "goal")),
                             std::string("goal: ") + naming.goal_refused + "; the old one stays.");
          },
          (std::string(naming.point) + " the goal to go to from now on, approached through the goal filter")
              .c_str())
      .def(
          "start_from",
          [](Run& r, const Given& point, const Array& velocity) {
            using Tangent = typename Space::Tangent;
            const Eigen::VectorXd given = to_vector(velocity, naming.start_velocity);
            const bool fits =
                Tangent::RowsAtCompileTime == Eigen::Dynamic || given.size() == Tangent::RowsAtCompileTime;
            const auto start = InPython<Space>::to_point(point, naming.start_point);
            require_accepted(fits ? r.start_from(start, Tangent(given)) : Status::invalid_input,
                             std::string("start_from: ") + naming.start_point + " (" + naming.goal_refused +
                                 ") or " + naming.start_velocity +
                                 " (wrong size or not finite); nothing changed.");
          },
          py::arg(naming.start_point), py::arg(naming.start_velocity), naming.start_doc);
  def_adaptation<Space>(run);
  InPython<Space>::outputs(run);
}

// Models

template <class Space>
void def_learning(py::class_<Primitive<Space>>& model) {
  using Model = Primitive<Space>;
  using Demonstration = typename Space::Demonstration;
  using Demonstrations = std::vector<Demonstration>;
  model
      .def_static(
          "fit",
          [](const Demonstration& demonstration, const std::optional<DmpOptions>& options,
             const std::optional<py::function>& learner, const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const Learner own = learner ? learner_of(*learner) : Learner{};
            const py::gil_scoped_release release;
            return Model::fit(demonstration, chosen, own);
          },
          py::arg("demonstration"), py::arg("options") = py::none(), py::kw_only(),
          py::arg("learner") = py::none(),
          "Learns from a demonstration, or from a list of them together. `options` is a DmpOptions; its "
          "fields "
          "may be given as keywords too: fit(demonstration, basis_count=50, regression=\"ridge\"). "
          "`learner(basis, targets)` returns the weights (N, dims) in place of the options' regression.")
      .def_static(
          "fit",
          [](const Demonstrations& demonstrations, const std::optional<DmpOptions>& options,
             const std::optional<py::function>& learner, const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const Learner own = learner ? learner_of(*learner) : Learner{};
            const py::gil_scoped_release release;
            return Model::fit(demonstrations, chosen, own);
          },
          py::arg("demonstrations"), py::arg("options") = py::none(), py::kw_only(),
          py::arg("learner") = py::none())
      .def_static(
          "targets",
          [](const Demonstrations& demonstrations, const std::optional<DmpOptions>& options,
             const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const py::gil_scoped_release release;
            return Model::targets(demonstrations, chosen);
          },
          py::arg("demonstrations"), py::arg("options") = py::none(),
          "What fit learns from: the forcing term along each demonstration, one ForcingTarget each.")
      .def(
          "with_weights",
          [](const Model& d, const Array& weights) { return d.with_weights(to_matrix(weights, "weights")); },
          py::arg("weights"), "The same model with other weights (N, dims).")
      .def(
          "with_scaling",
          [](const Model& d, const py::object& scaling) {
            py::kwargs fields;
            fields["scaling"] = scaling;
            const Scaling wanted = options_with(std::nullopt, fields).scaling;
            const py::gil_scoped_release release;
            return d.with_scaling(wanted);
          },
          py::arg("scaling"),
          "The same motion, led to new starts and goals by another Scaling, or its name. Of several "
          "demonstrations learned together it is the mean that is scaled. Raises InvalidArgument for an "
          "unknown "
          "one, or one that the form of orientations does not bear.")
      .def(
          "scaling_notes",
          [](const Model& d, const std::optional<typename InPython<Space>::Given>& goal) {
            if (!goal) return d.scaling_notes(d.goal());
            return d.scaling_notes(InPython<Space>::to_point(*goal, "goal"));
          },
          py::arg("goal") = py::none(),
          "Where the guard of the scaling steps in on the way to `goal` (the demonstrated one unless given), "
          "a "
          "line for each axis; see DmpOptions.scaling_guard.");
}

template <class Space>
void def_batches(py::class_<Primitive<Space>>& model) {
  using Model = Primitive<Space>;
  using Given = typename InPython<Space>::Given;
  static const Naming& naming = InPython<Space>::naming;
  model
      .def_static(
          "fit_each",
          [](const std::vector<typename Space::Demonstration>& demonstrations,
             const std::optional<DmpOptions>& options, int threads, const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const py::gil_scoped_release release;
            return Model::fit_each(demonstrations, chosen, threads);
          },
          py::arg("demonstrations"), py::arg("options") = py::none(), py::arg("threads") = 1,
          "One model for each demonstration, the same as fit gives. threads: how many to use, 0 for as many "
          "as the machine runs at once. Options as in fit.")
      .def_static(
          "fit_each",
          [](const Array& times, const Given& values, const std::optional<DmpOptions>& options, int threads,
             const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const Eigen::VectorXd grid = to_vector(times, "times");
            const auto paths = InPython<Space>::to_paths(values, naming.paths);
            const py::gil_scoped_release release;
            return Model::fit_each(grid, paths, chosen, threads);
          },
          py::arg("times"), py::arg(naming.paths), py::arg("options") = py::none(), py::arg("threads") = 1,
          (std::string("The same for ") + naming.paths + ", " + naming.paths_shape +
           ", on one time grid, times (T,) s.")
              .c_str())
      .def(
          "rollout_each",
          [](const Model& d, const std::optional<Given>& goals, const std::optional<Array>& durations,
             Eigen::Index samples, int threads) {
            std::vector<typename Space::Point> targets;
            if (goals) targets = InPython<Space>::to_goals(*goals, "goals");
            const Eigen::VectorXd times = durations ? to_vector(*durations, "durations") : Eigen::VectorXd{};
            const Eigen::Index count = std::max(static_cast<Eigen::Index>(targets.size()), times.size());
            Batch<Space> batch(d, count, std::max<Eigen::Index>(samples, 0));
            const py::gil_scoped_release release;
            d.rollout_each(
                targets, times, samples, [&](Eigen::Index k, const auto& motion) { batch.put(k, motion); },
                threads);
            return batch;
          },
          py::arg("goals") = py::none(), py::arg("durations") = py::none(), py::arg("samples") = 1001,
          py::arg("threads") = 1,
          "One motion for each of M goals (M, ...) and durations (M,) s, T = `samples` of each, evenly from "
          "0 "
          "to its duration: the same as rollout(goal, duration, duration / (samples - 1)). Without goals, or "
          "without durations, the demonstrated one for all. threads: 0 for as many as the machine runs at "
          "once. Raises InvalidArgument, naming the motion, as rollout does.");
}

template <class Space>
void def_rollout(py::class_<Primitive<Space>>& model) {
  using Model = Primitive<Space>;
  using Given = typename InPython<Space>::Given;
  using Goal = std::optional<typename Space::Point>;
  const auto to_goal = [](const std::optional<Given>& goal) {
    return goal ? Goal(InPython<Space>::to_point(*goal, "goal")) : Goal();
  };
  model
      .def(
          "rollout",
          [to_goal](const Model& d, const std::optional<Given>& goal, std::optional<double> duration,
                    double dt, const std::vector<GivenVia>& via) {
            const Goal target = to_goal(goal);
            const auto vias = to_vias<Space>(via);
            const py::gil_scoped_release release;
            return d.rollout(target, duration, dt, vias);
          },
          py::arg("goal") = py::none(), py::arg("duration") = py::none(), py::arg("dt") = 1e-3,
          py::arg("via") = py::tuple(),
          "The motion from the demonstrated start to `goal` (shaped as the property goal; the demonstrated "
          "one "
          "unless given) within `duration` s (the demonstrated one unless given), at 0, dt, ... and the "
          "duration, the last step shorter where dt does not divide it. Raises InvalidArgument for a wrong "
          "shape, a number that is not finite or not positive, more than 10^7 samples, or a motion that does "
          "not "
          "stay finite. `via`: a list of Via that it passes, in the order of their phases.")
      .def(
          "rollout_at",
          [to_goal](const Model& d, const Array& times, const std::optional<Given>& goal,
                    std::optional<double> duration, const std::vector<GivenVia>& via) {
            const Goal target = to_goal(goal);
            const auto vias = to_vias<Space>(via);
            const Eigen::VectorXd moments = to_vector(times, "times");
            const py::gil_scoped_release release;
            return d.rollout_at(moments, target, duration, vias);
          },
          py::arg("times"), py::arg("goal") = py::none(), py::arg("duration") = py::none(),
          py::arg("via") = py::tuple(), "The same at times (T,) in s, increasing from 0 or later.");
}

template <class Space>
void def_model(py::class_<Primitive<Space>>& model) {
  using Model = Primitive<Space>;
  const Naming& naming = InPython<Space>::naming;
  model.def(py::init<const typename Space::Parameters&>(), py::arg("parameters"))
      .def_property_readonly(
          "parameters", [](const Model& d) { return d.parameters(); },
          "A copy of all that the model is: change it and make another model.")
      .def_property_readonly(
          "options", [](const Model& d) { return d.options(); }, "A copy: what the model was learned with.")
      .def_property_readonly("duration", &Model::duration, "tau of the demonstration, s")
      .def_property_readonly("dimension", &Model::dimension, "axes of the motion")
      .def_property_readonly(
          "start", [](const Model& d) { return show_field(d.start()); }, naming.point)
      .def_property_readonly(
          "goal", [](const Model& d) { return show_field(d.goal()); }, naming.point)
      .def_property_readonly(
          "weights", [](const Model& d) { return shown(d.parameters().weights); },
          "(N, dims) of the forcing term; see with_weights")
      .def_property_readonly(
          "basis", [](const Model& d) { return d.forcing().basis(); }, "The kernels of the forcing term.")
      .def(
          "forcing",
          [](const Model& d, const Array& phase) {
            return from_matrix(d.forcing().evaluate(to_vector(phase, "phase")));
          },
          py::arg("phase"), "The forcing term (T, dims) at phases (T,), 0 at the start and 1 at the end.")
      .def(
          "activations",
          [](const Model& d, const Array& phase, bool normalised) {
            return from_matrix(d.forcing().basis().activations(to_vector(phase, "phase"), normalised));
          },
          py::arg("phase"), py::arg("normalised") = false,
          "The kernels (T, N) at phases (T,); rows sum to 1 if normalised.")
      .def("__repr__",
           [](const py::object& object) {
             const Model& d = object.cast<const Model&>();
             return "<" + py::type::of(object).attr("__name__").template cast<std::string>() + ": " +
                    std::to_string(d.options().basis_count) + " kernels, " + short_number(d.duration()) +
                    " s>";
           })
      .def(py::pickle([](const Model& d) { return to_json(dmp::Model(d)); },
                      [](const std::string& text) { return std::get<Model>(from_json(text)); }));
}

/// The functions of the module that take a model.
template <class Space>
void def_functions(py::module_& m) {
  using Model = Primitive<Space>;
  m.def(
      "assess",
      [](const Model& model, const std::vector<typename Space::Demonstration>& demonstrations,
         double position, double angle) {
        const py::gil_scoped_release release;
        return assess(model, demonstrations, {position, angle});
      },
      py::arg("model"), py::arg("demonstrations"), py::arg("position") = Tolerance{}.position,
      py::arg("angle") = Tolerance{}.angle,
      "How a model reproduces a list of demonstrations, and what was found in them. `position` and `angle` "
      "(rad) are the RMSE that the suggested number of kernels shall reach.");
  m.def("average", &average<Space>, py::arg("models"),
        "The model with the mean of all weights, starts, goals, start velocities and durations. Raises "
        "InvalidArgument for models that differ in options or dimension; a joint fit is right everywhere.");
  m.def(
      "save", [](const Model& model, const std::filesystem::path& path) { save(model, path.string()); },
      py::arg("model"), py::arg("path"),
      "Writes a model file (JSON), whole or not at all. Raises FileError.");
  m.def(
      "to_json", [](const Model& model) { return to_json(model); }, py::arg("model"),
      "The text of a model file.");
}

/// Model, parameters, run, batches and functions of a space; its demonstrations and trajectories are bound
/// already.
template <class Space, class Run>
void bind_space(py::module_& m) {
  const Naming& naming = InPython<Space>::naming;
  bind_parameters<Space>(m);
  bind_batch<Space>(m);
  const std::string doc = std::string("A dynamic movement primitive for ") + naming.moves + ". Immutable.";
  py::class_<Primitive<Space>> model(m, naming.model, doc.c_str());
  def_model<Space>(model);
  def_learning<Space>(model);
  def_batches<Space>(model);
  def_rollout<Space>(model);
  def_functions<Space>(m);
  bind_run_state<Space>(m);
  bind_run<Space, Run>(m);
  bind_sequence<Space>(m);
  bind_distribution<Space>(m);
}

}  // namespace dmp::python
