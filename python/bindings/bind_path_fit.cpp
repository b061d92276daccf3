#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <dmp/path_fit.hpp>
#include <dmp/reach_speed.hpp>
#include <dmp/tip_motion.hpp>

#include "arrays.hpp"
#include "bind_tempo.hpp"

namespace dmp::python {
namespace {

std::optional<Eigen::VectorXd> values_of(const std::optional<Array>& array, const std::string& name) {
  if (!array) return std::nullopt;
  return to_vector(*array, name);
}

// What was asked raises in Python only after the fit, which holds no lock on the interpreter.
std::function<bool(const JointTrajectory&)> asker_of(const py::object& accept) {
  if (accept.is_none()) return {};
  return [&accept](const JointTrajectory& joints) {
    const py::gil_scoped_acquire acquire;
    return accept(joints).cast<bool>();
  };
}

PathFit fitted(const Arm& arm, const Array& times, const Array& poses, const Array& start,
               double position_tolerance, double angle_tolerance, const std::optional<Array>& weight,
               const std::optional<Array>& velocity_limit, const std::optional<Array>& acceleration_limit,
               const std::optional<Array>& effort_limit, const std::optional<Array>& slowdown,
               const std::optional<Array>& slowdown_rate, bool free_placement, double floor, double target,
               int iterations, int spline_coefficients, const py::object& accept) {
  PathFitOptions options;
  options.position_tolerance = position_tolerance;
  options.angle_tolerance = angle_tolerance;
  if (weight) options.weight = to_vector6(*weight, "weight");
  options.velocity = values_of(velocity_limit, "velocity_limit");
  options.acceleration = values_of(acceleration_limit, "acceleration_limit");
  options.effort = values_of(effort_limit, "effort_limit");
  options.slowdown = values_of(slowdown, "slowdown");
  options.slowdown_rate = values_of(slowdown_rate, "slowdown_rate");
  options.free_placement = free_placement;
  options.floor = floor;
  options.target = target;
  options.iterations = iterations;
  options.spline_coefficients = spline_coefficients;
  options.accept = asker_of(accept);
  const Eigen::VectorXd seconds = to_vector(times, "times");
  const Poses path = to_poses(poses, "poses");
  const RowMatrix joints = to_matrix(start, "start", arm.joint_count());
  const py::gil_scoped_release release;
  return fit_path(arm, seconds, path, joints, options);
}

}  // namespace

void bind_path_fit(py::module_& m) {
  py::class_<PathFit>(m, "PathFit", "What `fit_path` found.")
      .def_readonly("joints", &PathFit::joints, "At the times of the path.")
      .def_readonly("improved", &PathFit::improved, "False where the joints are those of the start.")
      .def_readonly("duration_factor", &PathFit::duration_factor, "That the limits ask for.")
      .def_readonly("start_factor", &PathFit::start_factor, "The same of the start.")
      .def_readonly("position_max", &PathFit::position_max, "m from the path, between its samples too.")
      .def_readonly("position_rms", &PathFit::position_rms, "m")
      .def_readonly("angle_max", &PathFit::angle_max, "rad")
      .def_readonly("angle_rms", &PathFit::angle_rms, "rad")
      .def_readonly("limit_margin", &PathFit::limit_margin, "rad or m, the smallest distance from a limit.")
      .def_property_readonly(
          "base_change", [](const PathFit& f) { return from_pose(f.base_change); },
          "(4, 4): the path as placed is base_change @ pose @ tool_change.")
      .def_property_readonly(
          "tool_change", [](const PathFit& f) { return from_pose(f.tool_change); }, "(4, 4)")
      .def_readonly("iterations", &PathFit::iterations, "Steps that were spent.");
  m.def(
      "fastest_tip",
      [](const Arm& arm) {
        const py::gil_scoped_release release;
        const TipSpeed speed = fastest_tip(arm);
        return std::pair(speed.linear, speed.angular);
      },
      py::arg("arm"),
      R"((m/s, rad/s) that the arm's tip can move and turn at most, in any posture within the joint limits.

Every joint within its velocity limit; infinity where one has none. Exact over the joint velocities, and over postures
what a search of 20 000 random ones found: no motion that is followed exactly can be faster.)");
  m.def("tip_motion", &tip_motion, py::arg("arm"), py::arg("joints"),
        "How the arm's tip moves with its joints, as a PoseTrajectory in the base frame, by KDL.");
  const PathFitOptions usual;
  m.def("fit_path", &fitted, py::arg("arm"), py::arg("times"), py::arg("poses"), py::arg("start"),
        py::kw_only(), py::arg("position_tolerance") = usual.position_tolerance,
        py::arg("angle_tolerance") = usual.angle_tolerance, py::arg("weight") = py::none(),
        py::arg("velocity_limit") = py::none(), py::arg("acceleration_limit") = py::none(),
        py::arg("effort_limit") = py::none(), py::arg("slowdown") = py::none(),
        py::arg("slowdown_rate") = py::none(), py::arg("free_placement") = false,
        py::arg("floor") = usual.floor, py::arg("target") = usual.target,
        py::arg("iterations") = usual.iterations, py::arg("spline_coefficients") = 0,
        py::arg("accept") = py::none(),
        R"(Joints that follow a path faster, each pose within a tolerance.

`times` (T,) s, `poses` (T, 4, 4) of the tip in the base frame, `start` (T, n) joints that follow them. The deviation of
any sample, and between them, is at most `position_tolerance` [m] and `angle_tolerance` [rad] in the directions whose
`weight` (6,) is above 0 (as in IkOptions). Velocity and acceleration limits, (n,) each, are the arm's unless given;
effort limits (n,) [N m] are looked at where given, by Arm.inverse_dynamics. With `free_placement` the path may also be
moved (not below `floor` [m]), turned about z of the base, and the tool turned. The search ends at a duration factor of
`target` or after `iterations` steps; `slowdown` and `slowdown_rate` (T,) are a Pace on which the limits are held.
`accept`, called with a JointTrajectory, has a last word. Never slower than the start, the same arguments give the same
joints. Raises InvalidArgument for arguments of other sizes or out of range.)");
}

}  // namespace dmp::python
