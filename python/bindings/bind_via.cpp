#include "adaptation.hpp"
#include "bind.hpp"
#include "values.hpp"

namespace dmp::python {

void bind_via(py::module_& m) {
  py::class_<GivenVia>(m, "Via", "A point or pose that a motion passes at a phase.")
      .def(py::init([](double phase, const py::object& point, const std::optional<Array>& velocity,
                       const GivenReach& reach) { return GivenVia{phase, point, velocity, reach}; }),
           py::arg("phase"), py::arg("point"), py::arg("velocity") = py::none(), py::arg("reach") = 0.2,
           "phase: 0.01 to 0.99, 0.01 or more from the next one. point: as the model's goal. velocity (d,) "
           "per "
           "s: what the motion has there, unless it is left free. reach: the part of the phase within which "
           "the motion is changed, before and behind, or (before, behind).")
      .def_readonly("phase", &GivenVia::phase)
      .def_readonly("point", &GivenVia::point)
      .def_readonly("velocity", &GivenVia::velocity)
      .def_readonly("reach", &GivenVia::reach)
      .def("__repr__", [](const GivenVia& v) { return "<Via: at " + short_number(v.phase) + ">"; });
}

}  // namespace dmp::python
