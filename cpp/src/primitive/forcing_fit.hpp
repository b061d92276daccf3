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
  RowMatrix solve(NormalEquations& equations, const std::vector<ForcingTarget>& targets,
                  Eigen::Index first) const;

  DmpOptions options_;
  NormalEquations together_;  // all axes
  NormalEquations alone_;     // one, where scales differ
};

}  // namespace dmp::detail
