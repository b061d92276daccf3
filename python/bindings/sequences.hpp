#pragma once
// Sequences of motions as Python has them.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/error.hpp>
#include <dmp/file.hpp>
#include <dmp/sequence.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "adaptation.hpp"
#include "loop.hpp"
#include "values.hpp"

namespace dmp::python {

/// One number for all parts, or one for each.
using OneOrEach = std::variant<double, std::vector<double>>;

inline std::vector<double> for_each_part(const OneOrEach& given, std::size_t count, const std::string& name) {
  if (const double* one = std::get_if<double>(&given)) return std::vector<double>(count, *one);
  const auto& each = std::get<std::vector<double>>(given);
  if (each.size() != count)
    throw InvalidArgument(name + ": " + std::to_string(each.size()) +
                          " numbers, expected one, or one for each of the " + std::to_string(count) +
                          " models.");
  return each;
}

template <class Space>
Sequence<Space> to_sequence(const std::vector<Primitive<Space>>& models, const OneOrEach& leave,
                            const OneOrEach& reach, const std::vector<std::vector<GivenVia>>& via) {
  const std::vector<double> leaves = for_each_part(leave, models.size(), "leave");
  const std::vector<double> reaches = for_each_part(reach, models.size(), "reach");
  if (!via.empty() && via.size() != models.size())
    throw InvalidArgument("via: " + std::to_string(via.size()) + " lists, expected one for each of the " +
                          std::to_string(models.size()) + " models, or none.");
  std::vector<SequencePart<Space>> parts;
  for (std::size_t k = 0; k < models.size(); ++k) {
    parts.emplace_back(models[k], leaves[k], reaches[k]);
    if (!via.empty()) parts.back().vias = to_vias<Space>(via[k]);
  }
  return Sequence<Space>(parts);
}

template <class Space, class Class>
void def_sequence_rollouts(Class& sequence) {
  using S = Sequence<Space>;
  using Given = typename InPython<Space>::Given;
  using Goal = std::optional<typename Space::Point>;
  const auto to_goal = [](const std::optional<Given>& goal) {
    return goal ? Goal(InPython<Space>::to_point(*goal, "goal")) : Goal();
  };
  sequence
      .def(
          "rollout",
          [to_goal](const S& s, const std::optional<Given>& goal, std::optional<double> duration, double dt) {
            const Goal target = to_goal(goal);
            const py::gil_scoped_release release;
            return s.rollout(target, duration, dt);
          },
          py::arg("goal") = py::none(), py::arg("duration") = py::none(), py::arg("dt") = 1e-3,
          "The whole motion, to `goal` at its end, within `duration` s (all parts in proportion), as the "
          "rollout of a model.")
      .def(
          "rollout_at",
          [to_goal](const S& s, const Array& times, const std::optional<Given>& goal,
                    std::optional<double> duration) {
            const Goal target = to_goal(goal);
            const Eigen::VectorXd moments = to_vector(times, "times");
            const py::gil_scoped_release release;
            return s.rollout_at(moments, target, duration);
          },
          py::arg("times"), py::arg("goal") = py::none(), py::arg("duration") = py::none(),
          "The same at times (T,) in s, increasing from 0 or later.");
}

/// The sequence of a space's models and its run; `Output` is the class of its runs.
template <class Space>
void bind_sequence(py::module_& m) {
  using S = Sequence<Space>;
  using R = SequenceRun<Space>;
  static const std::string name = std::string(InPython<Space>::naming.model) + "Sequence";
  py::class_<S> sequence(m, name.c_str(),
                         "Motions one after another as one: each takes over where the one before is left, "
                         "without a jump of position, velocity or acceleration. Immutable.");
  sequence
      .def(
          py::init(&to_sequence<Space>), py::arg("models"), py::arg("leave") = 1.0, py::arg("reach") = 0.2,
          py::arg("via") = py::tuple(),
          "models: 1 to 32. leave: the phase of each at which the next one takes over, 0.01 to 1, or one for "
          "all; below 1 without coming to rest. reach: the part of the phase of each, 0.01 to 1, within "
          "which "
          "it is come onto from the one before. via: a list of Via for each model. Raises InvalidArgument, "
          "naming the part.")
      .def_property_readonly("models",
                             [](const S& s) {
                               std::vector<Primitive<Space>> models;
                               for (const auto& part : s.parts()) models.push_back(part.model);
                               return models;
                             })
      .def_property_readonly("leave",
                             [](const S& s) {
                               std::vector<double> leave;
                               for (const auto& part : s.parts()) leave.push_back(part.leave);
                               return leave;
                             })
      .def_property_readonly("duration", &S::duration, "s, of all as demonstrated")
      .def_property_readonly("dimension", &S::dimension, "axes of the motion")
      .def_property_readonly(
          "start", [](const S& s) { return show_field(s.start()); }, InPython<Space>::naming.point)
      .def_property_readonly(
          "goal", [](const S& s) { return show_field(s.goal()); }, InPython<Space>::naming.point)
      .def("__repr__",
           [](const S& s) {
             return "<" + name + ": " + std::to_string(s.parts().size()) + " motions, " +
                    short_number(s.duration()) + " s>";
           })
      .def(py::pickle([](const S& s) { return to_json(dmp::Model(s)); },
                      [](const std::string& text) { return std::get<S>(from_json(text)); }));
  def_sequence_rollouts<Space>(sequence);
  m.def(
      "save", [](const S& model, const std::filesystem::path& path) { save(model, path.string()); },
      py::arg("model"), py::arg("path"));
  m.def("to_json", [](const S& model) { return to_json(model); }, py::arg("model"));
  py::class_<R> run(m, (name + "Run").c_str(), "One run of a sequence, for one control loop.");
  run.def(py::init<const S&>(), py::arg("sequence"))
      .def(
          "step", [](R& r, double dt) { return is_running(r.step(dt), dt); }, py::arg("dt"),
          "Moves on by dt seconds. True while the motion runs, False when it has finished.")
      .def(
          "set_goal",
          [](R& r, const typename InPython<Space>::Given& goal) {
            require_accepted(
                r.set_goal(InPython<Space>::to_point(goal, "goal")),
                std::string("goal: ") + InPython<Space>::naming.goal_refused + "; the old one stays.");
          },
          py::arg("goal"), "The goal of the last motion.")
      .def(
          "stretch",
          [](R& r, double factor) {
            require_accepted(r.stretch(factor), "factor: expected a positive number.");
          },
          py::arg("factor"), "All durations times `factor`, from now on.")
      .def_property_readonly("part", &R::part, "which motion is under way, from 0")
      .def_property_readonly("time", &R::time, "s since the start")
      .def_property_readonly(
          "phase", [](const R& r) { return r.current().phase(); }, "of that motion")
      .def_property_readonly(
          "state", [](R& r) { return CouplingState<Space>(r.state()); },
          "where the run is: point, velocity, phase and goal of the motion that is under way");
}

}  // namespace dmp::python
