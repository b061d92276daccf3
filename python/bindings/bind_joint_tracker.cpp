#include <pybind11/stl.h>
#include <dmp/error.hpp>
#include <dmp/joint_tracker.hpp>

#include "arrays.hpp"
#include "bind.hpp"
#include "options.hpp"
#include "values.hpp"

namespace dmp::python {
namespace {

void bind_track_options(py::module_& m) {
  py::class_<TrackOptions> options(m, "TrackOptions", "How a JointTracker follows.");
  options.def(py::init(&with_keywords<TrackOptions>), "The fields as keywords.")
      .def_readwrite("position_tolerance", &TrackOptions::position_tolerance,
                     "m, > 0: when a pose counts as met.")
      .def_readwrite("angle_tolerance", &TrackOptions::angle_tolerance,
                     "rad, > 0: when a pose counts as met.")
      .def_readwrite("angle_weight", &TrackOptions::angle_weight,
                     "m per rad: closest weighs the angle so against the position.")
      .def_property(
          "weight", [](const TrackOptions& o) { return from_vector(o.weight); },
          [](TrackOptions& o, const Array& weight) { o.weight = to_vector6(weight, "weight"); },
          "(6,) how much of the pose counts, in its own axes; 0 is free. See IkOptions.weight.")
      .def_readwrite(
          "limit_pull", &TrackOptions::limit_pull,
          "rad per m that the tip moves: how much joints to spare are drawn away from their limits.");
  def_fields(options);
}

IkStatus track(JointTracker& tracker, const Array& pose, double dt) {
  const IkStatus status = tracker.track(to_pose(pose, "pose"), dt);
  if (status == IkStatus::invalid_input)
    throw InvalidArgument(
        "pose, dt: expected a finite [R p; 0 1] with R orthonormal to 1e-3 and det(R) = +1, "
        "and a time in s > 0; dt = " +
        std::to_string(dt) + ".");
  return status;
}

// Of joints that a tracker does not take: which one, or that there are not as many as the arm has.
std::string why_refused(const Arm& arm, const Eigen::VectorXd& q) {
  const std::string expected = std::to_string(arm.joint_count()) + " finite values within the joint limits.";
  if (q.size() != arm.joint_count() || !q.allFinite())
    return "joints: " + std::to_string(q.size()) + " values, expected " + expected;
  Eigen::Index worst;
  (arm.lower() - q).cwiseMax(q - arm.upper()).maxCoeff(&worst);
  return "joints[" + std::to_string(worst) + "]: joint '" +
         arm.joint_names()[static_cast<std::size_t>(worst)] + "' at " + std::to_string(q[worst]) +
         ", expected within the limits " + std::to_string(arm.lower()[worst]) + " to " +
         std::to_string(arm.upper()[worst]) + " (to 0.001).";
}

void set_joints(JointTracker& tracker, const Array& q) {
  const Eigen::VectorXd joints = to_vector(q, "joints");
  if (tracker.set_joints(joints) == IkStatus::invalid_input)
    throw InvalidArgument(why_refused(tracker.arm(), joints));
}

}  // namespace

void bind_joint_tracker(py::module_& m) {
  bind_track_options(m);
  py::class_<JointTracker>(
      m, "JointTracker",
      R"(The differential inverse kinematics of a control loop: joints that go along with a pose that moves.

Each track() begins at the joints of the one before and moves every joint by at most velocity limit x dt, within the
joint limits, as close to the pose as that allows. A joint that stands up to 1e-3 rad or m beyond a limit, as encoders
read it, comes back onto it within its velocity limit. The fields of TrackOptions are taken as keywords too.)")
      .def(py::init([](const Arm& arm, const Array& start, const std::optional<TrackOptions>& options,
                       const py::kwargs& fields) {
             return JointTracker(arm, to_vector(start, "start"), with_fields(options, fields));
           }),
           py::arg("arm"), py::arg("start"), py::arg("options") = py::none())
      .def("track", &track, py::arg("pose"), py::arg("dt"),
           R"(One step of dt seconds (> 0) towards the pose (4, 4).

Returns IkStatus.ok, or why the pose is missed. Raises InvalidArgument, and changes nothing, for a pose or time that
is none.)")
      .def_property(
          "joints", [](const JointTracker& t) { return from_vector(t.joints()); }, &set_joints,
          "(n,) rad or m, within the limits or on the way back onto them; set it to where the robot stands "
          "after "
          "all, and its velocity becomes 0.")
      .def_property_readonly(
          "velocity", [](const JointTracker& t) { return from_vector(t.velocity()); },
          "(n,) rad/s or m/s, of the last step.")
      .def_property_readonly("position_error", &JointTracker::position_error, "m, of the last step, by KDL.")
      .def_property_readonly("angle_error", &JointTracker::angle_error, "rad, of the last step, by KDL.")
      .def_property_readonly(
          "limit_excess", &JointTracker::limit_excess,
          "rad or m: how far the joints that were given last lay beyond a limit; 0 within.")
      .def_property_readonly("arm", &JointTracker::arm)
      .def_property_readonly("options", [](const JointTracker& t) { return t.options(); })
      .def("__copy__", [](const JointTracker& t) { return JointTracker(t); })
      .def(
          "__deepcopy__", [](const JointTracker& t, const py::dict&) { return JointTracker(t); },
          py::arg("memo"));
}

}  // namespace dmp::python
