#include <dmp/orientation_dmp.hpp>

#include "bind.hpp"
#include "runs.hpp"

namespace dmp::python {
namespace {

std::optional<Eigen::Matrix3d> optional_rotation(const std::optional<Array>& array, const char* name) {
  if (!array) return std::nullopt;
  return to_rotation(*array, name);
}

void bind_run(py::module_& m) {
  using R = OrientationRun;
  py::class_<R> run(m, "OrientationRun", "One run of an OrientationDmp, for one control loop.");
  run.def(py::init<const OrientationDmp&>(), py::arg("dmp"));
  def_run(run);
  run.def_property_readonly(
         "rotation", [](const R& r) { return from_rotation(r.rotation()); }, "(3, 3) body -> world")
      .def_property_readonly(
          "angular_velocity", [](const R& r) { return from_vector(r.angular_velocity()); },
          "(3,) rad/s, world frame")
      .def_property_readonly(
          "angular_acceleration", [](const R& r) { return from_vector(r.angular_acceleration()); },
          "(3,) rad/s^2, world frame")
      .def_property(
          "goal", [](const R& r) { return from_rotation(r.goal()); },
          [](R& r, const Array& goal) {
            require_accepted(r.set_goal(to_rotation(goal, "goal")),
                             "goal: no rotation matrix; the old one stays.");
          },
          "(3, 3) the goal to go to from now on, approached through the goal filter")
      .def(
          "start_from",
          [](R& r, const Array& rotation, const Array& angular_velocity) {
            const Eigen::VectorXd omega = to_vector(angular_velocity, "angular_velocity");
            const bool fits = omega.size() == 3;
            require_accepted(
                fits ? r.start_from(to_rotation(rotation, "rotation"), omega) : Status::invalid_input,
                "start_from: no rotation, or an angular velocity that is not 3 finite numbers; nothing "
                "changed.");
          },
          py::arg("rotation"), py::arg("angular_velocity"),
          "Begins anew at rotation (3, 3) with angular velocity (3,) rad/s, world frame.");
}

}  // namespace

void bind_orientation_dmp(py::module_& m) {
  py::class_<OrientationDmp> dmp(m, "OrientationDmp",
                                 "A dynamic movement primitive for orientations on SO(3). Immutable.");
  def_model<OrientationDmp, OrientationDemonstration>(dmp);
  dmp.def_property_readonly(
         "start", [](const OrientationDmp& d) { return from_rotation(d.start()); }, "(3, 3)")
      .def_property_readonly(
          "goal", [](const OrientationDmp& d) { return from_rotation(d.goal()); }, "(3, 3)");
  def_rollout(dmp, &optional_rotation);
  bind_run(m);
}

}  // namespace dmp::python
