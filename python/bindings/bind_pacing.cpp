#include <pybind11/native_enum.h>
#include <pybind11/stl.h>
#include <dmp/error.hpp>
#include <dmp/pacing.hpp>

#include <cmath>
#include <string>

#include "arrays.hpp"
#include "bind_tempo.hpp"

namespace dmp::python {
namespace {

PacingLimits limits_of(const Array& velocity_limit, const Array& acceleration_limit,
                       const std::optional<Array>& effort_limit, const std::optional<Array>& jerk_limit,
                       double tool_speed_limit, double tempo_rate) {
  PacingLimits limits;
  limits.velocity = to_vector(velocity_limit, "velocity_limit");
  limits.acceleration = to_vector(acceleration_limit, "acceleration_limit");
  if (effort_limit) limits.effort = to_vector(*effort_limit, "effort_limit");
  if (jerk_limit) limits.jerk = to_vector(*jerk_limit, "jerk_limit");
  limits.tool_speed = tool_speed_limit;
  limits.tempo_rate = tempo_rate;
  return limits;
}

Paced slowed(const JointTrajectory& joints, const Array& velocity_limit, const Array& acceleration_limit,
             const std::optional<Array>& effort_limit, const std::optional<Array>& jerk_limit,
             double tool_speed_limit, double tempo_rate, const std::optional<Arm>& arm) {
  const PacingLimits limits =
      limits_of(velocity_limit, acceleration_limit, effort_limit, jerk_limit, tool_speed_limit, tempo_rate);
  const py::gil_scoped_release release;
  return arm ? paced(*arm, joints, limits) : paced(joints, limits);
}

Demand asked(const JointTrajectory& joints, const Array& velocity_limit, const Array& acceleration_limit,
             const std::optional<Array>& effort_limit, const std::optional<Array>& jerk_limit,
             double tool_speed_limit, const std::optional<Arm>& arm) {
  const PacingLimits limits =
      limits_of(velocity_limit, acceleration_limit, effort_limit, jerk_limit, tool_speed_limit, 1.0);
  const py::gil_scoped_release release;
  return arm ? largest_demand(*arm, joints, limits) : largest_demand(joints, limits);
}

/// Throws InvalidArgument unless the clock is one: times that rise, a slowdown above 0 (below 1 of what is
/// sped up), all of them finite.
Pace checked_pace(const Pace& pace) {
  const Eigen::Index count = pace.time.size();
  if (pace.slowdown.size() != count || pace.rate.size() != count)
    throw InvalidArgument("slowdown: " + std::to_string(pace.slowdown.size()) +
                          " and rate: " + std::to_string(pace.rate.size()) +
                          " numbers, expected one for each of " + std::to_string(count) + " times.");
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::string at = "[" + std::to_string(k) + "]: ";
    if (!std::isfinite(pace.time[k]) || (k > 0 && pace.time[k] <= pace.time[k - 1]))
      throw InvalidArgument("time" + at + std::to_string(pace.time[k]) +
                            ", expected finite times that rise.");
    if (!(pace.slowdown[k] > 0.0) || !std::isfinite(pace.slowdown[k]))
      throw InvalidArgument("slowdown" + at + std::to_string(pace.slowdown[k]) +
                            ", expected a number above 0.");
    if (!std::isfinite(pace.rate[k])) throw InvalidArgument("rate" + at + "expected a finite number.");
  }
  return pace;
}

py::tuple pace_state(const Pace& pace) {
  return py::make_tuple(from_vector(pace.time), from_vector(pace.slowdown), from_vector(pace.rate));
}

Pace pace_of_state(const py::tuple& state) {
  const auto values = [&](int i) { return to_vector(state[i].cast<Array>(), "state"); };
  return {values(0), values(1), values(2)};
}

void bind_values(py::module_& m) {
  py::native_enum<PacedLimit>(m, "PacedLimit", "enum.Enum", "What a motion is slowed down for.")
      .value("velocity", PacedLimit::velocity)
      .value("acceleration", PacedLimit::acceleration)
      .value("jerk", PacedLimit::jerk)
      .value("effort", PacedLimit::effort)
      .value("tool_speed", PacedLimit::tool_speed)
      .finalize();
  py::class_<Demand>(m, "Demand", "What a motion asks of its limits where it asks most.")
      .def_readonly("factor", &Demand::factor, "On the duration; below 1 the motion may be that much faster.")
      .def_readonly("limit", &Demand::limit)
      .def_readonly("joint", &Demand::joint, "-1 for the tool's speed, or if nothing moves.")
      .def_readonly("time", &Demand::time, "s, of the sample.");
  py::class_<Pace>(m, "Pace", "A clock: when a motion that was recorded at one time is carried out.")
      .def(py::init([](const Array& time, const Array& slowdown, const Array& rate) {
             return checked_pace(
                 {to_vector(time, "time"), to_vector(slowdown, "slowdown"), to_vector(rate, "rate")});
           }),
           py::arg("time"), py::arg("slowdown"), py::arg("rate"))
      .def_property_readonly(
          "time", [](const Pace& p) { return from_vector(p.time); }, "(T,) s, of each sample, carried out.")
      .def_property_readonly(
          "slowdown", [](const Pace& p) { return from_vector(p.slowdown); },
          "(T,) d time / d original time, >= 1.")
      .def_property_readonly(
          "rate", [](const Pace& p) { return from_vector(p.rate); },
          "(T,) 1/s, d ln slowdown / d original time.")
      .def(py::pickle(&pace_state, &pace_of_state));
  py::class_<Paced>(m, "Paced", "Joints at their original tempo wherever that is within the limits.")
      .def_readonly("joints", &Paced::joints)
      .def_readonly("pace", &Paced::pace);
}

}  // namespace

void bind_pacing(py::module_& m) {
  bind_values(m);
  const double none = std::numeric_limits<double>::infinity();
  m.def("paced", &slowed, py::arg("joints"), py::arg("velocity_limit"), py::arg("acceleration_limit"),
        py::arg("effort_limit") = py::none(), py::kw_only(), py::arg("jerk_limit") = py::none(),
        py::arg("tool_speed_limit") = none, py::arg("tempo_rate") = PacingLimits{}.tempo_rate,
        py::arg("arm") = py::none(),
        R"(The same joints, slower only where limits ask for it: elsewhere the original time is kept.

Velocity [rad/s], acceleration [rad/s^2] and jerk limits [rad/s^3], (n,) each, hold on the C2 spline that is returned;
effort limits (n,) [N m] at its samples and the tool's speed [m/s] between them, for both of which the arm is needed.
The logarithm of the slowdown changes by at most `tempo_rate` [1/s] in a second of the original time; the default is a
factor of 2 in 0.2 s. Never faster than the original, never longer than `stretched` by what the worst sample asks for.
Raises InvalidArgument for limits of other sizes or signs, or an effort with which the arm cannot stand still.)");
  m.def("largest_demand", &asked, py::arg("joints"), py::arg("velocity_limit"), py::arg("acceleration_limit"),
        py::arg("effort_limit") = py::none(), py::kw_only(), py::arg("jerk_limit") = py::none(),
        py::arg("tool_speed_limit") = none, py::arg("arm") = py::none(),
        "The joint, limit and time that ask for the longest duration; limits as in `paced`.");
  m.def("retimed", &retimed, py::arg("motion"), py::arg("pace"),
        "The same poses on another clock, with the velocities and accelerations that they have on it.");
}

}  // namespace dmp::python
