#pragma once
// Via-points and joins as Python has them.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/error.hpp>
#include <dmp/status.hpp>
#include <dmp/stepper.hpp>
#include <dmp/via.hpp>

#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "spaces.hpp"

namespace dmp::python {

/// A part of the phase, or one before and one behind.
using GivenReach = std::variant<double, std::pair<double, double>>;

inline Reach to_reach(const GivenReach& given) {
  if (const double* both = std::get_if<double>(&given)) return *both;
  const auto& [rise, fall] = std::get<std::pair<double, double>>(given);
  return {rise, fall};
}

/// A via-point of any space.
struct GivenVia {
  double phase;
  py::object point;
  std::optional<Array> velocity;
  GivenReach reach;
};

/// A velocity of a space, of the size that its tangents have.
template <class Space>
typename Space::Tangent to_tangent(const Array& array, const std::string& name) {
  using Tangent = typename Space::Tangent;
  const Eigen::VectorXd given = to_vector(array, name);
  constexpr int kAxes = Tangent::RowsAtCompileTime;
  if (kAxes != Eigen::Dynamic && given.size() != kAxes)
    throw InvalidArgument(name + ": " + std::to_string(given.size()) + " numbers, expected " +
                          std::to_string(kAxes) + ".");
  return given;
}

template <class Space>
std::vector<Via<Space>> to_vias(const std::vector<GivenVia>& given) {
  using Point = typename InPython<Space>::Given;
  std::vector<Via<Space>> vias;
  for (std::size_t j = 0; j < given.size(); ++j) {
    const std::string name = "via[" + std::to_string(j) + "]";
    const auto point = [&] {
      try {
        return given[j].point.cast<Point>();
      } catch (const std::exception&) {  // of a cast, or of numpy
        throw InvalidArgument(name + ".point: of the wrong type, expected " + InPython<Space>::naming.point +
                              ".");
      }
    }();
    std::optional<typename Space::Tangent> velocity;
    if (given[j].velocity) velocity = to_tangent<Space>(*given[j].velocity, name + ".velocity");
    vias.push_back({given[j].phase, InPython<Space>::to_point(point, name + ".point"), velocity,
                    to_reach(given[j].reach)});
  }
  return vias;
}

/// What the loop says of a via-point: running or too_late; raises for what can never be one.
template <class Space>
Status via_status(Status status) {
  if (status == Status::invalid_input)
    throw InvalidArgument(std::string("via: expected a phase from 0.01 to 0.99, 0.01 or more from the other "
                                      "via-points and no more than 16 of them, a reach from 0.01 to 1, and a "
                                      "point that is ") +
                          InPython<Space>::naming.point + " and not " + InPython<Space>::naming.goal_refused +
                          ", with a finite velocity; nothing changed.");
  return status;
}

template <class Run>
void join(Run& run, Run next, const GivenReach& reach) {
  if (run.join(next, to_reach(reach)) == Status::invalid_input)
    throw InvalidArgument(
        "join: a motion of another dimension, a run that is paused or not finite, or a reach "
        "that is not from 0.01 to 1; nothing changed.");
}

template <class Space, class Class>
void def_adaptation(Class& run) {
  using Run = typename Class::type;
  using Given = typename InPython<Space>::Given;
  using Model = Primitive<Space>;
  run.def(
         "via",
         [](Run& r, double phase, const Given& point, const std::optional<Array>& velocity,
            const GivenReach& reach) {
           const auto place = InPython<Space>::to_point(point, "point");
           const Status status =
               velocity ? r.via(phase, place, to_tangent<Space>(*velocity, "velocity"), to_reach(reach))
                        : r.via(phase, place, to_reach(reach));
           return via_status<Space>(status);
         },
         py::arg("phase"), py::arg("point"), py::arg("velocity") = py::none(), py::arg("reach") = 0.2,
         "Passes `point` (shaped as the property goal) at a phase that lies ahead, 0.01 to 0.99, and changes "
         "the motion within `reach` only, a part of the phase or one before and one behind: exactly, "
         "whatever "
         "happens to goal, duration or point until then. With `velocity` (d,) per s it has that there. "
         "Returns "
         "Status.running, or Status.too_late where less than 0.01 is left until there; raises "
         "InvalidArgument "
         "for what can be no via-point.")
      .def(
          "move_via",
          [](Run& r, double phase, const Given& point) {
            const Status status = r.move_via(phase, InPython<Space>::to_point(point, "point"));
            if (status == Status::invalid_input)
              throw InvalidArgument("move_via: no via-point was set at this phase, or the point is " +
                                    std::string(InPython<Space>::naming.goal_refused) + "; nothing changed.");
            return status;
          },
          py::arg("phase"), py::arg("point"),
          "The via-point that was set at `phase` has moved. Returns Status.running, or Status.too_late where "
          "it lies behind.")
      .def("clear_vias", &Run::clear_vias,
           "Forgets all via-points; what is under way fades within its reach.")
      .def(
          "ahead",
          [](Run& r, double phase) {
            if (!(phase >= r.phase() && phase <= std::max(1.0, r.phase())))
              throw InvalidArgument("phase: " + std::to_string(phase) +
                                    ", expected one from where the run is (" + std::to_string(r.phase()) +
                                    ") to the end (1).");
            return CouplingState<Space>(r.ahead(phase));
          },
          py::arg("phase"),
          "Where the run will be at a phase from now to 1 if nothing changes until then, via-points "
          "included; "
          "speed and velocity at the duration that is set.")
      .def_property_readonly(
          "state", [](Run& r) { return CouplingState<Space>(r.state()); },
          "where the run is: phase, speed, point, velocity and goal")
      .def(
          "start_from",
          [](Run& r, const Given& point, const Array& velocity, const GivenReach& reach) {
            const auto start = InPython<Space>::to_point(point, InPython<Space>::naming.start_point);
            const auto rate = to_tangent<Space>(velocity, InPython<Space>::naming.start_velocity);
            if (r.start_from(start, rate, to_reach(reach)) == Status::invalid_input)
              throw InvalidArgument(
                  "start_from: the point is " + std::string(InPython<Space>::naming.goal_refused) +
                  ", the velocity is not finite, the reach is not from 0.01 to 1, or the run "
                  "is paused; nothing changed.");
          },
          py::arg(InPython<Space>::naming.start_point), py::arg(InPython<Space>::naming.start_velocity),
          py::arg("reach"),
          "Begins anew, from any point and velocity with no acceleration, and comes onto the learned motion "
          "within `reach`, a part of the phase: nothing jumps, and behind it nothing is changed.")
      .def(
          "join", [](Run& r, const Model& next, const GivenReach& reach) { join(r, Run(next), reach); },
          py::arg("next"), py::arg("reach") = 0.2,
          "Goes on with another motion from the present state: a model, or a run of one that stands where it "
          "shall begin, with its goal, duration and via-points set. Position, velocity and acceleration do "
          "not "
          "jump; what lies between the two motions fades within `reach`, a part of the phase of `next`.")
      .def(
          "join", [](Run& r, const Run& next, const GivenReach& reach) { join(r, Run(next), reach); },
          py::arg("next"), py::arg("reach") = 0.2);
}

}  // namespace dmp::python
