#include <pybind11/native_enum.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <dmp/arm.hpp>
#include <dmp/error.hpp>
#include <dmp/ik_branches.hpp>
#include <dmp/inverse_kinematics.hpp>
#include <dmp/path_tracking.hpp>

#include <array>
#include <utility>
#include <variant>

#include "arrays.hpp"
#include "bind.hpp"
#include "options.hpp"
#include "values.hpp"

namespace dmp::python {
namespace {

// A property that copies an Eigen vector of the object into a new array.
template <class Owner>
auto vector_of(const Eigen::VectorXd& (Owner::*get)() const) {
  return [get](const Owner& owner) { return from_vector((owner.*get)()); };
}

std::optional<Eigen::VectorXd> optional_vector(const std::optional<Array>& array, const std::string& name) {
  if (!array) return std::nullopt;
  return to_vector(*array, name);
}

// A property that is text of the URDF, which may be in another encoding than UTF-8.
template <class Text>
auto text_of(const Text& (Arm::*get)() const) {
  return [get](const Arm& arm) { return readable((arm.*get)()); };
}

constexpr std::array<std::pair<const char*, LimitKind>, 5> limit_kinds = {
    {{"position", LimitKind::position},
     {"velocity", LimitKind::velocity},
     {"acceleration", LimitKind::acceleration},
     {"jerk", LimitKind::jerk},
     {"effort", LimitKind::effort}}};

py::dict sources_of(const Arm& arm) {
  py::dict sources;
  for (const auto& [name, kind] : limit_kinds) sources[name] = py::tuple(py::cast(arm.limit_sources(kind)));
  return sources;
}

// An arm is its URDF and its limits: what another process needs to make the same one.
py::tuple arm_state(const Arm& arm) {
  return py::make_tuple(py::bytes(arm.urdf()), arm.base(), arm.tip(), arm.folder(), from_vector(arm.lower()),
                        from_vector(arm.upper()), from_vector(arm.velocity_limit()),
                        from_vector(arm.effort_limit()), from_vector(arm.acceleration_limit()),
                        from_vector(arm.jerk_limit()), sources_of(arm), arm.tool_speed_limit());
}

LimitSources sources_from(const py::dict& named) {
  LimitSources sources;
  for (const auto& [name, kind] : limit_kinds)
    if (named.contains(name))
      sources[static_cast<std::size_t>(kind)] = named[name].cast<std::vector<LimitSource>>();
  return sources;
}

// States of before 0.2 have neither acceleration, jerk, sources nor tool speed.
Arm arm_of_state(const py::tuple& state) {
  const auto text = [&](int i) { return state[i].cast<std::string>(); };
  const auto limit = [&](int i) { return to_vector(state[i].cast<Array>(), "limits"); };
  LimitOverrides limits{limit(4), limit(5), limit(6), limit(7)};
  if (state.size() > 8) {
    limits.acceleration = limit(8);
    limits.jerk = limit(9);
    limits.sources = sources_from(state[10].cast<py::dict>());
  }
  if (state.size() > 11) limits.tool_speed = state[11].cast<double>();
  return Arm::from_urdf(text(0), text(1), text(2), text(3)).with_limits(limits);
}

LimitOverrides overrides_of(const std::optional<Array>& lower, const std::optional<Array>& upper,
                            const std::optional<Array>& velocity, const std::optional<Array>& effort,
                            const std::optional<Array>& acceleration, const std::optional<Array>& jerk,
                            std::optional<double> tool_speed,
                            const std::variant<LimitSource, py::dict>& source) {
  LimitOverrides limits{optional_vector(lower, "lower"),
                        optional_vector(upper, "upper"),
                        optional_vector(velocity, "velocity"),
                        optional_vector(effort, "effort"),
                        optional_vector(acceleration, "acceleration"),
                        optional_vector(jerk, "jerk"),
                        tool_speed};
  if (const auto* one = std::get_if<LimitSource>(&source)) limits.source = *one;
  if (const auto* each = std::get_if<py::dict>(&source)) limits.sources = sources_from(*each);
  return limits;
}

void bind_limit_source(py::module_& m) {
  py::native_enum<LimitSource>(m, "LimitSource", "enum.Enum", "Where a joint limit comes from.")
      .value("unstated", LimitSource::unstated, "Nobody states one: the limit is infinite.")
      .value("urdf", LimitSource::urdf, "The robot's description.")
      .value("maker", LimitSource::maker, "The maker's data sheet.")
      .value("user", LimitSource::user, "The caller.")
      .value("assumed", LimitSource::assumed, "A usual value, in place of one that nobody states.")
      .finalize();
}

void bind_arm(py::module_& m) {
  bind_limit_source(m);
  py::class_<Arm>(m, "Arm",
                  R"(The serial chain of n free joints from the link `base` to the link `tip` of a robot.

An immutable value that any number of threads may use. Fixed joints are folded away, mimic joints move with their
master. Radians for turning joints, metres for sliding ones; poses are tip in base.)")
      .def_static(
          "from_urdf", &Arm::from_urdf, py::arg("text"), py::arg("base") = "", py::arg("tip") = "",
          py::arg("folder") = "",
          R"(Read a URDF; base "" is the root link, tip "" the tool at the end of the longest chain of arm joints.

No gripper's joint is an arm's; frames named tcp, tool0, grasp, end_effector, tool or hand are preferred. `choice` says
what was taken. `folder` is where mesh paths are relative to.

Raises InvalidArgument, naming the joint or link, for a URDF with which no motion can be planned.)")
      .def_static(
          "from_urdf_file",
          [](const std::filesystem::path& path, const std::string& base, const std::string& tip) {
            return Arm::from_urdf_file(path.string(), base, tip);
          },
          py::arg("path"), py::arg("base") = "", py::arg("tip") = "",
          "Read a URDF from a file and keep its folder. Raises FileError if it cannot be read.")
      .def(
          "with_limits",
          [](const Arm& arm, const std::optional<Array>& lower, const std::optional<Array>& upper,
             const std::optional<Array>& velocity, const std::optional<Array>& effort,
             const std::optional<Array>& acceleration, const std::optional<Array>& jerk,
             std::optional<double> tool_speed, const std::variant<LimitSource, py::dict>& source) {
            return arm.with_limits(
                overrides_of(lower, upper, velocity, effort, acceleration, jerk, tool_speed, source));
          },
          py::kw_only(), py::arg("lower") = py::none(), py::arg("upper") = py::none(),
          py::arg("velocity") = py::none(), py::arg("effort") = py::none(),
          py::arg("acceleration") = py::none(), py::arg("jerk") = py::none(),
          py::arg("tool_speed") = py::none(), py::arg("source") = LimitSource::user,
          R"(A copy with other joint limits, each of n values; what is None stays.

lower, upper in rad (m of a sliding joint); velocity, acceleration and jerk per s, s^2 and s^3; effort in N m (N);
tool_speed, one number, in m/s. Infinity means that there is none. `source` says where they come from: one LimitSource, or a dict as
`limit_sources` for each joint. Raises InvalidArgument unless lower < upper and all other limits are > 0.)")
      .def(
          "with_tool",
          [](const Arm& arm, const Array& frame) { return arm.with_tool(to_pose(frame, "frame")); },
          py::arg("frame"),
          R"(A copy whose tip is a frame fixed to this one's, for what a flange carries.

`frame` (4, 4) is the tool in the tip, m. Its link is called like the tip with "_tool" behind and weighs nothing.
Raises InvalidArgument unless it is a pose.)")
      .def_property_readonly("name", text_of(&Arm::name), "Name of the robot.")
      .def_property_readonly("base", text_of(&Arm::base), "Link in whose frame poses are given.")
      .def_property_readonly("tip", text_of(&Arm::tip), "Link whose pose is given.")
      .def_property_readonly(
          "choice", text_of(&Arm::choice),
          "\"6 joints, j1 to j6; held still: jaw\" where base and tip were chosen; empty where "
          "both were stated.")
      .def_property_readonly("joint_count", &Arm::joint_count, "Number of free joints, n.")
      .def_property_readonly("joint_names", text_of(&Arm::joint_names),
                             "Names of the n free joints, from base to tip.")
      .def_property_readonly("lower", vector_of(&Arm::lower), "(n,) rad or m; -inf for a continuous joint.")
      .def_property_readonly("upper", vector_of(&Arm::upper), "(n,) rad or m; inf for a continuous joint.")
      .def_property_readonly("velocity_limit", vector_of(&Arm::velocity_limit),
                             "(n,) rad/s or m/s; inf where nobody states one.")
      .def_property_readonly("effort_limit", vector_of(&Arm::effort_limit),
                             "(n,) N m or N; inf where nobody states one.")
      .def_property_readonly(
          "acceleration_limit", vector_of(&Arm::acceleration_limit),
          "(n,) rad/s^2 or m/s^2; 10 is assumed where nobody states one: a URDF 1.0 cannot.")
      .def_property_readonly("jerk_limit", vector_of(&Arm::jerk_limit),
                             "(n,) rad/s^3 or m/s^3; inf where nobody states one.")
      .def_property_readonly("tool_speed_limit", &Arm::tool_speed_limit,
                             "m/s of the tip; inf where nobody states one.")
      .def_property_readonly("limit_sources", &sources_of,
                             "Where the limits come from: a tuple of n LimitSource for each of position, "
                             "velocity, acceleration, "
                             "jerk and effort.")
      .def_property_readonly("warnings", text_of(&Arm::warnings),
                             "Non-fatal problems of the URDF, one sentence each.")
      .def_property_readonly("urdf", text_of(&Arm::urdf), "The text that was read.")
      .def_property_readonly("folder", text_of(&Arm::folder),
                             "Folder to which mesh paths are relative; empty if unknown.")
      .def(
          "forward_kinematics",
          [](const Arm& arm, const Array& q) -> py::array_t<double> {
            if (q.ndim() == 2)
              return from_poses(arm.forward_kinematics(to_matrix(q, "q", arm.joint_count())));
            return from_pose(arm.forward_kinematics(to_vector(q, "q")));
          },
          py::arg("q"), "Pose of the tip (4, 4) at joints (n,), or poses (T, 4, 4) at joints (T, n), by KDL.")
      .def(
          "jacobian",
          [](const Arm& arm, const Array& q) { return from_matrix(arm.jacobian(to_vector(q, "q"))); },
          py::arg("q"),
          "(6, n) linear velocity (rows 0-2), then angular velocity of the tip (rows 3-5), in the base "
          "frame, by KDL.")
      .def(
          "manipulability",
          [](const Arm& arm, const Array& q) { return arm.manipulability(to_vector(q, "q")); }, py::arg("q"),
          "sqrt(det(J J^T)), 0 where the arm is singular (Yoshikawa 1985).")
      .def_property_readonly(
          "gravity", [](const Arm& arm) { return from_vector(arm.gravity()); },
          "(3,) m/s^2 in the base frame: 9.81 along -z of the URDF's root.")
      .def(
          "inverse_dynamics",
          [](const Arm& arm, const Array& q, const Array& velocity, const Array& acceleration) {
            return from_vector(arm.inverse_dynamics(to_vector(q, "q"), to_vector(velocity, "velocity"),
                                                    to_vector(acceleration, "acceleration")));
          },
          py::arg("q"), py::arg("velocity"), py::arg("acceleration"),
          R"((n,) N m or N for an acceleration (n,) at joints q (n,) that move with velocity (n,), by KDL.

Recursive Newton-Euler under `gravity` with the URDF's inertias and without friction; joints beside the way from base
to tip stand in the middle of their range. Raises InvalidArgument for other sizes or values that are not finite.)")
      .def(
          "gravity_effort",
          [](const Arm& arm, const Array& q) -> py::array_t<double> {
            if (q.ndim() == 2) {
              const RowMatrix rows = to_matrix(q, "q", arm.joint_count());
              return from_matrix(arm.gravity_effort(rows));
            }
            const RowMatrix row = to_vector(q, "q").transpose();
            return from_vector(arm.gravity_effort(row).row(0).transpose());
          },
          py::arg("q"),
          "N m or N that hold the arm still at joints (n,), or (T, n) at joints (T, n), by KDL.")
      .def(py::pickle(&arm_state, &arm_of_state))
      .def("__repr__", [](const Arm& arm) {
        return "<Arm '" + arm.name() + "': " + std::to_string(arm.joint_count()) + " joints from '" +
               arm.base() + "' to '" + arm.tip() + "'>";
      });
}

std::string summary(const IkResult& r) {
  return std::string(name_of(r.status)) + ": " + std::to_string(1e3 * r.position_error) + " mm, " +
         std::to_string(r.angle_error) + " rad";
}

[[noreturn]] void raise_ik_error(const std::string& message, const py::object& report) {
  const py::object type = py::module_::import("dmpcpp.errors").attr("IkError");
  PyErr_SetObject(type.ptr(), type(message, report).ptr());
  throw py::error_already_set();
}

void bind_branches(py::module_& m) {
  py::class_<IkBranches>(m, "IkBranches", "The different joints that meet one pose, one after the other.")
      .def("__iter__", [](IkBranches& b) -> IkBranches& { return b; })
      .def("__next__", [](IkBranches& b) {
        const auto found = b.next();
        if (!found) throw py::stop_iteration();
        return *found;
      });
}

void bind_results(py::module_& m) {
  py::native_enum<IkStatus>(m, "IkStatus", "enum.Enum", "Why joints do or do not meet a pose.")
      .value("ok", IkStatus::ok)
      .value("out_of_reach", IkStatus::out_of_reach)
      .value("limit_blocked", IkStatus::limit_blocked)
      .value("step_limited", IkStatus::step_limited)
      .value("singular", IkStatus::singular)
      .value("budget", IkStatus::budget)
      .value("invalid_input", IkStatus::invalid_input)
      .finalize();
  py::class_<IkResult>(m, "IkResult",
                       "The joints whose tip is at the pose, or as close to it as the search came.")
      .def_property_readonly(
          "joints", [](const IkResult& r) { return from_vector(r.joints); }, "(n,) rad or m.")
      .def_readonly("status", &IkResult::status)
      .def_property_readonly("ok", &IkResult::ok, "True if status is ok.")
      .def_readonly("position_error", &IkResult::position_error, "m, by KDL's forward kinematics.")
      .def_readonly("angle_error", &IkResult::angle_error, "rad, by KDL's forward kinematics.")
      .def_readonly("iterations", &IkResult::iterations)
      .def_readonly("limit_margin", &IkResult::limit_margin, "rad or m from the nearest joint limit.")
      .def_readonly("blocked", &IkResult::blocked, "Indices of the joints that a limit holds back.")
      .def("__repr__", [](const IkResult& r) { return "<IkResult " + summary(r) + ">"; })
      .def(py::pickle(
          [](const IkResult& r) {
            return py::make_tuple(from_vector(r.joints), r.status, r.position_error, r.angle_error,
                                  r.iterations, r.limit_margin, r.blocked);
          },
          [](const py::tuple& state) {
            IkResult r;
            r.joints = to_vector(state[0].cast<Array>(), "joints");
            r.status = state[1].cast<IkStatus>();
            r.position_error = state[2].cast<double>();
            r.angle_error = state[3].cast<double>();
            r.iterations = state[4].cast<int>();
            r.limit_margin = state[5].cast<double>();
            r.blocked = state[6].cast<decltype(r.blocked)>();
            return r;
          }));
  py::class_<IkBatch>(m, "IkBatch", "What solve_many found for N poses.")
      .def_property_readonly(
          "joints", [](const IkBatch& b) { return from_matrix(b.joints); }, "(N, n) rad or m.")
      .def_readonly("status", &IkBatch::status, "N times IkStatus.")
      .def_property_readonly(
          "position_error", [](const IkBatch& b) { return from_vector(b.position_error); }, "(N,) m.")
      .def_property_readonly(
          "angle_error", [](const IkBatch& b) { return from_vector(b.angle_error); }, "(N,) rad.")
      .def_readonly("solved", &IkBatch::solved, "How many poses have the status ok.")
      .def(py::pickle(
          [](const IkBatch& b) {
            return py::make_tuple(from_matrix(b.joints), b.status, from_vector(b.position_error),
                                  from_vector(b.angle_error), b.solved);
          },
          [](const py::tuple& state) {
            IkBatch b;
            b.joints = to_matrix(state[0].cast<Array>(), "joints");
            b.status = state[1].cast<std::vector<IkStatus>>();
            b.position_error = to_vector(state[2].cast<Array>(), "position_error");
            b.angle_error = to_vector(state[3].cast<Array>(), "angle_error");
            b.solved = state[4].cast<Eigen::Index>();
            return b;
          }));
}

py::tuple report_state(const PathReport& r) {
  return py::make_tuple(from_vector(r.position_error), from_vector(r.angle_error), r.status, r.solved,
                        r.missed, r.max_step, r.velocity_ratio, r.limit_margin, r.starts_tried);
}

PathReport report_of_state(const py::tuple& state) {
  return {to_vector(state[0].cast<Array>(), "position_error"),
          to_vector(state[1].cast<Array>(), "angle_error"),
          state[2].cast<std::vector<IkStatus>>(),
          state[3].cast<Eigen::Index>(),
          state[4].cast<std::vector<std::pair<Eigen::Index, Eigen::Index>>>(),
          state[5].cast<double>(),
          state[6].cast<double>(),
          state[7].cast<double>(),
          state[8].cast<int>()};
}

py::tuple joints_state(const JointTrajectory& j) {
  return py::make_tuple(from_vector(j.time), from_matrix(j.position), from_matrix(j.velocity),
                        from_matrix(j.acceleration), j.joint_names, j.report);
}

JointTrajectory joints_of_state(const py::tuple& state) {
  return {to_vector(state[0].cast<Array>(), "time"),     to_matrix(state[1].cast<Array>(), "position"),
          to_matrix(state[2].cast<Array>(), "velocity"), to_matrix(state[3].cast<Array>(), "acceleration"),
          state[4].cast<std::vector<std::string>>(),     state[5].cast<PathReport>()};
}

void bind_joint_trajectory(py::module_& m) {
  py::class_<PathReport>(m, "PathReport", "How well joints follow a path of T poses.")
      .def_property_readonly(
          "position_error", [](const PathReport& r) { return from_vector(r.position_error); }, "(T,) m.")
      .def_property_readonly(
          "angle_error", [](const PathReport& r) { return from_vector(r.angle_error); }, "(T,) rad.")
      .def_readonly("status", &PathReport::status, "T times IkStatus.")
      .def_readonly("solved", &PathReport::solved, "How many poses have the status ok.")
      .def_readonly("missed", &PathReport::missed,
                    "First and last index of each run of poses that were missed.")
      .def_readonly("max_step", &PathReport::max_step, "rad or m, the largest step of any joint.")
      .def_readonly("velocity_ratio", &PathReport::velocity_ratio,
                    "The largest speed over the velocity limit.")
      .def_readonly("limit_margin", &PathReport::limit_margin,
                    "rad or m, the smallest distance from a joint limit.")
      .def_readonly("starts_tried", &PathReport::starts_tried, "Joint paths that were tracked.")
      .def_property_readonly("complete", &PathReport::complete, "True if every pose is met.")
      .def("summary", &PathReport::summary,
           "The worst errors and the runs that were missed, in one sentence.")
      .def("__repr__", [](const PathReport& r) { return "<PathReport: " + r.summary() + ">"; })
      .def(py::pickle(&report_state, &report_of_state));
  py::native_enum<SplineEnds>(m, "SplineEnds", "enum.Enum", "How a cubic spline ends.")
      .value("not_a_knot", SplineEnds::not_a_knot,
             "As the samples suggest: the first three lie on one cubic.")
      .value("at_rest", SplineEnds::at_rest, "The velocity at both ends is zero, exactly.")
      .finalize();
  py::class_<JointTrajectory>(m, "JointTrajectory",
                              "Joints over time, with the derivatives of their C2 cubic spline.")
      .def_static(
          "through",
          [](const Array& times, const Array& positions, const std::vector<std::string>& names,
             SplineEnds ends) {
            return JointTrajectory::through(to_vector(times, "times"), to_matrix(positions, "positions"),
                                            names, ends);
          },
          py::arg("times"), py::arg("positions"), py::arg("joint_names") = std::vector<std::string>{},
          py::arg_v("ends", SplineEnds::not_a_knot, "SplineEnds.not_a_knot"),
          "The C2 cubic spline through positions (T, n) at times (T,) s, strictly increasing.")
      .def_property_readonly(
          "time", [](const JointTrajectory& j) { return from_vector(j.time); }, "(T,) s.")
      .def_property_readonly(
          "position", [](const JointTrajectory& j) { return from_matrix(j.position); }, "(T, n) rad.")
      .def_property_readonly(
          "velocity", [](const JointTrajectory& j) { return from_matrix(j.velocity); }, "(T, n) rad/s.")
      .def_property_readonly(
          "acceleration", [](const JointTrajectory& j) { return from_matrix(j.acceleration); },
          "(T, n) rad/s^2.")
      .def_readonly("joint_names", &JointTrajectory::joint_names)
      .def_readonly("report", &JointTrajectory::report)
      .def("__len__", [](const JointTrajectory& j) { return j.time.size(); })
      .def("__repr__",
           [](const JointTrajectory& j) {
             return shown_samples("JointTrajectory", j.time, std::to_string(j.position.cols()) + " joints");
           })
      .def(py::pickle(&joints_state, &joints_of_state));
}

void bind_ik_options(py::module_& m) {
  py::native_enum<IkBackend>(m, "IkBackend", "enum.Enum",
                             "Which KDL position solver makes the single descents.")
      .value("bounded_lm", IkBackend::bounded_lm)
      .value("kdl_lma", IkBackend::kdl_lma)
      .value("kdl_nr_jl", IkBackend::kdl_nr_jl)
      .finalize();
  py::class_<IkOptions> ik(m, "IkOptions", "How InverseKinematics searches.");
  ik.def(py::init(&with_keywords<IkOptions>), "The fields as keywords.")
      .def_readwrite("backend", &IkOptions::backend)
      .def_readwrite("position_tolerance", &IkOptions::position_tolerance, "m, > 0.")
      .def_readwrite("angle_tolerance", &IkOptions::angle_tolerance, "rad, > 0.")
      .def_readwrite("angle_weight", &IkOptions::angle_weight,
                     "m per rad: closest is position + weight * angle.")
      .def_property(
          "weight", [](const IkOptions& o) { return from_vector(o.weight); },
          [](IkOptions& o, const Array& weight) { o.weight = to_vector6(weight, "weight"); },
          "(6,) how much of the pose counts, in its own axes: moving along x, y, z, turning about x, y, z; 0 "
          "is "
          "free.")
      .def_readwrite("iteration_limit", &IkOptions::iteration_limit, "Of one solve, all restarts together.")
      .def_readwrite("max_step", &IkOptions::max_step, "rad or m: how far solve may leave the seed.")
      .def_readwrite("diagnose", &IkOptions::diagnose,
                     "Search on without limits to tell why a pose is missed.")
      .def_readwrite("random_seed", &IkOptions::random_seed);
  py::class_<FollowOptions> follow(m, "FollowOptions", "How InverseKinematics.follow goes about a path.");
  follow.def(py::init(&with_keywords<FollowOptions>), "The fields as keywords.")
      .def_property(
          "start",
          [](const FollowOptions& o) -> py::object {
            return o.start ? py::object(from_vector(*o.start)) : py::none();
          },
          [](FollowOptions& o, const std::optional<Array>& q) { o.start = optional_vector(q, "start"); },
          "(n,) where the robot already stands, or None to search.")
      .def_readwrite("max_step", &FollowOptions::max_step, "rad or m from one pose to the next.")
      .def_readwrite("respect_velocity", &FollowOptions::respect_velocity)
      .def_readwrite("anchors", &FollowOptions::anchors, "Poses of the path at which starts are searched.")
      .def_readwrite("starts", &FollowOptions::starts, "Joints tried at each anchor.")
      .def_readwrite("thorough", &FollowOptions::thorough,
                     "Search a roadmap where tracking misses a pose, and calm the null space.")
      .def_readwrite("position_tolerance", &FollowOptions::position_tolerance,
                     "m: when a pose counts as met.")
      .def_readwrite("angle_tolerance", &FollowOptions::angle_tolerance, "rad: when a pose counts as met.");
  def_fields(ik);
  def_fields(follow);
}

Eigen::VectorXd seed_or_middle(const InverseKinematics& ik, const std::optional<Array>& seed) {
  if (!seed) return ik.middle();
  const Eigen::VectorXd q = to_vector(*seed, "seed");
  if (q.size() != ik.arm().joint_count() || !q.allFinite())
    throw InvalidArgument("seed: " + std::to_string(q.size()) + " values, expected " +
                          std::to_string(ik.arm().joint_count()) + ", one for each joint, all finite.");
  return q;
}

void refuse_invalid(const IkResult& result, const std::string& name) {
  if (result.status == IkStatus::invalid_input)
    throw InvalidArgument(name +
                          ": expected a finite [R p; 0 1] with R orthonormal to 1e-3 and det(R) = +1.");
}

IkBatch solve_many(const InverseKinematics& ik, const Array& poses, const std::optional<Array>& seed) {
  const Poses targets = to_poses(poses, "poses");
  const Eigen::VectorXd from = seed_or_middle(ik, seed);
  InverseKinematics own = ik;  // so that other threads may use `ik` meanwhile
  const py::gil_scoped_release release;
  IkBatch batch = own.solve_many(targets, from);
  for (std::size_t k = 0; k < targets.size(); ++k)
    if (batch.status[k] == IkStatus::invalid_input)
      throw InvalidArgument("poses[" + std::to_string(k) +
                            "]: expected a finite [R p; 0 1] with R orthonormal to 1e-3 and det(R) = +1.");
  return batch;
}

JointTrajectory follow(const InverseKinematics& ik, const py::object& path, const std::optional<Array>& times,
                       const std::optional<FollowOptions>& options, bool strict, const py::kwargs& fields) {
  const bool is_trajectory = py::hasattr(path, "pose") && py::hasattr(path, "time");
  if (!is_trajectory && !times)
    throw InvalidArgument("times: missing; pass a trajectory with .time and .pose, or poses and times.");
  const Poses poses = to_poses((is_trajectory ? path.attr("pose") : path).cast<Array>(), "poses");
  const Eigen::VectorXd seconds = to_vector(times ? *times : path.attr("time").cast<Array>(), "times");
  const FollowOptions chosen = with_fields(options, fields);
  InverseKinematics own = ik;
  JointTrajectory joints;
  {
    const py::gil_scoped_release release;
    joints = own.follow(seconds, poses, chosen);
  }
  if (strict && !joints.report.complete()) raise_ik_error(joints.report.summary(), py::cast(joints.report));
  return joints;
}

IkBranches branches(const InverseKinematics& ik, const Array& pose, const std::optional<Array>& seed,
                    double apart, int tries) {
  return {ik.arm(), to_pose(pose, "pose"), seed_or_middle(ik, seed), ik.options(), {apart, tries}};
}

void bind_solver(py::module_& m) {
  py::class_<InverseKinematics>(m, "InverseKinematics",
                                R"(Joints for poses of an Arm's tip.

The fields of IkOptions are taken as keywords too. Every answer depends on the arguments and the options alone.)")
      .def(py::init([](const Arm& arm, const std::optional<IkOptions>& options, const py::kwargs& fields) {
             return InverseKinematics(arm, with_fields(options, fields));
           }),
           py::arg("arm"), py::arg("options") = py::none())
      .def_property_readonly("arm", &InverseKinematics::arm)
      .def_property_readonly("options", [](const InverseKinematics& ik) { return ik.options(); })
      .def_property_readonly(
          "middle", [](const InverseKinematics& ik) { return from_vector(ik.middle()); },
          "(n,) the middle of each joint's range: the seed where none is given.")
      .def(
          "solve",
          [](InverseKinematics& ik, const Array& pose, const std::optional<Array>& seed, bool strict) {
            const IkResult result = ik.solve(to_pose(pose, "pose"), seed_or_middle(ik, seed));
            refuse_invalid(result, "pose");
            if (strict && !result.ok()) raise_ik_error(summary(result), py::cast(result));
            return result;
          },
          py::arg("pose"), py::arg("seed") = py::none(), py::arg("strict") = false,
          R"(Joints (n,) whose tip is at the pose (4, 4), or as close as can be, with a status that says why.

Never raises because a pose is out of reach, unless strict: then errors.IkError with this result as its
`report`. Raises InvalidArgument for a pose that is none.)")
      .def("branches", &branches, py::arg("pose"), py::arg("seed") = py::none(), py::kw_only(),
           py::arg("apart") = BranchOptions{}.apart, py::arg("tries") = BranchOptions{}.tries,
           R"(Iterate over the different joints that meet the pose (4, 4), each an IkResult; the seed's first.

Some joint of each differs from every one before by `apart` [rad or m]; the iteration ends when `tries` descents
from random joints found no more. Give the one you choose to follow(start=...).)")
      .def("solve_many", &solve_many, py::arg("poses"), py::arg("seed") = py::none(),
           "solve() for each of the poses (N, 4, 4), each begun at the last joints that met theirs. Releases "
           "the GIL.")
      .def("follow", &follow, py::arg("path"), py::arg("times") = py::none(), py::arg("options") = py::none(),
           py::arg("strict") = false,
           R"(Joints for a whole path, with a report for every pose. Releases the GIL.

`path` is a trajectory with .time (T,) and .pose (T, 4, 4), or the poses themselves with times=(T,) in s.
The fields of FollowOptions are taken as keywords too. strict: raise errors.IkError, with the report, unless
every pose is met.)");
}

}  // namespace

void bind_kinematics(py::module_& m) {
  bind_arm(m);
  bind_results(m);
  bind_joint_trajectory(m);
  bind_ik_options(m);
  bind_branches(m);
  bind_solver(m);
}

}  // namespace dmp::python
