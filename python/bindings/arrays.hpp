#pragma once
// numpy in, numpy out: shapes are checked here, once, with errors that name the argument.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>

namespace dmp::python {

namespace py = pybind11;

/// Anything numpy turns into float64. A type of its own, so that signatures read as array-likes.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// (n), or (1,) ... a scalar is refused; throws InvalidArgument naming `name`, the shape and what was
/// expected.
Eigen::VectorXd to_vector(const Array& array, const std::string& name);
/// (6)
Eigen::Matrix<double, 6, 1> to_vector6(const Array& array, const std::string& name);
/// (n x columns); a one-dimensional array of n values is taken as (n x 1) when columns is 1 or unknown (-1).
RowMatrix to_matrix(const Array& array, const std::string& name, Eigen::Index columns = -1);
/// (3, 3) or (4, 4)
Eigen::Matrix3d to_rotation(const Array& array, const std::string& name);
Eigen::Matrix4d to_pose(const Array& array, const std::string& name);
/// (T, 3, 3) or (T, 4, 4)
Rotations to_rotations(const Array& array, const std::string& name);
Poses to_poses(const Array& array, const std::string& name);

/// Owned, C-contiguous float64.
py::array_t<double> from_vector(const Eigen::VectorXd& vector);
py::array_t<double> from_matrix(const RowMatrix& matrix);
py::array_t<double> from_rotation(const Eigen::Matrix3d& rotation);
py::array_t<double> from_pose(const Eigen::Matrix4d& pose);
py::array_t<double> from_rotations(const Rotations& rotations);
py::array_t<double> from_poses(const Poses& poses);

/// What a property hands out: an array that refuses to be written to, because writing to it would change a
/// copy and nothing else. Of a point of a product a tuple of two.
py::array_t<double> shown(const Eigen::VectorXd& vector);
py::array_t<double> shown(const RowMatrix& matrix);
py::array_t<double> shown(const Eigen::Matrix3d& rotation);
py::array_t<double> shown(const Eigen::Matrix4d& pose);
py::array_t<double> shown(const Rotations& rotations);
py::array_t<double> shown(const Poses& poses);
template <class First, class Second>
py::tuple shown(const std::pair<First, Second>& point) {
  return py::make_tuple(shown(point.first), shown(point.second));
}

// The same for any field of parameters or of a state.
inline double show_field(double value) { return value; }
template <class Value>
auto show_field(const Value& value) {
  return shown(value);
}
template <int N>
auto show_field(const Eigen::Matrix<double, N, 1>& value) {
  return shown(Eigen::VectorXd(value));
}

}  // namespace dmp::python
