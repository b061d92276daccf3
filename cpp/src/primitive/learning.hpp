#pragma once

#include <dmp/basis.hpp>
#include <dmp/forcing.hpp>
#include <dmp/options.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <utility>

namespace dmp::detail {

// How a demonstration is turned into a target of the forcing term, as far as all spaces do it alike.

GaussianBasis basis_of(const DmpOptions& resolved);

/// Where a demonstration is sampled for the fit: at its samples, or, where they are few for the kernels, at
/// ten points a kernel. `time` (T) s from 0.
Eigen::VectorXd fit_times(const Eigen::VectorXd& time, const DmpOptions& options);

/// How many samples of a cycle are looked at: its own, or ten a kernel.
inline Eigen::Index cycle_samples(Eigen::Index size, const DmpOptions& options) {
  return std::max<Eigen::Index>(10 * static_cast<Eigen::Index>(options.basis_count), size - 1);
}

/// Rates of the rows of y by second-order differences: central inside, one-sided at the ends; any grid.
RowMatrix gradient(const Eigen::VectorXd& t, const RowMatrix& y);

/// tau^2 acceleration - alpha (beta error - tau velocity); `error` may be an expression.
template <class Error>
RowMatrix forcing_of(double tau, double alpha, double beta, RowMatrix acceleration, const Error& error,
                     const RowMatrix& velocity) {
  acceleration = tau * tau * acceleration - alpha * (beta * error - tau * velocity);
  return acceleration;
}

/// Sets a target's scale (its axes from `first` on) after the scaling that the options name: the forcing of a
/// demonstration whose displacement is `displacement`, in a model whose displacement is `reference`.
void apply_scaling(ForcingTarget& target, Eigen::Index first, const Eigen::VectorXd& displacement,
                   const Eigen::VectorXd& reference, const Eigen::VectorXd& amplitude,
                   const DmpOptions& options);

}  // namespace dmp::detail
