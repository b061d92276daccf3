#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/error.hpp>
#include <dmp/safety_filter.hpp>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "loop.hpp"
#include "values.hpp"

namespace dmp::python {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

Vector3d to_place(const Array& array, const char* name) {
  const VectorXd given = to_vector(array, name);
  if (given.size() != 3)
    throw InvalidArgument(std::string(name) + ": " + std::to_string(given.size()) + " numbers, expected 3.");
  if (!given.allFinite()) throw InvalidArgument(std::string(name) + ": not finite, expected three numbers.");
  return given;
}
Vector3d to_velocity(const std::optional<Array>& velocity) {
  return velocity ? to_place(*velocity, "velocity") : Vector3d(Vector3d::Zero());
}

template <class Shape>
Shape checked(const Shape& shape) {
  try {
    require_obstacle(shape, "");
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(std::string(error.what()).substr(1));  // ".radius: .."
  }
  return shape;
}

/// Of one point (3,) a number, of many (N, 3) as many.
py::object distances(const Obstacle& obstacle, const Array& points) {
  if (points.ndim() == 1) return py::float_(nearness(obstacle, to_place(points, "points")).distance);
  const RowMatrix all = to_matrix(points, "points", 3);
  if (!all.allFinite()) throw InvalidArgument("points: not finite, expected numbers in m.");
  VectorXd found(all.rows());
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    found[i] = nearness(obstacle, all.row(i).transpose()).distance;
  return from_vector(found);
}

template <class Shape>
void def_shape(py::class_<Shape>& shape, const char* name) {
  shape
      .def_property_readonly(
          "velocity", [](const Shape& s) { return shown(VectorXd(s.velocity)); }, "(3,) m/s")
      .def(
          "distance", [](const Shape& s, const Array& points) { return distances(s, points); },
          py::arg("points"),
          "Distance of points (N, 3) m, or of one (3,), to the surface, m (N,); negative inside.")
      .def(
          "gradient",
          [](const Shape& s, const Array& point) {
            return from_vector(nearness(s, to_place(point, "point")).normal);
          },
          py::arg("point"), "(3,) the unit gradient of the distance at a point (3,) m: the way out.")
      .def("__repr__", [name](const Shape& s) {
        const double speed = s.velocity.norm();
        return "<" + std::string(name) + (speed > 0.0 ? ": " + short_number(speed) + " m/s>" : ">");
      });
}

void bind_shapes(py::module_& m) {
  py::class_<Sphere> sphere(m, "Sphere", "A ball that a motion must not touch.");
  sphere
      .def(py::init([](const Array& center, double radius, const std::optional<Array>& velocity) {
             return checked(Sphere{to_place(center, "center"), radius, to_velocity(velocity)});
           }),
           py::arg("center"), py::arg("radius"), py::arg("velocity") = py::none(),
           "center (3,) m; radius m, 0 or more; velocity (3,) m/s, none unless given.")
      .def_property_readonly(
          "center", [](const Sphere& s) { return shown(VectorXd(s.center)); }, "(3,) m")
      .def_readonly("radius", &Sphere::radius, "m");
  def_shape(sphere, "Sphere");
  py::class_<Box> box(m, "Box", "A box, turned as it may be.");
  box.def(py::init([](const Array& pose, const Array& half_sizes, const std::optional<Array>& velocity) {
            return checked(
                Box{to_pose(pose, "pose"), to_place(half_sizes, "half_sizes"), to_velocity(velocity)});
          }),
          py::arg("pose"), py::arg("half_sizes"), py::arg("velocity") = py::none(),
          "pose (4, 4) of its centre; half_sizes (3,) m along its axes; velocity (3,) m/s.")
      .def_property_readonly(
          "pose", [](const Box& b) { return shown(b.pose); }, "(4, 4)")
      .def_property_readonly(
          "half_sizes", [](const Box& b) { return shown(VectorXd(b.half_sizes)); }, "(3,) m");
  def_shape(box, "Box");
  py::class_<Capsule> capsule(m, "Capsule", "All points within a radius of a line: a link, a person's arm.");
  capsule
      .def(py::init(
               [](const Array& start, const Array& end, double radius, const std::optional<Array>& velocity) {
                 return checked(
                     Capsule{to_place(start, "start"), to_place(end, "end"), radius, to_velocity(velocity)});
               }),
           py::arg("start"), py::arg("end"), py::arg("radius"), py::arg("velocity") = py::none(),
           "start, end (3,) m; radius m, 0 or more; velocity (3,) m/s.")
      .def_property_readonly(
          "start", [](const Capsule& c) { return shown(VectorXd(c.start)); }, "(3,) m")
      .def_property_readonly(
          "end", [](const Capsule& c) { return shown(VectorXd(c.end)); }, "(3,) m")
      .def_readonly("radius", &Capsule::radius, "m");
  def_shape(capsule, "Capsule");
  py::class_<Plane> plane(m, "Plane", "Everything behind a plane: a table, a wall.");
  plane
      .def(py::init([](const Array& point, const Array& normal, const std::optional<Array>& velocity) {
             return checked(
                 Plane{to_place(point, "point"), to_place(normal, "normal"), to_velocity(velocity)});
           }),
           py::arg("point"), py::arg("normal"), py::arg("velocity") = py::none(),
           "point (3,) m on it; normal (3,), of any length, leads to the free side; velocity (3,) m/s.")
      .def_property_readonly(
          "point", [](const Plane& p) { return shown(VectorXd(p.point)); }, "(3,) m")
      .def_property_readonly("normal", [](const Plane& p) { return shown(VectorXd(p.normal)); }, "(3,)");
  def_shape(plane, "Plane");
}

VectorXd to_limit(const std::optional<Array>& limit, const char* name) {
  if (!limit) return {};
  const VectorXd values = to_vector(*limit, name);
  if (values.size() == 0)
    throw InvalidArgument(std::string(name) + ": no numbers, expected one for each axis.");
  return values;
}

SafetyFilter filter_of(const SafetyLimits& limits, const std::vector<Obstacle>& obstacles, int room,
                       const SafetyOptions& options) {
  const int needed = std::max(room, static_cast<int>(obstacles.size()));
  SafetyFilter filter(limits, needed, options);
  for (std::size_t j = 0; j < obstacles.size(); ++j) filter.set(static_cast<int>(j), obstacles[j]);
  return filter;
}

void require_index(Status status, int index, const SafetyFilter& filter) {
  require_accepted(status, "index: " + std::to_string(index) + ", expected 0 to " +
                               std::to_string(filter.room() - 1) + ", the room that the filter has.");
}

}  // namespace

