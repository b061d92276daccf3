#pragma once

#include <dmp/options.hpp>

#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace dmp::detail {

/// The names that the values of an enumeration have in a file.
template <class Enum>
using Names = std::vector<std::pair<Enum, const char*>>;

inline const Names<Kernels>& names_of(Kernels) {
  static const Names<Kernels> names{{Kernels::equal_in_time, "equal_in_time"}, {Kernels::source, "source"}};
  return names;
}
inline const Names<Regression>& names_of(Regression) {
  static const Names<Regression> names{
      {Regression::lwr, "lwr"}, {Regression::ridge, "ridge"}, {Regression::automatic, "automatic"}};
  return names;
}
inline const Names<Scaling>& names_of(Scaling) {
  static const Names<Scaling> names{{Scaling::none, "none"},
                                    {Scaling::per_axis, "per_axis"},
                                    {Scaling::per_axis_relative, "per_axis_relative"},
                                    {Scaling::rotation_dilation, "rotation_dilation"}};
  return names;
}
inline const Names<OrientationForm>& names_of(OrientationForm) {
  static const Names<OrientationForm> names{{OrientationForm::automatic, "automatic"},
                                            {OrientationForm::ude, "ude"},
                                            {OrientationForm::log_linear, "log_linear"},
                                            {OrientationForm::turning, "turning"}};
  return names;
}
inline const Names<LogBranch>& names_of(LogBranch) {
  static const Names<LogBranch> names{{LogBranch::lifted, "lifted"}, {LogBranch::principal, "principal"}};
  return names;
}
inline const Names<Derivatives>& names_of(Derivatives) {
  static const Names<Derivatives> names{{Derivatives::interpolate, "interpolate"},
                                        {Derivatives::smooth, "smooth"},
                                        {Derivatives::gradient, "gradient"},
                                        {Derivatives::automatic, "automatic"}};
  return names;
}
inline const Names<Start>& names_of(Start) {
  static const Names<Start> names{{Start::demonstrated, "demonstrated"}, {Start::rest, "rest"}};
  return names;
}
inline const Names<Integrator>& names_of(Integrator) {
  static const Names<Integrator> names{{Integrator::exact, "exact"},
                                       {Integrator::semi_implicit_euler, "semi_implicit_euler"}};
  return names;
}

/// Every option once, by its name in a model file: files, comparison and checks go by this list.
constexpr auto option_fields() {
  using O = DmpOptions;
  return std::make_tuple(
      std::pair("basis_count", &O::basis_count), std::pair("alpha", &O::alpha), std::pair("beta", &O::beta),
      std::pair("orientation_alpha", &O::orientation_alpha),
      std::pair("orientation_beta", &O::orientation_beta), std::pair("alpha_x", &O::alpha_x),
      std::pair("kernels", &O::kernels), std::pair("overlap", &O::overlap),
      std::pair("regression", &O::regression), std::pair("passes", &O::passes), std::pair("ridge", &O::ridge),
      std::pair("scaling", &O::scaling), std::pair("orientation_form", &O::orientation_form),
      std::pair("log_branch", &O::log_branch), std::pair("derivatives", &O::derivatives),
      std::pair("start", &O::start), std::pair("integrator", &O::integrator),
      std::pair("force_after_end", &O::force_after_end), std::pair("goal_filter", &O::goal_filter),
      std::pair("tempo_filter", &O::tempo_filter), std::pair("phase_stop", &O::phase_stop));
}

template <class Visitor, class Field>
void visit_option(const Visitor& visit, const char* name, Field& field) {
  if constexpr (std::is_enum_v<std::remove_const_t<Field>>) {
    visit(name, field, names_of(field));
  } else {
    visit(name, field);
  }
}

/// Calls visit(name, field) for every option, or visit(name, field, names) for an enumeration.
template <class Visitor, class Options>
void visit_options(const Visitor& visit, Options& options) {
  std::apply([&](const auto&... field) { (visit_option(visit, field.first, options.*field.second), ...); },
             option_fields());
}

}  // namespace dmp::detail
