#include <pybind11/pybind11.h>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include "arrays.hpp"
#include "bind.hpp"

namespace dmp::python {
namespace {

Eigen::Vector3d to_vector3(const Array& array, const std::string& name) {
  const Eigen::VectorXd vector = to_vector(array, name);
  if (vector.size() != 3)
    throw InvalidArgument(name + ": " + std::to_string(vector.size()) + " numbers, expected 3.");
  if (!vector.allFinite()) throw InvalidArgument(name + ": not finite, expected 3 finite numbers.");
  return vector;
}

Eigen::Matrix3d to_proper_rotation(const Array& array, const std::string& name) {
  const Eigen::Matrix3d rotation = to_rotation(array, name);
  so3::require_rotation(rotation, name);
  return rotation;
}

}  // namespace

void bind_so3(py::module_& m) {
  py::module_ so3 = m.def_submodule("so3",
                                    "Rotations: SO(3), its exponential and logarithm, Euler angles. Matrices "
                                    "map body to world; angles in rad.");
  so3.def(
      "exp", [](const Array& v) { return from_rotation(so3::exp(to_vector3(v, "v"))); }, py::arg("v"),
      "The rotation (3, 3) by |v| rad about v (3,). Exact to rounding for every |v|.");
  so3.def(
      "log", [](const Array& r) { return from_vector(so3::log(to_proper_rotation(r, "r"))); }, py::arg("r"),
      "The rotation vector (3,) with exp(v) = r (3, 3) and |v| <= pi, exact to rounding, at pi too: there "
      "the sign "
      "with the first component that is not zero positive.");
  so3.def(
      "hat", [](const Array& v) { return from_rotation(so3::hat(to_vector3(v, "v"))); }, py::arg("v"),
      "[v]x (3, 3), the matrix with [v]x b = v x b.");
  so3.def(
      "left_jacobian", [](const Array& v) { return from_rotation(so3::left_jacobian(to_vector3(v, "v"))); },
      py::arg("v"), "J_l(v) (3, 3): omega = J_l(v) vd for R = exp(v), world frame.");
  so3.def(
      "distance",
      [](const Array& a, const Array& b) {
        return so3::distance(to_proper_rotation(a, "a"), to_proper_rotation(b, "b"));
      },
      py::arg("a"), py::arg("b"), "The angle in rad (0 to pi) of the rotation between a and b (3, 3).");
  so3.def(
      "from_euler",
      [](const Array& angles, const std::string& convention) {
        return from_rotation(so3::from_euler(to_vector3(angles, "angles"), convention));
      },
      py::arg("angles"), py::arg("convention"),
      "The rotation (3, 3) of three Euler angles (3,) in rad. `convention` names the axes in the order of "
      "the angles: "
      "upper case about the moving axes (\"ZYX\": Rz(a) Ry(b) Rx(c)), lower case about the fixed ones "
      "(\"xyz\": "
      "Rz(c) Ry(b) Rx(a)); \"source\" is the passive product Rz(a)^T Ry(b)^T Rx(c)^T of the thesis proposal "
      "of 2019.");
  so3.def(
      "to_euler",
      [](const Array& r, const std::string& convention) {
        return from_vector(so3::to_euler(to_proper_rotation(r, "r"), convention));
      },
      py::arg("r"), py::arg("convention"),
      "The inverse of from_euler: angles (3,) in rad, the middle one in [-pi/2, pi/2] (three axes) or [0, "
      "pi] (first "
      "axis repeated). At gimbal lock the third angle is 0.");
}

}  // namespace dmp::python
