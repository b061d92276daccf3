#include <dmp/cycle.hpp>

#include "arrays.hpp"
#include "bind.hpp"
#include "values.hpp"

namespace dmp::python {
namespace {

template <class Demonstrated>
void bind(py::module_& m, const char* name) {
  using C = Cycle<Demonstrated>;
  py::class_<C>(m, name, "One cycle of a recorded motion, and how it was found.")
      .def_readonly("demonstration", &C::demonstration,
                    "201 samples, the last one the first again: what motion=\"rhythmic\" learns from")
      .def_property_readonly(
          "period", [](const C& c) { return c.report.period; }, "s, the mean of the cycles")
      .def_property_readonly(
          "begins", [](const C& c) { return c.report.begins; },
          "s from the start of the recording: what lies before differs from what follows")
      .def_property_readonly(
          "ends", [](const C& c) { return c.report.ends; }, "s, likewise behind")
      .def_property_readonly(
          "lengths", [](const C& c) { return shown(c.report.lengths); }, "s, of each whole cycle")
      .def_property_readonly(
          "unexplained", [](const C& c) { return c.report.unexplained; },
          "RMS that the cycle leaves of the motion about its middle, a share of it")
      .def("__repr__", [name = std::string(name)](const C& c) {
        return "<" + name + ": " + std::to_string(c.report.lengths.size()) + " cycles of " +
               short_number(c.report.period) + " s>";
      });
  m.def(
      "find_cycle",
      [](const Demonstrated& recording, double minimum_period, int harmonics) {
        const py::gil_scoped_release release;
        return find_cycle(recording, {minimum_period, harmonics});
      },
      py::arg("recording"), py::arg("minimum_period") = 0.0, py::arg("harmonics") = 8,
      "Finds the period of a recording that repeats, the parts at its ends that do not, and the one cycle "
      "that "
      "all of them are, each at its own tempo. `minimum_period` (s): half the true period may pass for it "
      "where "
      "a motion is the same on its way there and back. `harmonics` of the cycle, 1 to 40. Raises "
      "InvalidArgument for a recording without a period or of fewer than two cycles.");
}

}  // namespace

void bind_cycle(py::module_& m) {
  bind<Demonstration>(m, "Cycle");
  bind<OrientationDemonstration>(m, "OrientationCycle");
  bind<PoseDemonstration>(m, "PoseCycle");
}

}  // namespace dmp::python
