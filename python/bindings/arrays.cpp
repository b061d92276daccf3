#include "arrays.hpp"

#include <dmp/error.hpp>

namespace dmp::python {
namespace {

std::string shape_of(const Array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

[[noreturn]] void refuse(const Array& array, const std::string& name, const std::string& expected) {
  throw InvalidArgument(name + ": an array of shape " + shape_of(array) + ", expected " + expected + ".");
}

void require_squares(const Array& array, const std::string& name, py::ssize_t size) {
  const std::string n = std::to_string(size);
  if (array.ndim() != 3 || array.shape(1) != size || array.shape(2) != size)
    refuse(array, name, "(T, " + n + ", " + n + ")");
}

template <int N>
Eigen::Matrix<double, N, N> square(const Array& array, const std::string& name) {
  const std::string n = std::to_string(N);
  if (array.ndim() != 2 || array.shape(0) != N || array.shape(1) != N)
    refuse(array, name, "(" + n + ", " + n + ")");
  return Eigen::Map<const Eigen::Matrix<double, N, N, Eigen::RowMajor>>(array.data());
}

template <int N>
std::vector<Eigen::Matrix<double, N, N>> squares(const Array& array, const std::string& name) {
  require_squares(array, name, N);
  std::vector<Eigen::Matrix<double, N, N>> result(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = Eigen::Map<const Eigen::Matrix<double, N, N, Eigen::RowMajor>>(array.data() + N * N * k);
  return result;
}

template <int N>
py::array_t<double> stack(const std::vector<Eigen::Matrix<double, N, N>>& matrices) {
  py::array_t<double> array({static_cast<py::ssize_t>(matrices.size()), py::ssize_t{N}, py::ssize_t{N}});
  for (std::size_t k = 0; k < matrices.size(); ++k)
    Eigen::Map<Eigen::Matrix<double, N, N, Eigen::RowMajor>>(array.mutable_data() + N * N * k) = matrices[k];
  return array;
}

template <int N>
py::array_t<double> copy_square(const Eigen::Matrix<double, N, N>& matrix) {
  py::array_t<double> array({py::ssize_t{N}, py::ssize_t{N}});
  Eigen::Map<Eigen::Matrix<double, N, N, Eigen::RowMajor>>(array.mutable_data()) = matrix;
  return array;
}

py::array_t<double> read_only(py::array_t<double> array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

}  // namespace

Eigen::VectorXd to_vector(const Array& array, const std::string& name) {
  if (array.ndim() != 1) refuse(array, name, "one dimension (n,)");
  return Eigen::Map<const Eigen::VectorXd>(array.data(), array.shape(0));
}

Eigen::Matrix<double, 6, 1> to_vector6(const Array& array, const std::string& name) {
  const Eigen::VectorXd values = to_vector(array, name);
  if (values.size() != 6) refuse(array, name, "(6,)");
  return values;
}

RowMatrix to_matrix(const Array& array, const std::string& name, Eigen::Index columns) {
  const std::string expected = "(T, " + (columns < 0 ? std::string("d") : std::to_string(columns)) + ")";
  if (array.ndim() == 1 && (columns == 1 || columns < 0))
    return Eigen::Map<const RowMatrix>(array.data(), array.shape(0), 1);
  if (array.ndim() != 2 || (columns >= 0 && array.shape(1) != columns)) refuse(array, name, expected);
  return Eigen::Map<const RowMatrix>(array.data(), array.shape(0), array.shape(1));
}

Eigen::Matrix3d to_rotation(const Array& array, const std::string& name) { return square<3>(array, name); }
Eigen::Matrix4d to_pose(const Array& array, const std::string& name) { return square<4>(array, name); }
Rotations to_rotations(const Array& array, const std::string& name) { return squares<3>(array, name); }
Poses to_poses(const Array& array, const std::string& name) { return squares<4>(array, name); }

py::array_t<double> from_vector(const Eigen::VectorXd& vector) {
  py::array_t<double> array(vector.size());
  Eigen::Map<Eigen::VectorXd>(array.mutable_data(), vector.size()) = vector;
  return array;
}

py::array_t<double> from_matrix(const RowMatrix& matrix) {
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  Eigen::Map<RowMatrix>(array.mutable_data(), matrix.rows(), matrix.cols()) = matrix;
  return array;
}

py::array_t<double> from_rotation(const Eigen::Matrix3d& rotation) { return copy_square<3>(rotation); }
py::array_t<double> from_pose(const Eigen::Matrix4d& pose) { return copy_square<4>(pose); }
py::array_t<double> from_rotations(const Rotations& rotations) { return stack<3>(rotations); }
py::array_t<double> from_poses(const Poses& poses) { return stack<4>(poses); }

py::array_t<double> shown(const Eigen::VectorXd& vector) { return read_only(from_vector(vector)); }
py::array_t<double> shown(const RowMatrix& matrix) { return read_only(from_matrix(matrix)); }
py::array_t<double> shown(const Eigen::Matrix3d& rotation) { return read_only(from_rotation(rotation)); }
py::array_t<double> shown(const Eigen::Matrix4d& pose) { return read_only(from_pose(pose)); }
py::array_t<double> shown(const Rotations& rotations) { return read_only(from_rotations(rotations)); }
py::array_t<double> shown(const Poses& poses) { return read_only(from_poses(poses)); }

}  // namespace dmp::python
