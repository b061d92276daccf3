#pragma once

#include <dmp/forcing.hpp>

#include <Eigen/Core>
#include <vector>

#include "primitive/normal_equations.hpp"

namespace dmp::detail {

/// Fits forcing terms with the same options one after another: fit_forcing with a memory for phases.
class ForcingFit {
 public:
  /// `options` with every optional one given.
  ForcingFit(const GaussianBasis& basis, const DmpOptions& options, Eigen::Index dimension);

  Eigen::Index dimension() const noexcept { return together_.axes(); }
  RowMatrix weights(const std::vector<ForcingTarget>& targets);

 private:
  RowMatrix round(const std::vector<ForcingTarget>& targets) const;
  RowMatrix solve(NormalEquations& equations, const std::vector<ForcingTarget>& targets,
                  Eigen::Index first) const;

  GaussianBasis basis_;
  DmpOptions options_;
  NormalEquations together_;  // all axes
  NormalEquations alone_;     // one, where scales differ
};

/// Largest over smallest eigenvalue of the Gram matrix of periodic kernels with the ridge, for even samples.
double round_condition(const GaussianBasis& basis, double ridge);

}  // namespace dmp::detail
