#include "bind.hpp"
#include "distributions.hpp"

namespace dmp::python {

void bind_given(py::module_& m) {
  using G = GivenAt;
  py::class_<G>(m, "Given", "What is known of a motion at a phase, for the condition of a distribution.")
      .def(py::init([](double phase, const std::optional<py::object>& point,
                       const std::optional<Array>& velocity, const std::optional<Array>& covariance,
                       const std::optional<Array>& velocity_covariance,
                       const std::vector<Eigen::Index>& axes) {
             return G{phase, point, velocity, covariance, velocity_covariance, axes};
           }),
           py::arg("phase"), py::arg("point") = py::none(), py::arg("velocity") = py::none(),
           py::arg("covariance") = py::none(), py::arg("velocity_covariance") = py::none(),
           py::arg("axes") = py::tuple(),
           "phase: 0 to 1. point: as a model's goal; of poses a position (3,) too, whatever the rotation. "
           "velocity (d,) per s. covariance (d, d) of the point, velocity_covariance (d, d) of the velocity, "
           "of rotations about the axes of the world: known exactly unless given. axes: that are known, 0 to "
           "d - 1, positions first; all by default.")
      .def_readonly("phase", &G::phase)
      .def_readonly("point", &G::point)
      .def_readonly("velocity", &G::velocity)
      .def_readonly("covariance", &G::covariance)
      .def_readonly("velocity_covariance", &G::velocity_covariance)
      .def_readonly("axes", &G::axes)
      .def("__repr__", [](const G& g) { return "<Given: at " + short_number(g.phase) + ">"; });
  m.def(
      "damping_of",
      [](const Array& stiffness, double zeta) {
        return from_matrix(damping_of(to_matrix(stiffness, "stiffness"), zeta));
      },
      py::arg("stiffness"), py::arg("zeta") = 1.0,
      "2 zeta sqrt(K) of a symmetric positive definite stiffness (d, d), for unit masses.");
}

}  // namespace dmp::python
