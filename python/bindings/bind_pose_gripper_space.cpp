#include <dmp/pose_gripper_dmp.hpp>

#include "bind.hpp"
#include "bind_space.hpp"

namespace dmp::python {

template <>
struct InPython<PoseGripperSpace> {
  static constexpr Naming naming{
      "PoseGripperDmp",
      "PoseGripperRun",
      "PoseGripperTrajectory",
      "PoseGripperRunState",
      "PoseGripperDmpParameters",
      "the pose of a tool and its gripper, in one phase",
      "a tuple (pose (4, 4), gripper (k,))",
      "not a pose [R p; 0 1] and as many finite numbers as the gripper has",
      "start",
      "velocity",
      "Begins anew at (pose, gripper) with velocity (6 + k,): twist, gripper per s.",
      "paths",
      "a tuple (poses (M, T, 4, 4), grippers (M, T, k))"};
  static constexpr const char* distribution = "PoseGripperDistribution";
  using Pose = InPython<PoseSpace>;
  using Gripper = InPython<VectorSpace>;
  using Given = std::pair<Array, Array>;
  static PoseGripperSpace::Point to_point(const Given& both, const std::string& name) {
    return {Pose::to_point(both.first, name + "[0]"), Gripper::to_point(both.second, name + "[1]")};
  }
  template <class A, class B>
  static std::vector<std::pair<A, B>> zipped(const std::vector<A>& first, const std::vector<B>& second,
                                             const std::string& name) {
    if (first.size() != second.size())
      throw InvalidArgument(name + ": " + std::to_string(first.size()) + " poses and " +
                            std::to_string(second.size()) + " grippers, expected as many of both.");
    std::vector<std::pair<A, B>> both;
    for (std::size_t k = 0; k < first.size(); ++k) both.emplace_back(first[k], second[k]);
    return both;
  }
  static std::vector<PoseGripperSpace::Path> to_paths(const Given& both, const std::string& name) {
    return zipped(Pose::to_paths(both.first, name + "[0]"), Gripper::to_paths(both.second, name + "[1]"),
                  name);
  }
  static std::vector<PoseGripperSpace::Point> to_goals(const Given& both, const std::string& name) {
    return zipped(Pose::to_goals(both.first, name + "[0]"), Gripper::to_goals(both.second, name + "[1]"),
                  name);
  }
  template <class Visit>
  static void columns(const Visit& visit) {
    Pose::columns([&](const char* name, auto of, const char* doc) {
      visit(name, [of](auto& t) -> auto& { return of(t.first); }, doc);
    });
    Gripper::columns(
        [&](const char* name, auto of, const char* doc) {
          visit(name, [of](auto& t) -> auto& { return of(t.second); }, doc);
        },
        {"gripper", "gripper_velocity", "gripper_acceleration"});
  }
  template <class Class>
  static void outputs(Class& run) {
    using R = PoseGripperRun;
    Pose::outputs(run);
    run.def_property_readonly(
           "gripper", [](const R& r) { return shown(r.gripper()); }, "(k,)")
        .def_property_readonly(
            "gripper_velocity", [](const R& r) { return shown(r.gripper_velocity()); }, "(k,) per s");
  }
};

namespace {

void bind_pose_gripper_demonstration(py::module_& m) {
  using D = PoseGripperDemonstration;
  py::class_<D> demonstration(m, "PoseGripperDemonstration",
                              "The pose of a tool and its gripper as they were recorded.");
  demonstration
      .def(py::init([](const Array& times, const Array& poses, const Array& gripper) {
             return D(to_vector(times, "times"), to_poses(poses, "poses"), to_matrix(gripper, "gripper"));
           }),
           py::arg("times"), py::arg("poses"), py::arg("gripper"),
           "times (T,) s, strictly increasing; poses (T, 4, 4) [R p; 0 1], body -> world, p in m; gripper "
           "(T,) or (T, k): its opening, or the joints of a hand. Raises InvalidArgument naming the sample.")
      .def_property_readonly(
          "pose", [](const D& d) { return d.first(); }, "a PoseDemonstration")
      .def_property_readonly("gripper", [](const D& d) { return d.second(); }, "a Demonstration");
  def_samples(demonstration, "PoseGripperDemonstration");
}

}  // namespace

void bind_pose_gripper_space(py::module_& m) {
  bind_trajectory<PoseGripperSpace>(m);
  bind_pose_gripper_demonstration(m);
  bind_space<PoseGripperSpace, PoseGripperRun>(m);
}

}  // namespace dmp::python
