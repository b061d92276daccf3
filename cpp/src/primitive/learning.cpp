#include "primitive/learning.hpp"

#include <dmp/error.hpp>

#include <cmath>
#include <string>

#include "base/text.hpp"
#include "primitive/forcing_scale.hpp"

namespace dmp::detail {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Without a guard (g - y0) scales only an axis that ends elsewhere than it starts, measured by the range it
/// covers.
void require_displacement(const VectorXd& displacement, const VectorXd& amplitude) {
  for (Index d = 0; d < displacement.size(); ++d)
    if (amplitude[d] > 0.0 && std::abs(displacement[d]) < 1e-9 * amplitude[d])
      throw InvalidArgument("scaling: axis " + std::to_string(d) + " of the demonstration ends " +
                            number(displacement[d]) + " from its start and covers " + number(amplitude[d]) +
                            ", so (goal - start) cannot scale its forcing term. Set "
                            "options.scaling_guard, or use Scaling::advance.");
}

}  // namespace

GaussianBasis basis_of(const DmpOptions& options) {
  if (options.motion == Motion::rhythmic)
    return GaussianBasis::periodic(options.basis_count, *options.overlap);
  if (options.kernels == Kernels::source) return GaussianBasis::source(options.basis_count, options.alpha_x);
  return GaussianBasis::equal_in_time(options.basis_count, options.alpha_x, *options.overlap);
}

VectorXd fit_times(const VectorXd& time, const DmpOptions& options) {
  const Index wanted = 10 * static_cast<Index>(options.basis_count) + 1;
  if (options.derivatives == Derivatives::gradient || time.size() >= wanted - 1) return time;
  return VectorXd::LinSpaced(wanted, 0.0, time[time.size() - 1]);
}

RowMatrix gradient(const VectorXd& t, const RowMatrix& y) {
  const Index n = t.size();
  RowMatrix rate(n, y.cols());
  rate.row(0) = (y.row(1) - y.row(0)) / (t[1] - t[0]);
  rate.row(n - 1) = (y.row(n - 1) - y.row(n - 2)) / (t[n - 1] - t[n - 2]);
  for (Index k = 1; k + 1 < n; ++k) {
    const double before = t[k] - t[k - 1];
    const double after = t[k + 1] - t[k];
    rate.row(k) = (before / after * (y.row(k + 1) - y.row(k)) + after / before * (y.row(k) - y.row(k - 1))) /
                  (before + after);
  }
  return rate;
}

void apply_scaling(ForcingTarget& target, Index first, const VectorXd& displacement,
                   const VectorXd& reference, const VectorXd& amplitude, const DmpOptions& options) {
  if (!multiplies(options.scaling)) return;
  const Index axes = displacement.size();
  if (options.scaling == Scaling::per_axis && !options.scaling_guard)
    require_displacement(displacement, amplitude);
  ForcingScale scale(options, reference, amplitude);
  scale.set(displacement);
  if (options.scaling != Scaling::rotation_dilation) {
    scale.apply(target.scale.segment(first, axes).data());
    return;
  }
  // target = c R f: turned back by R^T (the rotation of the inverse way), scaled by c on every axis.
  if (!scale.rotates() || displacement.norm() <= 1e-3 * amplitude.norm()) return;
  DmpOptions plainly = options;
  plainly.scaling_guard = false;
  ForcingScale back(plainly, displacement, amplitude);
  back.set(reference);
  for (Index k = 0; k < target.value.rows(); ++k) back.apply(target.value.row(k).data() + first);
  target.value.middleCols(first, axes) *= displacement.norm() / reference.norm();  // back.apply divided by it
  target.scale.segment(first, axes).setConstant(scale.dilation());
}

}  // namespace dmp::detail