void bind_safety(py::module_& m) {
  bind_shapes(m);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const SafetyOptions usual;
  py::class_<SafetyFilter>(
      m, "SafetyFilter",
      "Keeps limits and stays clear of obstacles behind a run: run.step(dt, filter=filter). "
      "Limits are never exceeded, an obstacle that stands still is never touched, where the "
      "motion begins within the limits with room to stop; where nothing else is left the "
      "motion brakes and run.status is Status.blocked.")
      .def(py::init([](const std::vector<Obstacle>& obstacles, const std::optional<Array>& lower,
                       const std::optional<Array>& upper, const std::optional<Array>& velocity,
                       const std::optional<Array>& acceleration, double angular_velocity,
                       double angular_acceleration, double margin, double radius, double gain,
                       double largest_step, bool slide, int room) {
             const SafetyLimits limits{to_limit(lower, "lower"),
                                       to_limit(upper, "upper"),
                                       to_limit(velocity, "velocity"),
                                       to_limit(acceleration, "acceleration"),
                                       angular_velocity,
                                       angular_acceleration};
             return filter_of(limits, obstacles, room, {margin, radius, gain, largest_step, slide});
           }),
           py::arg("obstacles") = py::tuple(), py::kw_only(), py::arg("lower") = py::none(),
           py::arg("upper") = py::none(), py::arg("velocity") = py::none(),
           py::arg("acceleration") = py::none(), py::arg("angular_velocity") = kNone,
           py::arg("angular_acceleration") = kNone, py::arg("margin") = usual.margin,
           py::arg("radius") = usual.radius, py::arg("gain") = usual.gain,
           py::arg("largest_step") = usual.largest_step, py::arg("slide") = usual.slide, py::arg("room") = 8,
           "obstacles: Sphere, Box, Capsule or Plane, each. lower, upper, velocity, acceleration (axes,): "
           "limits of "
           "every axis (of a pose those of its position), inf for none. angular_velocity, "
           "angular_acceleration: of "
           "their norms, rad/s and rad/s^2. margin: what is kept from obstacles, m, above 0. radius: of the "
           "tool, m. "
           "gain: how late the motion gives way, 1 to 100 per duration. largest_step: steps are divided so "
           "that "
           "none is longer, s. slide: pushes along the surface of what lies straight ahead. room: obstacles "
           "that "
           "fit in at once, 1 to 256.")
      .def_property_readonly("room", &SafetyFilter::room, "how many obstacles fit in at once")
      .def_property_readonly(
          "obstacles",
          [](const SafetyFilter& f) {
            py::list all;
            for (int j = 0; j < f.room(); ++j)
              all.append(f.obstacle(j) ? py::cast(*f.obstacle(j)) : py::none());
            return all;
          },
          "a list of `room`: each where it has been carried to, None where there is none")
      .def(
          "set",
          [](SafetyFilter& f, int index, const Obstacle& o) { require_index(f.set(index, o), index, f); },
          py::arg("index"), py::arg("obstacle"), "The obstacle of a number, 0 to room - 1, as it is now.")
      .def(
          "remove", [](SafetyFilter& f, int index) { require_index(f.remove(index), index, f); },
          py::arg("index"))
      .def("clear", &SafetyFilter::clear, "Removes all obstacles.")
      .def(
          "set_tracking_error",
          [](SafetyFilter& f, double error) {
            require_accepted(f.set_tracking_error(error),
                             "error: expected a finite distance in m, 0 or more.");
          },
          py::arg("error"),
          "How far the robot may be from where it should be, m: kept from obstacles in addition to the "
          "margin.")
      .def_property_readonly("clearance", &SafetyFilter::clearance,
                             "least distance from the tool to an obstacle after the last step, m")
      .def_property_readonly("changed", &SafetyFilter::changed, "whether the last step changed the motion")
      .def("__copy__", [](const SafetyFilter& f) { return SafetyFilter(f); })
      .def(
          "__deepcopy__", [](const SafetyFilter& f, const py::dict&) { return SafetyFilter(f); },
          py::arg("memo"))
      .def("__repr__", [](const SafetyFilter& f) {
        int count = 0;
        for (int j = 0; j < f.room(); ++j) count += f.obstacle(j) != nullptr;
        return "<SafetyFilter: " + std::to_string(count) + " obstacles, margin " +
               short_number(f.options().margin) + " m>";
      });
}

}  // namespace dmp::python
