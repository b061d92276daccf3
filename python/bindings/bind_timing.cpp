#include <pybind11/stl.h>
#include <dmp/error.hpp>
#include <dmp/time_optimal.hpp>
#include <dmp/time_scaling.hpp>

#include "arrays.hpp"
#include "bind.hpp"

namespace dmp::python {
namespace {

Eigen::Vector3d to_gravity(const Array& gravity) {
  const Eigen::VectorXd g = to_vector(gravity, "gravity");
  if (g.size() != 3) throw InvalidArgument("gravity: " + std::to_string(g.size()) + " values, expected 3.");
  return g;
}

double factor(const JointTrajectory& joints, const Array& velocity_limit, const Array& acceleration_limit,
              const std::optional<Array>& effort_limit, const std::optional<Arm>& arm, const Array& gravity) {
  const Eigen::VectorXd velocity = to_vector(velocity_limit, "velocity_limit"),
                        acceleration = to_vector(acceleration_limit, "acceleration_limit");
  if (!effort_limit) return duration_factor(joints, velocity, acceleration);
  if (!arm) throw InvalidArgument("effort_limit: needs an arm; pass arm=.");
  return duration_factor(*arm, joints, velocity, acceleration, to_vector(*effort_limit, "effort_limit"),
                         to_gravity(gravity));
}

JointTrajectory timed(const JointTrajectory& joints, const Array& velocity_limit,
                      const Array& acceleration_limit, const std::optional<Array>& effort_limit,
                      const std::optional<Arm>& arm, const Array& gravity) {
  TimingLimits limits = {to_vector(velocity_limit, "velocity_limit"),
                         to_vector(acceleration_limit, "acceleration_limit"), std::nullopt};
  if (effort_limit) limits.effort = to_vector(*effort_limit, "effort_limit");
  const Eigen::Vector3d g = to_gravity(gravity);
  const py::gil_scoped_release release;
  if (arm) return time_optimal(*arm, joints, limits, g);
  return time_optimal(joints, limits);
}

}  // namespace

void bind_timing(py::module_& m) {
  m.def("duration_factor", &factor, py::arg("joints"), py::arg("velocity_limit"),
        py::arg("acceleration_limit"), py::arg("effort_limit") = py::none(), py::kw_only(),
        py::arg("arm") = py::none(), py::arg("gravity") = std::vector<double>{0.0, 0.0, -9.81},
        R"(The smallest factor on the duration with which the joints' spline stays within the limits.

Velocity [rad/s] and acceleration limits [rad/s^2], (n,) each, are looked at between the samples too; effort limits (n,)
[N m], for which the arm is needed, at the samples, by KDL's inverse dynamics with `gravity` (3,) [m/s^2] in the base
frame. 0 if nothing moves. Raises InvalidArgument for limits of other sizes or signs, or an effort with which the arm
cannot stand still.)");
  m.def("stretched", &stretched, py::arg("joints"), py::arg("factor"),
        "The same path, `factor` times as long from the same first time.");
  m.def("time_optimal", &timed, py::arg("joints"), py::arg("velocity_limit"), py::arg("acceleration_limit"),
        py::arg("effort_limit") = py::none(), py::kw_only(), py::arg("arm") = py::none(),
        py::arg("gravity") = std::vector<double>{0.0, 0.0, -9.81},
        R"(The same joints at other times: from rest to rest, close to as fast as the limits allow.

Velocity [rad/s] and acceleration limits [rad/s^2], (n,) each, hold everywhere on the C2 spline that is returned;
effort limits (n,) [N m], for which the arm is needed, at its samples, by KDL's inverse dynamics with `gravity` (3,)
[m/s^2] in the base frame. Reachability analysis (TOPP-RA: Pham and Pham, IEEE Trans. Robotics 34(3), 2018). Raises
InvalidArgument for limits of other sizes or signs, or an effort with which the arm cannot stand still.)");
}

}  // namespace dmp::python
