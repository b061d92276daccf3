#pragma once
// What each space is called in Python, and how its points, paths and trajectories look as arrays. A new space
// says this in a file of its own (bind_pose_gripper_space.cpp); everything else is written once.

#include <pybind11/pybind11.h>
#include <dmp/dmp.hpp>
#include <dmp/error.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"

namespace dmp::python {

/// Names and sentences of a space.
struct Naming {
  const char* model;
  const char* run;
  const char* trajectory;
  const char* run_state;
  const char* parameters;
  const char* moves;         ///< "positions in R^d"
  const char* point;         ///< shape of a point
  const char* goal_refused;  ///< what is wrong with one that a run refuses
  const char* start_point;   ///< arguments of start_from
  const char* start_velocity;
  const char* start_doc;
  const char* paths;  ///< argument of fit_each on one time grid
  const char* paths_shape;
};

/// `naming`; `distribution`, the name of that class; Given, what Python passes for a point; to_point,
/// to_paths, to_goals; and the columns of a trajectory: visit(name, member, doc) with the doc of shape (T,
/// ...).
template <class Space>
struct InPython;

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

template <>
struct InPython<VectorSpace> {
  static constexpr Naming naming{"Dmp",
                                 "Run",
                                 "Trajectory",
                                 "RunState",
                                 "DmpParameters",
                                 "positions in R^d",
                                 "(d,)",
                                 "wrong size or not finite",
                                 "position",
                                 "velocity",
                                 "Begins anew at position (d,) with velocity (d,) per s.",
                                 "positions",
                                 "(M, T, d)"};
  static constexpr const char* distribution = "DmpDistribution";
  using Given = Array;
  static Eigen::VectorXd to_point(const Array& array, const std::string& name) {
    return to_vector(array, name);
  }
  static std::vector<RowMatrix> to_paths(const Array& array, const std::string& name) {
    return parts_of<RowMatrix>(array, name, 3, "3: (M, T, d)",
                               [](const Array& part, const std::string& of) { return to_matrix(part, of); });
  }
  static std::vector<Eigen::VectorXd> to_goals(const Array& array, const std::string& name) {
    const RowMatrix rows = to_matrix(array, name);
    std::vector<Eigen::VectorXd> goals;
    for (Eigen::Index m = 0; m < rows.rows(); ++m) goals.push_back(rows.row(m));
    return goals;
  }
  template <class Visit>
  static void columns(const Visit& visit,
                      std::array<const char*, 3> names = {"position", "velocity", "acceleration"}) {
    visit(names[0], [](auto& t) -> auto& { return t.position; }, "d)");
    visit(names[1], [](auto& t) -> auto& { return t.velocity; }, "d) per s");
    visit(names[2], [](auto& t) -> auto& { return t.acceleration; }, "d) per s^2");
  }
  template <class Class>
  static void outputs(Class& run) {
    run.def_property_readonly(
           "position", [](const Run& r) { return shown(r.position()); }, "(d,)")
        .def_property_readonly(
            "velocity", [](const Run& r) { return shown(r.velocity()); }, "(d,) per s")
        .def_property_readonly(
            "acceleration", [](const Run& r) { return shown(r.acceleration()); }, "(d,) per s^2");
  }
};

template <>
struct InPython<RotationSpace> {
  static constexpr Naming naming{
      "OrientationDmp",
      "OrientationRun",
      "OrientationTrajectory",
      "OrientationRunState",
      "OrientationDmpParameters",
      "orientations on SO(3)",
      "(3, 3)",
      "no rotation matrix",
      "rotation",
      "angular_velocity",
      "Begins anew at rotation (3, 3) with angular velocity (3,) rad/s, world frame.",
      "rotations",
      "(M, T, 3, 3)"};
  static constexpr const char* distribution = "OrientationDistribution";
  using Given = Array;
  static Eigen::Matrix3d to_point(const Array& array, const std::string& name) {
    return to_rotation(array, name);
  }
  static std::vector<Rotations> to_paths(const Array& array, const std::string& name) {
    return parts_of<Rotations>(array, name, 4, "4: (M, T, 3, 3)", &to_rotations);
  }
  static Rotations to_goals(const Array& array, const std::string& name) { return to_rotations(array, name); }
  template <class Visit>
  static void columns(const Visit& visit) {
    visit("rotation", [](auto& t) -> auto& { return t.rotation; }, "3, 3) body -> world");
    visit("angular_velocity", [](auto& t) -> auto& { return t.angular_velocity; }, "3) rad/s, world frame");
    visit(
        "angular_acceleration", [](auto& t) -> auto& { return t.angular_acceleration; },
        "3) rad/s^2, world frame");
  }
  template <class Class>
  static void outputs(Class& run) {
    using R = OrientationRun;
    run.def_property_readonly(
           "rotation", [](const R& r) { return shown(r.rotation()); }, "(3, 3) body -> world")
        .def_property_readonly(
            "angular_velocity", [](const R& r) { return shown(Eigen::VectorXd(r.angular_velocity())); },
            "(3,) rad/s, world frame")
        .def_property_readonly(
            "angular_acceleration",
            [](const R& r) { return shown(Eigen::VectorXd(r.angular_acceleration())); },
            "(3,) rad/s^2, world frame");
  }
};

template <>
struct InPython<PoseSpace> {
  static constexpr Naming naming{"PoseDmp",
                                 "PoseRun",
                                 "PoseTrajectory",
                                 "PoseRunState",
                                 "PoseDmpParameters",
                                 "poses [R p; 0 1], position and orientation in one phase",
                                 "(4, 4)",
                                 "not [R p; 0 1] with a rotation R",
                                 "pose",
                                 "twist",
                                 "Begins anew at pose (4, 4) with twist (6,) m/s, rad/s.",
                                 "poses",
                                 "(M, T, 4, 4)"};
  static constexpr const char* distribution = "PoseDistribution";
  using Given = Array;
  static Eigen::Matrix4d to_point(const Array& array, const std::string& name) {
    return to_pose(array, name);
  }
  static std::vector<Poses> to_paths(const Array& array, const std::string& name) {
    return parts_of<Poses>(array, name, 4, "4: (M, T, 4, 4)", &to_poses);
  }
  static Poses to_goals(const Array& array, const std::string& name) { return to_poses(array, name); }
  template <class Visit>
  static void columns(const Visit& visit) {
    visit("pose", [](auto& t) -> auto& { return t.pose; }, "4, 4) [R p; 0 1], body -> world");
    visit(
        "twist", [](auto& t) -> auto& { return t.twist; },
        "6) linear velocity of the origin [m/s], angular velocity [rad/s], world frame");
    visit(
        "acceleration", [](auto& t) -> auto& { return t.acceleration; },
        "6) the twist's rate, m/s^2 and rad/s^2");
  }
  template <class Class>
  static void outputs(Class& run) {
    using R = typename Class::type;
    run.def_property_readonly(
           "pose", [](const R& r) { return shown(r.pose()); }, "(4, 4) [R p; 0 1]")
        .def_property_readonly(
            "position",
            [](const R& r) { return shown(Eigen::VectorXd(r.pose().template topRightCorner<3, 1>())); },
            "(3,) m")
        .def_property_readonly(
            "rotation",
            [](const R& r) { return shown(Eigen::Matrix3d(r.pose().template topLeftCorner<3, 3>())); },
            "(3, 3)")
        .def_property_readonly(
            "twist", [](const R& r) { return shown(Eigen::VectorXd(r.twist())); },
            "(6,) linear velocity of the origin [m/s], angular velocity [rad/s], world frame")
        .def_property_readonly(
            "acceleration", [](const R& r) { return shown(Eigen::VectorXd(r.acceleration())); },
            "(6,) m/s^2, rad/s^2, world frame");
  }
};

}  // namespace dmp::python
