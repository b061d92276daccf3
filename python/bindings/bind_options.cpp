#include "options.hpp"

#include <pybind11/native_enum.h>
#include <pybind11/stl.h>
#include <dmp/error.hpp>

#include "bind.hpp"
#include "values.hpp"

namespace dmp::python {
namespace {

/// An attribute that takes an enumerator or its name.
template <class Enum>
void enum_attribute(py::class_<DmpOptions>& options, const char* name, Enum DmpOptions::* member,
                    const char* doc) {
  options.def_property(
      name, [member](const DmpOptions& o) { return o.*member; },
      [member, name](DmpOptions& o, const py::object& value) {
        const py::object type = py::type::of(py::cast(Enum{}));
        if (py::isinstance(value, type)) {
          o.*member = value.cast<Enum>();
          return;
        }
        const py::dict members = type.attr("__members__");
        if (!py::isinstance<py::str>(value) || !members.contains(value))
          throw InvalidArgument(std::string(name) + ": " + py::repr(value).cast<std::string>() +
                                " is unknown, expected one of " +
                                py::str(", ").attr("join")(py::list(members)).cast<std::string>() + ".");
        o.*member = py::object(members[value]).cast<Enum>();
      },
      doc);
}

template <class Enum>
void bind_enum(py::module_& m, const char* name, const char* doc) {
  py::native_enum<Enum> type(m, name, "enum.Enum", doc);
  for (const auto& [value, text] : names_of(Enum{})) type.value(text, value);
  type.finalize();
}

void bind_enums(py::module_& m) {
  bind_enum<Kernels>(m, "Kernels", "How the kernels lie over the phase.");
  bind_enum<Regression>(m, "Regression", "How the weights are found.");
  bind_enum<Scaling>(m, "Scaling",
                     "How the forcing term follows when start and goal change; automatic: advance.");
  bind_enum<OrientationForm>(m, "OrientationForm", "The equation of motion of orientations.");
  bind_enum<Motion>(m, "Motion",
                    "From a start to a goal, or round and round about a centre, which is the goal then.");
  bind_enum<LogBranch>(m, "LogBranch", "Log(Rg R^T) followed through pi, or the shortest rotation.");
  bind_enum<Derivatives>(m, "Derivatives", "Velocities and accelerations of a demonstration.");
  bind_enum<Start>(m, "Start", "What a rollout starts with.");
  bind_enum<Integrator>(m, "Integrator", "How a run steps.");
}

void set_fields(DmpOptions& options, const py::kwargs& fields) {
  py::object wrapped = py::cast(options);
  for (const auto& [key, value] : fields) {
    if (!is_field<DmpOptions>(key))
      throw InvalidArgument("options: '" + key.cast<std::string>() +
                            "' is unknown. See help(dmpcpp.DmpOptions).");
    try {
      py::setattr(wrapped, key, value);
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_TypeError)) throw;
      throw InvalidArgument("options." + key.cast<std::string>() + ": " +
                            py::repr(value).cast<std::string>() +
                            " is of the wrong type. See help(dmpcpp.DmpOptions).");
    } catch (const py::cast_error&) {
      throw InvalidArgument("options." + key.cast<std::string>() + ": " +
                            py::repr(value).cast<std::string>() +
                            " is of the wrong type. See help(dmpcpp.DmpOptions).");
    }
  }
  options = wrapped.cast<DmpOptions>();
}

}  // namespace

DmpOptions options_with(const std::optional<DmpOptions>& options, const py::kwargs& fields) {
  DmpOptions result = options.value_or(DmpOptions{});
  set_fields(result, fields);
  return result;
}

void bind_options(py::module_& m) {
  bind_enums(m);
  py::class_<DmpOptions> options(
      m, "DmpOptions", "Every choice there is in a Dmp, OrientationDmp or PoseDmp. The defaults reproduce.");
  options
      .def(py::init([](const py::kwargs& fields) { return options_with(std::nullopt, fields); }),
           "The fields as keywords; enumerators also by name: DmpOptions(regression=\"ridge\").")
      .def_static("source", &DmpOptions::source,
                  "The equations of the thesis proposal of 2019, read at tau = 1 with its errata E1, E6 and "
                  "E7 fixed.")
      .def("validate", &DmpOptions::validate,
           "Raises InvalidArgument, naming the field, for one outside its range.")
      .def_readwrite("basis_count", &DmpOptions::basis_count,
                     "N, kernels; 0: as many as the demonstrations need")
      .def_readwrite("alpha", &DmpOptions::alpha, "spring and damper: tau zd = alpha (beta (g - y) - z) + f")
      .def_readwrite("beta", &DmpOptions::beta, "alpha / 4 unless given: critically damped")
      .def_readwrite("orientation_alpha", &DmpOptions::orientation_alpha, "alpha unless given")
      .def_readwrite("orientation_beta", &DmpOptions::orientation_beta,
                     "beta unless given; orientation_alpha / 4 if only that is given")
      .def_readwrite("alpha_x", &DmpOptions::alpha_x, "decay of the phase variable")
      .def_readwrite("overlap", &DmpOptions::overlap,
                     "neighbours cross at exp(-overlap / 4); ln 2 (lwr), 0.2 (ridge)")
      .def_readwrite("passes", &DmpOptions::passes, "of locally weighted regression; 1 is the textbook's")
      .def_readwrite("ridge", &DmpOptions::ridge, "times trace / N on the diagonal")
      .def_readwrite(
          "scaling_guard", &DmpOptions::scaling_guard,
          "a scaling that multiplies gives way to advance where its ratio is badly conditioned; see "
          "scaling_notes of a model")
      .def_readwrite("force_after_end", &DmpOptions::force_after_end,
                     "the forcing term goes on after the duration")
      .def_readwrite("goal_filter", &DmpOptions::goal_filter,
                     "a new goal is approached by tau gd = goal_filter (g* - g)")
      .def_readwrite(
          "tempo_filter", &DmpOptions::tempo_filter,
          "s, time constant with which a change of tempo (duration, pause, phase stop) is approached")
      .def_readwrite("phase_stop", &DmpOptions::phase_stop,
                     "k: a tracking error e slows the phase to 1 / (tau (1 + k e))");
  enum_attribute(options, "kernels", &DmpOptions::kernels, "a Kernels or its name");
  enum_attribute(options, "regression", &DmpOptions::regression, "a Regression or its name");
  enum_attribute(options, "scaling", &DmpOptions::scaling, "a Scaling or its name");
  enum_attribute(options, "orientation_form", &DmpOptions::orientation_form,
                 "an OrientationForm or its name");
  enum_attribute(options, "log_branch", &DmpOptions::log_branch, "a LogBranch or its name");
  enum_attribute(options, "derivatives", &DmpOptions::derivatives, "a Derivatives or its name");
  enum_attribute(options, "start", &DmpOptions::start, "a Start or its name");
  enum_attribute(
      options, "motion", &DmpOptions::motion,
      "a Motion or its name; rhythmic: a demonstration is one cycle, its last sample the first one again "
      "(find_cycle), its duration the period");
  enum_attribute(options, "integrator", &DmpOptions::integrator, "an Integrator or its name");
  def_fields(options);
}

}  // namespace dmp::python
