#include <dmp/error.hpp>

#include "batches.hpp"
#include "bind.hpp"

namespace dmp::python {
namespace {

/// (M, T, N, N) as M lists of matrices, or (M, T, d) as M tables.
template <class Values, class Read>
std::vector<Values> parts_of(const Array& array, const std::string& name, py::ssize_t dimensions,
                             const char* expected, Read read) {
  if (array.ndim() != dimensions)
    throw InvalidArgument(name + ": " + std::to_string(array.ndim()) + " dimensions, expected " + expected +
                          ".");
  std::vector<Values> parts;
  const std::vector<py::ssize_t> shape(array.shape() + 1, array.shape() + dimensions);
  for (py::ssize_t j = 0; j < array.shape(0); ++j)
    parts.push_back(read(Array(shape, array.data(j), array), name + "[" + std::to_string(j) + "]"));
  return parts;
}

std::vector<RowMatrix> to_tables(const Array& array, const std::string& name) {
  return parts_of<RowMatrix>(array, name, 3, "3: (M, T, d)",
                             [](const Array& part, const std::string& of) { return to_matrix(part, of); });
}
std::vector<Rotations> to_rotation_paths(const Array& array, const std::string& name) {
  return parts_of<Rotations>(array, name, 4, "4: (M, T, 3, 3)", &to_rotations);
}
std::vector<Poses> to_pose_paths(const Array& array, const std::string& name) {
  return parts_of<Poses>(array, name, 4, "4: (M, T, 4, 4)", &to_poses);
}
std::vector<Eigen::VectorXd> to_goals(const Array& array, const std::string& name) {
  const RowMatrix rows = to_matrix(array, name);
  std::vector<Eigen::VectorXd> goals;
  for (Eigen::Index m = 0; m < rows.rows(); ++m) goals.push_back(rows.row(m));
  return goals;
}

/// A stack as a property.
template <class Batch>
void def_stack(py::class_<Batch>& batch, const char* name, Stack Batch::* stack, const char* doc) {
  batch.def_property_readonly(name, [stack](const Batch& b) { return (b.*stack).array(); }, doc);
}

template <class Batch>
py::class_<Batch> batch_class(py::module_& m, const char* name, const char* doc) {
  py::class_<Batch> batch(m, name, doc);
  batch.def("__len__", [](const Batch& b) { return b.time.array().shape(0); });
  def_stack(batch, "time", &Batch::time, "(M, T) s");
  return batch;
}

}  // namespace

void bind_batch(py::module_& m) {
  using T = TrajectoryBatch;
  auto positions = batch_class<T>(m, "TrajectoryBatch", "Many motions: what Dmp.rollout_each returns.");
  def_stack(positions, "position", &T::position, "(M, T, d)");
  def_stack(positions, "velocity", &T::velocity, "(M, T, d) per s");
  def_stack(positions, "acceleration", &T::acceleration, "(M, T, d) per s^2");

  using O = OrientationTrajectoryBatch;
  auto orientations = batch_class<O>(m, "OrientationTrajectoryBatch",
                                     "Many motions: what OrientationDmp.rollout_each returns.");
  def_stack(orientations, "rotation", &O::rotation, "(M, T, 3, 3) body -> world");
  def_stack(orientations, "angular_velocity", &O::angular_velocity, "(M, T, 3) rad/s, world frame");
  def_stack(orientations, "angular_acceleration", &O::angular_acceleration, "(M, T, 3) rad/s^2, world frame");

  using P = PoseTrajectoryBatch;
  auto poses = batch_class<P>(m, "PoseTrajectoryBatch", "Many motions: what PoseDmp.rollout_each returns.");
  def_stack(poses, "pose", &P::pose, "(M, T, 4, 4) [R p; 0 1], body -> world");
  def_stack(poses, "twist", &P::twist,
            "(M, T, 6) linear velocity of the origin [m/s], angular velocity [rad/s], world frame");
  def_stack(poses, "acceleration", &P::acceleration, "(M, T, 6) the twist's rate, m/s^2 and rad/s^2");

  auto dmp = py::class_<Dmp>(m.attr("Dmp"));
  auto orientation_dmp = py::class_<OrientationDmp>(m.attr("OrientationDmp"));
  auto pose_dmp = py::class_<PoseDmp>(m.attr("PoseDmp"));
  def_fit_each<Dmp, Demonstration>(dmp, &to_tables, "positions",
                                   "The same for positions (M, T, d) on one time grid, times (T,) s.");
  def_fit_each<OrientationDmp, OrientationDemonstration>(
      orientation_dmp, &to_rotation_paths, "rotations",
      "The same for rotations (M, T, 3, 3) on one time grid, times (T,) s.");
  def_fit_each<PoseDmp, PoseDemonstration>(pose_dmp, &to_pose_paths, "poses",
                                           "The same for poses (M, T, 4, 4) on one time grid, times (T,) s.");
  def_rollout_each<T, Trajectory>(dmp, &to_goals);
  def_rollout_each<O, OrientationTrajectory>(orientation_dmp, &to_rotations);
  def_rollout_each<P, PoseTrajectory>(pose_dmp, &to_poses);
}

}  // namespace dmp::python
