#include <dmp/error.hpp>
#include <dmp/options.hpp>

#include <cmath>
#include <string>
#include <tuple>

#include "base/text.hpp"
#include "primitive/forcing_scale.hpp"
#include "primitive/option_fields.hpp"

namespace dmp {
namespace {

using detail::number;

void require_positive(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0.0))
    throw InvalidArgument(std::string("options.") + name + ": " + number(value) +
                          ", expected a positive number.");
}

void require_not_negative(double value, const char* name) {
  if (!(std::isfinite(value) && value >= 0.0))
    throw InvalidArgument(std::string("options.") + name + ": " + number(value) +
                          ", expected 0 or a positive number.");
}

/// What bounds the internal steps of a run, and so its cost.
void require_at_most(double value, double most, const char* name) {
  if (value > most)
    throw InvalidArgument(std::string("options.") + name + ": " + number(value) + ", expected at most " +
                          number(most) + ".");
}

/// What a rhythmic motion has no choice in.
DmpOptions without_ends(const DmpOptions& options) {
  DmpOptions result = options;
  const auto refuse = [](const char* name, const char* expected) {
    throw InvalidArgument(std::string("options.") + name +
                          ": a rhythmic motion has neither start nor goal, expected " + expected + ".");
  };
  if (options.scaling != Scaling::none && options.scaling != Scaling::advance &&
      options.scaling != Scaling::automatic)
    refuse("scaling", "none");
  if (options.kernels != Kernels::equal_in_time) refuse("kernels", "equal_in_time");
  if (options.log_branch != LogBranch::lifted) refuse("log_branch", "lifted");
  if (options.derivatives == Derivatives::gradient) refuse("derivatives", "automatic, interpolate or smooth");
  if (options.orientation_form != OrientationForm::automatic &&
      options.orientation_form != OrientationForm::turning)
    refuse("orientation_form", "turning");
  result.scaling = Scaling::none;
  return result;
}

/// Throws InvalidArgument for an enumerator outside its enumeration; lets all else pass.
struct EnumeratorCheck {
  template <class Value>
  void operator()(const char*, const Value&) const {}
  template <class Enum>
  void operator()(const char* name, Enum value, const Names<Enum>& names) const {
    for (const auto& [known, text] : names)
      if (known == value) return;
    throw InvalidArgument(std::string("options.") + name + ": " + std::to_string(static_cast<int>(value)) +
                          " is none of its enumerators.");
  }
};

void require_whole(int value, int most, const char* name, const char* of) {
  if (value < 1 || value > most)
    throw InvalidArgument(std::string("options.") + name + ": " + std::to_string(value) + ", expected 1 to " +
                          std::to_string(most) + of + ".");
}

}  // namespace

bool operator==(const DmpOptions& a, const DmpOptions& b) noexcept {
  const auto same = [&](const auto&... field) { return ((a.*field.second == b.*field.second) && ...); };
  return a.motion == b.motion && std::apply(same, DmpOptions::fields());
}

void DmpOptions::validate() const { resolved(); }

bool DmpOptions::automatic() const noexcept {
  return basis_count == 0 || regression == Regression::automatic || derivatives == Derivatives::automatic;
}

DmpOptions DmpOptions::resolved() const {
  detail::visit_options(EnumeratorCheck{}, *this);
  EnumeratorCheck{}("motion", motion, names_of(motion));
  DmpOptions result = motion == Motion::rhythmic ? without_ends(*this) : *this;
  if (basis_count != 0) require_whole(basis_count, 100000, "basis_count", " kernels");
  require_whole(passes, 10000, "passes", "");
  if (orientation_form == OrientationForm::turning && detail::multiplies(scaling))
    throw InvalidArgument(
        "options.scaling: OrientationForm::turning has no way from start to goal to scale by, expected "
        "advance or none.");
  result.beta = beta.value_or(alpha / 4.0);
  result.orientation_alpha = orientation_alpha.value_or(alpha);
  result.orientation_beta =
      orientation_beta.value_or(orientation_alpha ? *orientation_alpha / 4.0 : *result.beta);
  result.overlap = overlap.value_or(regression == Regression::lwr ? std::log(2.0) : 0.2);
  require_at_most(result.alpha, 1e4, "alpha");
  require_at_most(*result.orientation_alpha, 1e4, "orientation_alpha");
  require_at_most(result.goal_filter, 1e4, "goal_filter");
  require_at_most(result.alpha_x, 50.0, "alpha_x");
  require_positive(result.alpha, "alpha");
  require_positive(*result.beta, "beta");
  require_positive(*result.orientation_alpha, "orientation_alpha");
  require_positive(*result.orientation_beta, "orientation_beta");
  require_positive(result.alpha_x, "alpha_x");
  require_positive(*result.overlap, "overlap");
  require_at_most(*result.overlap, 300.0, "overlap");
  require_not_negative(result.ridge, "ridge");
  require_not_negative(result.goal_filter, "goal_filter");
  require_not_negative(result.tempo_filter, "tempo_filter");
  require_not_negative(result.phase_stop, "phase_stop");
  return result;
}

DmpOptions DmpOptions::source() {
  DmpOptions options;
  options.basis_count = 100;
  options.alpha = 25.0;
  options.beta = 4.0;
  options.orientation_alpha = 10.0;
  options.orientation_beta = 4.0;
  options.alpha_x = 1.0;
  options.kernels = Kernels::source;
  options.regression = Regression::lwr;
  options.passes = 1;
  options.scaling = Scaling::per_axis;
  options.scaling_guard = false;
  options.orientation_form = OrientationForm::ude;
  options.log_branch = LogBranch::principal;
  options.derivatives = Derivatives::gradient;
  options.start = Start::rest;
  options.integrator = Integrator::semi_implicit_euler;
  options.force_after_end = true;
  options.goal_filter = 0.0;
  options.tempo_filter = 0.0;
  return options;
}

}  // namespace dmp
