#include <pybind11/native_enum.h>
#include <dmp/dmp.hpp>

#include "bind.hpp"
#include "runs.hpp"

namespace dmp::python {
namespace {

std::optional<Eigen::VectorXd> optional_vector(const std::optional<Array>& array, const char* name) {
  if (!array) return std::nullopt;
  return to_vector(*array, name);
}

void bind_run(py::module_& m) {
  py::class_<Run> run(m, "Run", "One run of a Dmp, for one control loop.");
  run.def(py::init<const Dmp&>(), py::arg("dmp"));
  def_run(run);
  run.def_property_readonly(
         "position", [](const Run& r) { return from_vector(r.position()); }, "(d,)")
      .def_property_readonly(
          "velocity", [](const Run& r) { return from_vector(r.velocity()); }, "(d,) per s")
      .def_property_readonly(
          "acceleration", [](const Run& r) { return from_vector(r.acceleration()); }, "(d,) per s^2")
      .def_property(
          "goal", [](const Run& r) { return from_vector(r.goal()); },
          [](Run& r, const Array& goal) {
            require_accepted(r.set_goal(to_vector(goal, "goal")),
                             "goal: wrong size or not finite; the old one stays.");
          },
          "(d,) the goal to go to from now on, approached through the goal filter")
      .def(
          "start_from",
          [](Run& r, const Array& position, const Array& velocity) {
            require_accepted(
                r.start_from(to_vector(position, "position"), to_vector(velocity, "velocity")),
                "start_from: position or velocity of the wrong size or not finite; nothing changed.");
          },
          py::arg("position"), py::arg("velocity"), "Begins anew at position (d,) with velocity (d,) per s.");
}

}  // namespace

void bind_dmp(py::module_& m) {
  py::native_enum<Status>(m, "Status", "enum.Enum", "What a call inside the control loop says.")
      .value("running", Status::running)
      .value("finished", Status::finished)
      .value("invalid_input", Status::invalid_input)
      .value("not_finite", Status::not_finite)
      .finalize();
  py::class_<Dmp> dmp(m, "Dmp", "A dynamic movement primitive for positions in R^d. Immutable.");
  def_model<Dmp, Demonstration>(dmp);
  dmp.def_property_readonly("dimension", &Dmp::dimension)
      .def_property_readonly(
          "start", [](const Dmp& d) { return from_vector(d.start()); }, "(d,)")
      .def_property_readonly("goal", [](const Dmp& d) { return from_vector(d.goal()); }, "(d,)");
  def_rollout(dmp, &optional_vector);
  bind_run(m);
}

}  // namespace dmp::python
