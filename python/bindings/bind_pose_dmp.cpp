#include <dmp/pose_dmp.hpp>

#include "bind.hpp"
#include "runs.hpp"

namespace dmp::python {
namespace {

std::optional<Eigen::Matrix4d> optional_pose(const std::optional<Array>& array, const char* name) {
  if (!array) return std::nullopt;
  return to_pose(*array, name);
}

void bind_run(py::module_& m) {
  using R = PoseRun;
  py::class_<R> run(m, "PoseRun", "One run of a PoseDmp, for one control loop.");
  run.def(py::init<const PoseDmp&>(), py::arg("dmp"));
  def_run(run);
  run.def_property_readonly(
         "pose", [](const R& r) { return from_pose(r.pose()); }, "(4, 4) [R p; 0 1]")
      .def_property_readonly(
          "position", [](const R& r) { return from_vector(r.position()); }, "(3,) m")
      .def_property_readonly(
          "rotation", [](const R& r) { return from_rotation(r.rotation()); }, "(3, 3)")
      .def_property_readonly(
          "twist", [](const R& r) { return from_vector(r.twist()); },
          "(6,) linear velocity of the origin [m/s], angular velocity [rad/s], world frame")
      .def_property_readonly(
          "acceleration", [](const R& r) { return from_vector(r.acceleration()); },
          "(6,) m/s^2, rad/s^2, world frame")
      .def_property(
          "goal", [](const R& r) { return from_pose(r.goal()); },
          [](R& r, const Array& goal) {
            require_accepted(r.set_goal(to_pose(goal, "goal")),
                             "goal: not [R p; 0 1] with a rotation R; the old one stays.");
          },
          "(4, 4) the goal to go to from now on, approached through the goal filter")
      .def(
          "start_from",
          [](R& r, const Array& pose, const Array& twist) {
            const Eigen::VectorXd velocity = to_vector(twist, "twist");
            const bool fits = velocity.size() == 6;
            require_accepted(
                fits ? r.start_from(to_pose(pose, "pose"), velocity) : Status::invalid_input,
                "start_from: no pose, or a twist that is not 6 finite numbers; nothing changed.");
          },
          py::arg("pose"), py::arg("twist"), "Begins anew at pose (4, 4) with twist (6,) m/s, rad/s.");
}

}  // namespace

void bind_pose_dmp(py::module_& m) {
  py::class_<PoseDmp> dmp(
      m, "PoseDmp",
      "A dynamic movement primitive for poses [R p; 0 1], position and orientation in one phase. Immutable.");
  def_model<PoseDmp, PoseDemonstration>(dmp);
  dmp.def_property_readonly(
         "start", [](const PoseDmp& d) { return from_pose(d.start()); }, "(4, 4)")
      .def_property_readonly("goal", [](const PoseDmp& d) { return from_pose(d.goal()); }, "(4, 4)");
  def_rollout(dmp, &optional_pose);
  bind_run(m);
}

}  // namespace dmp::python
