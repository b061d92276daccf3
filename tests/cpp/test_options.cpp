// Options are values: compared field by field, validated by name, completed by their defaults.
#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/options.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

using namespace dmp;

namespace {

const std::vector<std::function<void(DmpOptions&)>> kChanges{
    [](DmpOptions& o) { o.basis_count = 7; },
    [](DmpOptions& o) { o.alpha = 20.0; },
    [](DmpOptions& o) { o.beta = 6.25; },  // what it is by default, but stated
    [](DmpOptions& o) { o.orientation_alpha = 25.0; },
    [](DmpOptions& o) { o.orientation_beta = 6.25; },
    [](DmpOptions& o) { o.alpha_x = 3.0; },
    [](DmpOptions& o) { o.kernels = Kernels::source; },
    [](DmpOptions& o) { o.overlap = 0.5; },
    [](DmpOptions& o) { o.regression = Regression::ridge; },
    [](DmpOptions& o) { o.passes = 3; },
    [](DmpOptions& o) { o.ridge = 1e-9; },
    [](DmpOptions& o) { o.scaling = Scaling::per_axis; },
    [](DmpOptions& o) { o.scaling_guard = false; },
    [](DmpOptions& o) { o.orientation_form = OrientationForm::ude; },
    [](DmpOptions& o) { o.log_branch = LogBranch::principal; },
    [](DmpOptions& o) { o.derivatives = Derivatives::smooth; },
    [](DmpOptions& o) { o.start = Start::rest; },
    [](DmpOptions& o) { o.integrator = Integrator::semi_implicit_euler; },
    [](DmpOptions& o) { o.force_after_end = true; },
    [](DmpOptions& o) { o.goal_filter = 10.0; },
    [](DmpOptions& o) { o.tempo_filter = 0.2; },
    [](DmpOptions& o) { o.phase_stop = 1.0; },
};

std::string refusal_of(const DmpOptions& options) {
  try {
    options.validate();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("options are equal if all their fields are, and any one of them tells two apart") {
  CHECK(DmpOptions{} == DmpOptions{});
  for (const auto& change : kChanges) {
    DmpOptions changed;
    change(changed);
    CHECK(changed == changed);
    CHECK(changed != DmpOptions{});
    for (const auto& other : kChanges) {
      DmpOptions differently;
      other(differently);
      CHECK((&change == &other) == (changed == differently));
    }
  }
}

TEST_CASE("resolved options state every optional field, and resolving them again changes nothing") {
  DmpOptions options;
  options.alpha = 40.0;
  options.orientation_alpha = 20.0;
  const DmpOptions resolved = options.resolved();
  CHECK(resolved.beta == 10.0);
  CHECK(resolved.orientation_alpha == 20.0);
  CHECK(resolved.orientation_beta == 5.0);
  CHECK(resolved.overlap == 0.2);
  options.regression = Regression::lwr;
  CHECK(options.resolved().overlap == std::log(2.0));
  CHECK(resolved.resolved() == resolved);
  CHECK(resolved != options);
}

TEST_CASE("validate names the field that is out of range") {
  CHECK(refusal_of({}) == "");
  CHECK(refusal_of(DmpOptions::source()) == "");
  DmpOptions options;
  options.basis_count = -1;
  CHECK(refusal_of(options) == "options.basis_count: -1, expected 1 to 100000 kernels.");
  options = {};
  options.passes = 10001;
  CHECK(refusal_of(options) == "options.passes: 10001, expected 1 to 10000.");
  options = {};
  options.beta = -1.0;
  CHECK(refusal_of(options).rfind("options.beta: -1", 0) == 0);
  options = {};
  options.tempo_filter = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal_of(options).rfind("options.tempo_filter: nan", 0) == 0);
}

TEST_CASE("every option has a name of its own, and so has every value of an enumeration") {
  std::vector<std::string> names;
  std::apply([&](const auto&... field) { (names.push_back(field.first), ...); }, DmpOptions::fields());
  CHECK(names.size() == 22);
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
  const auto complete = [](auto last) {
    int next = 0;
    for (const auto& [value, name] : names_of(last)) CHECK(static_cast<int>(value) == next++);
    return next == static_cast<int>(last) + 1;
  };
  CHECK(complete(Kernels::source));
  CHECK(complete(Regression::automatic));
  CHECK(complete(Scaling::automatic));
  CHECK(complete(OrientationForm::turning));
  CHECK(complete(LogBranch::principal));
  CHECK(complete(Derivatives::automatic));
  CHECK(complete(Start::rest));
  CHECK(complete(Integrator::semi_implicit_euler));
}
