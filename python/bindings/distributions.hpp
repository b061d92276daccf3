#pragma once
// Distributions over many demonstrations as Python has them.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <dmp/distribution.hpp>
#include <dmp/error.hpp>
#include <dmp/file.hpp>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "adaptation.hpp"
#include "loop.hpp"
#include "options.hpp"
#include "values.hpp"

namespace dmp::python {

/// What is given of a motion of any space.
struct GivenAt {
  double phase;
  std::optional<py::object> point;
  std::optional<Array> velocity;
  std::optional<Array> covariance;
  std::optional<Array> velocity_covariance;
  std::vector<Eigen::Index> axes;
};

inline std::optional<Eigen::MatrixXd> to_covariance(const std::optional<Array>& given,
                                                    const std::string& name) {
  if (!given) return {};
  return Eigen::MatrixXd(to_matrix(*given, name));
}

template <class Space>
auto to_array(const py::object& point, const std::string& name) {
  try {
    return point.cast<typename InPython<Space>::Given>();
  } catch (const std::exception&) {  // of a cast, or of numpy
    throw InvalidArgument(name + ": of the wrong type, expected " + InPython<Space>::naming.point + ".");
  }
}

template <class Space>
Given<Space> to_given(GivenAt given, const std::string& name) {
  std::optional<typename Space::Point> point;
  if (given.point) {
    const auto array = to_array<Space>(*given.point, name + ".point");
    if constexpr (std::is_same_v<Space, PoseSpace>) {
      if (array.size() == 3 && array.ndim() == 1) {  // a position, whatever the rotation
        point = pose_of(Eigen::Matrix3d::Identity(), to_vector(array, name + ".point"));
        if (given.axes.empty()) given.axes = {0, 1, 2};
      }
    }
    if (!point) point = InPython<Space>::to_point(array, name + ".point");
  }
  std::optional<typename Space::Tangent> velocity;
  if (given.velocity) velocity = to_tangent<Space>(*given.velocity, name + ".velocity");
  Given<Space> known(given.phase, point, velocity);
  known.covariance = to_covariance(given.covariance, name + ".covariance");
  known.velocity_covariance = to_covariance(given.velocity_covariance, name + ".velocity_covariance");
  known.axes = given.axes;
  return known;
}

template <class Space>
std::vector<Given<Space>> to_givens(const std::vector<GivenAt>& given) {
  std::vector<Given<Space>> all;
  for (std::size_t k = 0; k < given.size(); ++k)
    all.push_back(to_given<Space>(given[k], "given[" + std::to_string(k) + "]"));
  return all;
}

/// A number for all axes, or one for each.
inline Eigen::VectorXd for_axes(const std::variant<double, Array>& given, Eigen::Index axes,
                                const std::string& name) {
  if (const double* one = std::get_if<double>(&given)) return Eigen::VectorXd::Constant(axes, *one);
  return to_vector(std::get<Array>(given), name);
}

template <class Space, class Class>
void def_distribution_values(Class& distribution) {
  using D = Distribution<Space>;
  distribution.def_property_readonly("duration", &D::duration, "s, mean of the demonstrations")
      .def_property_readonly("dimension", &D::dimension, "d, axes of the motion")
      .def_property_readonly(
          "demonstrations", [](const D& d) { return d.parameters().demonstrations; },
          "how many it was learned from")
      .def_property_readonly(
          "control_points", [](const D& d) { return d.parameters().options.control_points; },
          "N, of the splines over the phase")
      .def_property_readonly(
          "noise", [](const D& d) { return shown(d.parameters().noise); },
          "(parts,) standard deviation of a sample, of vectors and of rotations [rad]")
      .def_property_readonly(
          "weights", [](const D& d) { return shown(d.parameters().mean); },
          "(N * d,) mean of the weights, those of one control point together")
      .def_property_readonly(
          "covariance",
          [](const D& d) {
            const RowMatrix& factor = d.parameters().factor;
            return shown(RowMatrix(factor * factor.transpose()));
          },
          "(N * d, N * d) of the weights")
      .def_property_readonly(
          "reference", [](const D& d) { return shown(d.parameters().reference); },
          "(K, columns) the motion at even phases that the weights deviate from; rotations as w x y z")
      .def("__repr__", [](const D& d) {
        return std::string("<") + InPython<Space>::distribution + ": of " +
               std::to_string(d.parameters().demonstrations) + " demonstrations, " +
               std::to_string(d.parameters().options.control_points) + " control points, " +
               short_number(d.duration()) + " s>";
      });
}

template <class Space, class Class>
void def_conditioning(Class& distribution) {
  using D = Distribution<Space>;
  using Part = typename Space::Demonstration;
  distribution
      .def(
          "condition",
          [](const D& d, const std::vector<GivenAt>& given) { return d.condition(to_givens<Space>(given)); },
          py::arg("given"),
          "Of the motions that pass what is given: a list of Given, or a dict of points by their phases, "
          "which are passed exactly. Raises InvalidArgument, naming given[k], for phases, shapes or "
          "covariances out of range, and where nothing is left open: two exact points at one phase, or more "
          "of them than there are control points near by.")
      .def(
          "condition",
          [](const D& d, const std::map<double, py::object>& given) {
            std::vector<GivenAt> all;
            for (const auto& [phase, point] : given) all.push_back({phase, point, {}, {}, {}, {}});
            return d.condition(to_givens<Space>(all));
          },
          py::arg("given"))
      .def(
          "continued",
          [](const D& d, const Part& part, std::optional<double> duration, double phase,
             const std::optional<Array>& noise) {
            std::optional<Eigen::VectorXd> own;
            if (noise) own = to_vector(*noise, "noise");
            const py::gil_scoped_release release;
            return d.condition(part, duration, phase, own);
          },
          py::arg("part"), py::arg("duration") = py::none(), py::arg("phase") = 0.0,
          py::arg("noise") = py::none(),
          "Of the motions that go on from a recording of their beginning, or of a part from `phase` on, at "
          "the pace of `duration` (s, of the whole motion; the mean one unless given). `noise` (parts,): "
          "standard deviation of a sample; unless given that of the demonstrations, with a share of the "
          "variance there. Raises InvalidArgument where the part does not lie within the motion.")
      .def(
          "observation_covariance",
          [](const D& d, double phase) { return from_matrix(d.observation_covariance(phase)); },
          py::arg("phase"),
          "(d, d) how far an observed motion may lie from what the weights can say at a phase: for "
          "`covariance` of what was measured and not wished for.")
      .def(
          "distance",
          [](const D& d, const GivenAt& given) { return d.distance(to_given<Space>(given, "given")); },
          py::arg("given"),
          "How many standard deviations (Mahalanobis) what is given lies from the mean, noise included.");
}

template <class Space, class Class>
void def_distribution_motions(Class& distribution) {
  using D = Distribution<Space>;
  using Numbers = std::variant<double, Array>;
  distribution
      .def(
          "mean",
          [](const D& d, const std::optional<DmpOptions>& options, const py::kwargs& fields) {
            const DmpOptions chosen = options_with(options, fields);
            const py::gil_scoped_release release;
            return d.mean(chosen);
          },
          py::arg("options") = py::none(), "The mean as a primitive; options as its fit takes them.")
      .def("rollout", &D::rollout, py::arg("samples") = 101, py::call_guard<py::gil_scoped_release>(),
           "The mean motion over `duration`, at `samples` even times.")
      .def("sample", &D::sample, py::arg("seed") = 0, py::arg("samples") = 101,
           py::call_guard<py::gil_scoped_release>(), "One motion drawn from it; the same for the same seed.")
      .def("log_likelihood", &D::log_likelihood, py::arg("demonstration"),
           py::call_guard<py::gil_scoped_release>(),
           "Logarithm of the density of a demonstration, taken at t / its duration: of all its numbers, in "
           "the units of the demonstrations.")
      .def(
          "stiffness",
          [](const D& d, double phase, const Numbers& most, const Numbers& spread) {
            return from_matrix(d.stiffness(phase, for_axes(most, d.dimension(), "most"),
                                           for_axes(spread, d.dimension(), "spread")));
          },
          py::arg("phase"), py::arg("most"), py::arg("spread"),
          "(d, d) stiffness that is high where the demonstrations agree: no more than `most`, half of it "
          "where their standard deviation is `spread`. Both: a positive number, or (d,). Positive definite "
          "by construction; see damping_of.");
}

/// The distribution of a space, beside its demonstrations and models.
template <class Space>
void bind_distribution(py::module_& m) {
  using D = Distribution<Space>;
  static const std::string doc =
      std::string("A probabilistic movement primitive for ") + InPython<Space>::naming.moves +
      ": a motion and how it varies, learned from several demonstrations. Immutable.";
  py::class_<D> distribution(m, InPython<Space>::distribution, doc.c_str());
  distribution.def_static(
      "fit",
      [](const std::vector<typename Space::Demonstration>& demonstrations, int control_points, double prior,
         int iterations) {
        const py::gil_scoped_release release;
        return D::fit(demonstrations, {control_points, prior, iterations});
      },
      py::arg("demonstrations"), py::kw_only(),
      py::arg("control_points") = DistributionOptions{}.control_points,
      py::arg("prior") = DistributionOptions{}.prior,
      py::arg("iterations") = DistributionOptions{}.iterations,
      "Learns two or more demonstrations of one motion by expectation maximisation, each taken at t / its "
      "duration. control_points: of the cubic B-splines over the phase, 4 to 200; prior: weight of the "
      "inverse-Wishart prior, in demonstrations, 0.1 to 1000. Raises InvalidArgument, naming it, for a "
      "demonstration that does not belong to the others.");
  def_distribution_values<Space>(distribution);
  def_conditioning<Space>(distribution);
  def_distribution_motions<Space>(distribution);
  if constexpr (!std::is_same_v<Space, PoseGripperSpace>)  // whose spread Python does not have
    distribution.def(
        "spread", [](const D& d, Eigen::Index count) { return d.spread(count); }, py::arg("count") = 101,
        "Mean and covariance at `count` even phases, without the noise of samples; of rotations about the "
        "axes of the world.");
  distribution.def(py::pickle([](const D& d) { return to_json(dmp::Model(d)); },
                              [](const std::string& text) { return std::get<D>(from_json(text)); }));
  m.def(
      "save", [](const D& model, const std::filesystem::path& path) { save(model, path.string()); },
      py::arg("model"), py::arg("path"));
  m.def("to_json", [](const D& model) { return to_json(model); }, py::arg("model"));
  m.def(
      "blend",
      [](const std::vector<D>& distributions, const Array& weights) {
        return blend(distributions, to_vector(weights, "weights"));
      },
      py::arg("distributions"), py::arg("weights"),
      "The product of distributions to these powers (positive, one for each): what they agree on.");
}

}  // namespace dmp::python
