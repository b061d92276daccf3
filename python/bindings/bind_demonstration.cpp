#include <pybind11/native_enum.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/demonstration.hpp>

#include "arrays.hpp"
#include "bind.hpp"
#include "spaces.hpp"
#include "trajectories.hpp"
#include "values.hpp"

namespace dmp::python {
namespace {

void bind_trajectories(py::module_& m) {
  bind_trajectory<VectorSpace>(m);
  bind_trajectory<RotationSpace>(m);
  using P = PoseTrajectory;
  bind_trajectory<PoseSpace>(m)
      .def_property_readonly(
          "position",
          [](const P& t) {
            RowMatrix position(t.time.size(), 3);
            for (Eigen::Index k = 0; k < position.rows(); ++k)
              position.row(k) = t.pose[static_cast<std::size_t>(k)].topRightCorner<3, 1>();
            return shown(position);
          },
          "(T, 3) m")
      .def_property_readonly(
          "rotation",
          [](const P& t) {
            Rotations rotations;
            for (const Eigen::Matrix4d& pose : t.pose) rotations.push_back(pose.topLeftCorner<3, 3>());
            return shown(rotations);
          },
          "(T, 3, 3)");
}

/// Noise of demonstrations that are no product.
template <class D>
void def_cleaning(py::class_<D>& demonstration) {
  demonstration
      .def(
          "smoothed", [](const D& d) { return d.smoothed(); },
          "The same motion on the smoothing spline: the noise is found in the data (generalised "
          "cross-validation) and taken out; see assess().")
      .def(
          "denoised",
          [](const D& d) {
            const py::gil_scoped_release release;
            return d.denoised();
          },
          "The same motion without its noise, where the samples show that they carry any, otherwise as it "
          "is; "
          "see noise_estimate() and NoiseEstimate.")
      .def(
          "with_measured",
          [](const D& d, const Array& measured) { return d.with_measured(to_vector(measured, "measured")); },
          py::arg("measured"),
          "The same motion, of whose samples some were filled in: measured (T,), 0 or False for those. They "
          "show the way, but no noise.");
}

template <class D>
void def_noise_estimate(py::class_<D>& demonstration) {
  demonstration.def(
      "noise_estimate",
      [](const D& d) {
        NoiseEstimate found;
        const py::gil_scoped_release release;
        d.denoised(&found);
        return found;
      },
      "Whether the samples carry noise that can be taken out, with the evidence.");
}

void bind_vector_demonstration(py::module_& m) {
  using D = Demonstration;
  py::class_<D> demonstration(m, "Demonstration",
                              "Positions over time as they were recorded, in any number of dimensions.");
  demonstration
      .def(py::init([](const Array& times, const Array& positions) {
             return D(to_vector(times, "times"), to_matrix(positions, "positions"));
           }),
           py::arg("times"), py::arg("positions"),
           "times (T,) s, strictly increasing; positions (T, d) or (T,), T >= 2. Raises InvalidArgument "
           "naming the sample.")
      .def_property_readonly(
          "position", [](const D& d) { return shown(d.position()); }, "(T, d)")
      .def_property_readonly("dimension", &D::dimension)
      .def(
          "at", [](const D& d, const Array& times) { return d.at(to_vector(times, "times")); },
          py::arg("times"),
          "Position, velocity and acceleration on the quintic spline at times (n,) in s from the start.");
  def_samples(demonstration, "Demonstration");
  def_cleaning(demonstration);
  def_noise_estimate(demonstration);
}

void bind_orientation_demonstration(py::module_& m) {
  using O = OrientationDemonstration;
  py::class_<O> demonstration(m, "OrientationDemonstration", "Orientations over time as they were recorded.");
  demonstration
      .def(py::init([](const Array& times, const Array& rotations) {
             return O(to_vector(times, "times"), to_rotations(rotations, "rotations"));
           }),
           py::arg("times"), py::arg("rotations"),
           "times (T,) s, strictly increasing; rotations (T, 3, 3) body -> world. Raises InvalidArgument, "
           "naming the sample, for a reflection, a matrix not orthogonal to 1e-3, or neighbours more than "
           "pi/2 "
           "apart.")
      .def_static(
          "from_euler",
          [](const Array& times, const Array& angles, const std::string& convention) {
            return O::from_euler(to_vector(times, "times"), to_matrix(angles, "angles", 3), convention);
          },
          py::arg("times"), py::arg("angles"), py::arg("convention"),
          "times (T,) s; angles (T, 3) rad; convention as in so3.from_euler, such as \"ZYX\".")
      .def_static(
          "from_quaternions",
          [](const Array& times, const Array& quaternions, const std::string& order) {
            return O::from_quaternions(to_vector(times, "times"), to_matrix(quaternions, "quaternions", 4),
                                       order);
          },
          py::arg("times"), py::arg("quaternions"), py::arg("order"),
          "times (T,) s; quaternions (T, 4) body -> world, of length 1 to 1e-2, in the order \"wxyz\" or "
          "\"xyzw\"; q and -q are one rotation.")
      .def_property_readonly(
          "rotation", [](const O& d) { return shown(d.rotation()); }, "(T, 3, 3)")
      .def(
          "at", [](const O& d, const Array& times) { return d.at(to_vector(times, "times")); },
          py::arg("times"),
          "Rotation, angular velocity and acceleration on the quintic spline at times (n,) in s from the "
          "start.");
  def_samples(demonstration, "OrientationDemonstration");
  def_cleaning(demonstration);
  def_noise_estimate(demonstration);
}

void bind_pose_demonstration(py::module_& m) {
  using P = PoseDemonstration;
  py::class_<P> demonstration(m, "PoseDemonstration", "Poses over time as they were recorded.");
  demonstration
      .def(py::init([](const Array& times, const Array& poses) {
             return P(to_vector(times, "times"), to_poses(poses, "poses"));
           }),
           py::arg("times"), py::arg("poses"),
           "times (T,) s, strictly increasing; poses (T, 4, 4) [R p; 0 1], body -> world, p in m. Raises "
           "InvalidArgument naming the sample.")
      .def_static(
          "from_quaternions",
          [](const Array& times, const Array& positions, const Array& quaternions, const std::string& order) {
            return P::from_quaternions(to_vector(times, "times"), to_matrix(positions, "positions", 3),
                                       to_matrix(quaternions, "quaternions", 4), order);
          },
          py::arg("times"), py::arg("positions"), py::arg("quaternions"), py::arg("order"),
          "times (T,) s; positions (T, 3) m; quaternions (T, 4) body -> world in the order \"wxyz\" or "
          "\"xyzw\".")
      .def_property_readonly(
          "pose", [](const P& d) { return shown(d.pose()); }, "(T, 4, 4)")
      .def_property_readonly("position", &P::position)
      .def_property_readonly("orientation", &P::orientation)
      .def(
          "noise",
          [](const P& d) {
            Smoothing position, orientation;
            {
              const py::gil_scoped_release release;
              d.smoothed(&position, &orientation);
            }
            Eigen::VectorXd noise(6);
            noise << position.noise, Eigen::Vector3d::Constant(orientation.noise[0]);
            return from_vector(noise);
          },
          "(6,) standard deviation of the noise found in the data by generalised cross-validation: of "
          "positions [m, x y z], of orientations [rad, the same about x y z]; 0 where there are fewer than "
          "ten samples")
      .def(
          "noise_estimates",
          [](const P& d) {
            std::pair<NoiseEstimate, NoiseEstimate> found;
            const py::gil_scoped_release release;
            d.denoised(&found.first, &found.second);
            return found;
          },
          "Whether positions [m] and orientations [rad] carry noise that can be taken out, with the "
          "evidence.");
  def_samples(demonstration, "PoseDemonstration");
  def_cleaning(demonstration);
}

void bind_noise(py::module_& m) {
  py::native_enum<NoiseKind>(m, "NoiseKind", "enum.Enum",
                             "none: samples are learned as they are; white: each has an error of its own; "
                             "coloured: the error wanders, as that of a tracker.")
      .value("none", NoiseKind::none)
      .value("white", NoiseKind::white)
      .value("coloured", NoiseKind::coloured)
      .finalize();
  py::class_<NoiseEstimate>(m, "NoiseEstimate",
                            "Whether samples carry noise that can be taken out without taking part of the "
                            "motion, and the evidence. "
                            "White noise is taken out if freedom <= 0.5, flatness <= 1.55, evenness >= 0.5 "
                            "or correlation <= 0.1, and "
                            "sharpness >= 1.25.")
      .def_readonly("kind", &NoiseEstimate::kind)
      .def_readonly("sigma", &NoiseEstimate::sigma,
                    "standard deviation along one axis, unit of the samples or rad; 0 if there is none")
      .def_readonly("removed", &NoiseEstimate::removed,
                    "root of the mean square that smoothing takes out, all axes together")
      .def_readonly("cutoff", &NoiseEstimate::cutoff,
                    "Hz, where the smoothing leaves half the power; 0 if none")
      .def_readonly("unpredicted", &NoiseEstimate::unpredicted,
                    "RMS by which a sample differs from what its six neighbours predict, all axes together")
      .def_readonly("freedom", &NoiseEstimate::freedom,
                    "degrees of freedom of the smoothed motion over the samples that were measured")
      .def_readonly("flatness", &NoiseEstimate::flatness,
                    "sqrt(V(.6) / V(.8)), V(e) the variance left by a fit of freedom e; 1.2 for noise")
      .def_readonly("evenness", &NoiseEstimate::evenness,
                    "residual where the motion is calm over that where it is busy; 1 for noise")
      .def_readonly("correlation", &NoiseEstimate::correlation,
                    "of neighbouring residuals where the motion is busy; below 0 for noise")
      .def_readonly("sharpness", &NoiseEstimate::sharpness,
                    "largest acceleration of the samples as they are over that of the smoothed motion")
      .def_readonly("resting", &NoiseEstimate::resting,
                    "speed where the motion is busy over that where it is calm")
      .def_readonly("measured", &NoiseEstimate::measured, "samples that were measured, not filled in or held")
      .def_property_readonly("found", &NoiseEstimate::found, "whether the kind is not none");
}

}  // namespace

void bind_demonstration(py::module_& m) {
  bind_trajectories(m);
  bind_noise(m);
  bind_vector_demonstration(m);
  bind_orientation_demonstration(m);
  bind_pose_demonstration(m);
}

}  // namespace dmp::python
