#include <dmp/options.hpp>

namespace dmp {

DmpOptions DmpOptions::source() {
  DmpOptions options;
  options.basis_count = 100;
  options.alpha = 25.0;
  options.beta = 4.0;
  options.orientation_alpha = 10.0;
  options.orientation_beta = 4.0;
  options.alpha_x = 1.0;
  options.kernels = Kernels::source;
  options.passes = 1;
  options.scaling = Scaling::per_axis;
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
