#pragma once
// Motions over time, one and many, as sets of arrays; many are written by threads that hold no lock on the
// interpreter.

#include <pybind11/pybind11.h>
#include <dmp/product.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "spaces.hpp"
#include "values.hpp"

namespace dmp::python {

inline void read_into(RowMatrix& value, const Array& array) { value = to_matrix(array, "state"); }
inline void read_into(Rotations& value, const Array& array) { value = to_rotations(array, "state"); }
inline void read_into(Poses& value, const Array& array) { value = to_poses(array, "state"); }

/// A trajectory, its time in all parts.
inline void set_time(Trajectory& t, const Eigen::VectorXd& time) { t.time = time; }
inline void set_time(OrientationTrajectory& t, const Eigen::VectorXd& time) { t.time = time; }
inline void set_time(PoseTrajectory& t, const Eigen::VectorXd& time) { t.time = time; }
template <class A, class B>
void set_time(ProductTrajectory<A, B>& t, const Eigen::VectorXd& time) {
  t.time = time;
  set_time(t.first, time);
  set_time(t.second, time);
}

template <class Space>
py::tuple state_of(const typename Space::Trajectory& trajectory) {
  py::list arrays;
  arrays.append(from_vector(trajectory.time));
  InPython<Space>::columns(
      [&](const char*, auto of, const char*) { arrays.append(py::array_t<double>(shown(of(trajectory)))); });
  return py::tuple(arrays);
}

template <class Space>
typename Space::Trajectory with_state(const py::tuple& state) {
  typename Space::Trajectory trajectory;
  set_time(trajectory, to_vector(state[0].cast<Array>(), "state"));
  std::size_t next = 1;
  InPython<Space>::columns([&](const char*, auto of, const char*) {
    read_into(of(trajectory), state[next++].template cast<Array>());
  });
  return trajectory;
}

template <class Space>
py::class_<typename Space::Trajectory> bind_trajectory(py::module_& m) {
  using T = typename Space::Trajectory;
  const Naming& naming = InPython<Space>::naming;
  const std::string doc = std::string("A motion over time: what ") + naming.model + ".rollout returns.";
  py::class_<T> trajectory(m, naming.trajectory, doc.c_str());
  trajectory.def_property_readonly("time", [](const T& t) { return shown(t.time); }, "(T,) s");
  InPython<Space>::columns([&](const char* name, auto of, const char* shape) {
    trajectory.def_property_readonly(
        name, [of](const T& t) { return shown(of(t)); }, (std::string("(T, ") + shape).c_str());
  });
  return trajectory.def("__len__", [](const T& t) { return t.time.size(); })
      .def("__repr__",
           [](const T& t) {
             std::string what;
             if constexpr (std::is_same_v<Space, VectorSpace>)
               what = std::to_string(t.position.cols()) + " dimensions";
             return shown_samples(InPython<Space>::naming.trajectory, t.time, what);
           })
      .def(py::pickle(&state_of<Space>, &with_state<Space>));
}

/// What demonstrations of every kind have: their samples' times.
template <class D>
void def_samples(py::class_<D>& demonstration, const char* name) {
  demonstration.def_property_readonly(
                   "time", [](const D& d) { return shown(d.time()); }, "(T,) s, from 0")
      .def_property_readonly("duration", &D::duration, "s")
      .def("__repr__", [name](const D& d) { return shown_samples(name, d.time()); })
      .def("__len__", &D::size);
}

/// An array (M, T, ...) whose m-th part is filled from one rollout.
class Stack {
 public:
  /// (T, ...) of one of them.
  Stack(Eigen::Index count, Eigen::Index samples, const py::array_t<double>& one) {
    std::vector<py::ssize_t> shape{count, samples};
    shape.insert(shape.end(), one.shape() + 1, one.shape() + one.ndim());
    array_ = py::array_t<double>(shape);
    for (std::size_t i = 1; i < shape.size(); ++i) part_ *= shape[i];
    data_ = array_.mutable_data();
  }
  const py::array_t<double>& array() const { return array_; }

  template <class Derived>
  void put(Eigen::Index m, const Eigen::PlainObjectBase<Derived>& values) {
    std::copy_n(values.data(), part_, data_ + m * part_);
  }
  template <int N>
  void put(Eigen::Index m, const std::vector<Eigen::Matrix<double, N, N>>& values) {
    double* to = data_ + m * part_;
    for (const auto& value : values) {
      Eigen::Map<Eigen::Matrix<double, N, N, Eigen::RowMajor>> matrix(to);
      matrix = value;
      to += N * N;
    }
  }

 private:
  py::array_t<double> array_;
  py::ssize_t part_ = 1;
  double* data_;
};

/// Many motions of one model: a stack for the times and for each column.
template <class Space>
class Batch {
 public:
  Batch(const Primitive<Space>& model, Eigen::Index count, Eigen::Index samples)
      : time_(count, samples, py::array_t<double>(1)) {
    const auto one = model.rollout_at(Eigen::VectorXd::Zero(1));
    InPython<Space>::columns(
        [&](const char*, auto of, const char*) { columns_.emplace_back(count, samples, shown(of(one))); });
  }
  void put(Eigen::Index m, const typename Space::Trajectory& motion) {
    time_.put(m, motion.time);
    std::size_t next = 0;
    InPython<Space>::columns([&](const char*, auto of, const char*) { columns_[next++].put(m, of(motion)); });
  }
  const py::array_t<double>& time() const { return time_.array(); }
  const py::array_t<double>& column(std::size_t i) const { return columns_[i].array(); }

 private:
  Stack time_;
  std::vector<Stack> columns_;
};

template <class Space>
void bind_batch(py::module_& m) {
  using B = Batch<Space>;
  const Naming& naming = InPython<Space>::naming;
  const std::string name = std::string(naming.trajectory) + "Batch";
  const std::string doc = std::string("Many motions: what ") + naming.model + ".rollout_each returns.";
  py::class_<B> batch(m, name.c_str(), doc.c_str());
  batch.def("__len__", [](const B& b) { return b.time().shape(0); });
  batch.def_property_readonly("time", [](const B& b) { return b.time(); }, "(M, T) s");
  std::size_t next = 0;
  InPython<Space>::columns([&](const char* column, auto, const char* shape) {
    batch.def_property_readonly(
        column, [i = next++](const B& b) { return b.column(i); }, (std::string("(M, T, ") + shape).c_str());
  });
}

}  // namespace dmp::python
