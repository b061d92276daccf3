#pragma once
// Many rollouts as one set of arrays, written by threads that hold no lock on the interpreter.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/batch.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "options.hpp"

namespace dmp::python {

/// An array (M, T, ...) whose m-th part is filled from one rollout.
class Stack {
 public:
  Stack(Eigen::Index count, Eigen::Index samples, const std::vector<py::ssize_t>& shape)
      : shape_{count, samples} {
    shape_.insert(shape_.end(), shape.begin(), shape.end());
    array_ = py::array_t<double>(shape_);
    for (std::size_t i = 1; i < shape_.size(); ++i) part_ *= shape_[i];
    data_ = array_.mutable_data();
  }
  const py::array_t<double>& array() const { return array_; }

  void put(Eigen::Index m, const Eigen::VectorXd& values) {
    std::copy_n(values.data(), part_, data_ + m * part_);
  }
  void put(Eigen::Index m, const RowMatrix& values) { std::copy_n(values.data(), part_, data_ + m * part_); }
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
  std::vector<py::ssize_t> shape_;
  py::array_t<double> array_;
  py::ssize_t part_ = 1;
  double* data_;
};

struct TrajectoryBatch {
  TrajectoryBatch(const Dmp& model, Eigen::Index count, Eigen::Index samples)
      : time(count, samples, {}),
        position(count, samples, {model.dimension()}),
        velocity(count, samples, {model.dimension()}),
        acceleration(count, samples, {model.dimension()}) {}
  void put(Eigen::Index m, const Trajectory& motion) {
    time.put(m, motion.time);
    position.put(m, motion.position);
    velocity.put(m, motion.velocity);
    acceleration.put(m, motion.acceleration);
  }
  Stack time, position, velocity, acceleration;
};

struct OrientationTrajectoryBatch {
  OrientationTrajectoryBatch(const OrientationDmp&, Eigen::Index count, Eigen::Index samples)
      : time(count, samples, {}),
        rotation(count, samples, {3, 3}),
        angular_velocity(count, samples, {3}),
        angular_acceleration(count, samples, {3}) {}
  void put(Eigen::Index m, const OrientationTrajectory& motion) {
    time.put(m, motion.time);
    rotation.put(m, motion.rotation);
    angular_velocity.put(m, motion.angular_velocity);
    angular_acceleration.put(m, motion.angular_acceleration);
  }
  Stack time, rotation, angular_velocity, angular_acceleration;
};

struct PoseTrajectoryBatch {
  PoseTrajectoryBatch(const PoseDmp&, Eigen::Index count, Eigen::Index samples)
      : time(count, samples, {}),
        pose(count, samples, {4, 4}),
        twist(count, samples, {6}),
        acceleration(count, samples, {6}) {}
  void put(Eigen::Index m, const PoseTrajectory& motion) {
    time.put(m, motion.time);
    pose.put(m, motion.pose);
    twist.put(m, motion.twist);
    acceleration.put(m, motion.acceleration);
  }
  Stack time, pose, twist, acceleration;
};

/// fit_each of a list of demonstrations, and of arrays (M, T, ...) on one time grid.
template <class Model, class Demonstration, class Values>
void def_fit_each(py::class_<Model>& model,
                  std::vector<Values> (*to_values)(const Array&, const std::string&), const char* values_name,
                  const char* doc) {
  model
      .def_static(
          "fit_each",
          [](const std::vector<Demonstration>& demonstrations, const std::optional<DmpOptions>& options,
             int threads, const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const py::gil_scoped_release release;
            return dmp::fit_each(demonstrations, chosen, threads);
          },
          py::arg("demonstrations"), py::arg("options") = py::none(), py::arg("threads") = 1,
          "One model for each demonstration, the same as fit gives. threads: how many to use, 0 for as many "
          "as the "
          "machine runs at once. Options as in fit.")
      .def_static(
          "fit_each",
          [to_values, values_name](const Array& times, const Array& values,
                                   const std::optional<DmpOptions>& options, int threads,
                                   const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const Eigen::VectorXd grid = to_vector(times, "times");
            const std::vector<Values> all = to_values(values, values_name);
            const py::gil_scoped_release release;
            return dmp::fit_each(grid, all, chosen, threads);
          },
          py::arg("times"), py::arg(values_name), py::arg("options") = py::none(), py::arg("threads") = 1,
          doc);
}

/// rollout_each: arrays (M, T, ...) of one motion for each goal and duration.
template <class Batch, class Motion, class Model, class Goals>
void def_rollout_each(py::class_<Model>& model, Goals (*to_goals)(const Array&, const std::string&)) {
  model.def(
      "rollout_each",
      [to_goals](const Model& d, const std::optional<Array>& goals, const std::optional<Array>& durations,
                 Eigen::Index samples, int threads) {
        const Goals targets = goals ? to_goals(*goals, "goals") : Goals{};
        const Eigen::VectorXd times = durations ? to_vector(*durations, "durations") : Eigen::VectorXd{};
        const Eigen::Index count = std::max(static_cast<Eigen::Index>(targets.size()), times.size());
        Batch batch(d, count, std::max<Eigen::Index>(samples, 0));
        const py::gil_scoped_release release;
        rollout_each(d, targets, times, samples,
                     Take<Motion>([&](Eigen::Index m, const Motion& motion) { batch.put(m, motion); }),
                     threads);
        return batch;
      },
      py::arg("goals") = py::none(), py::arg("durations") = py::none(), py::arg("samples") = 1001,
      py::arg("threads") = 1,
      "One motion for each of M goals (M, ...) and durations (M,) s, T = `samples` of each, evenly from 0 to "
      "its "
      "duration: the same as rollout(goal, duration, duration / (samples - 1)). Without goals, or without "
      "durations, the demonstrated one for all. threads: 0 for as many as the machine runs at once. Raises "
      "InvalidArgument, naming the motion, as rollout does.");
}

}  // namespace dmp::python
