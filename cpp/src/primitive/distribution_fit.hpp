#pragma once

#include <dmp/distribution.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <vector>

#include "primitive/control_points.hpp"
#include "primitive/weight_gaussian.hpp"

namespace dmp::detail {

/// A demonstration as deviations from the reference.
struct Deviation {
  Eigen::VectorXd phase;  ///< (T)
  RowMatrix value;        ///< (T x d)
};

/// Sums over a demonstration's samples: all that the regression needs of them.
struct SplineSums {
  Eigen::MatrixXd gram;  ///< (N x N) B^T B
  RowMatrix moment;      ///< (N x d) B^T y
};
SplineSums sums_of(const ControlPoints& points, const Deviation& deviation);

/// B^T Q^-1 B and B^T Q^-1 y for noise of these variances (d).
Information information_of(const SplineSums& sums, const Eigen::VectorXd& variance);

/// Weights and noise of a distribution.
struct WeightFit {
  WeightGaussian weights;
  Eigen::VectorXd noise;  ///< (parts) standard deviation
};

/// Learns them by expectation maximisation with an inverse-Wishart prior that ties the axes of a control
/// point. parts: sizes of the groups of axes that share a unit; extent (parts): of their motion, in that
/// unit, not 0.
WeightFit fit_weights(const ControlPoints& points, const std::vector<Deviation>& deviations,
                      const std::vector<Eigen::Index>& parts, const Eigen::VectorXd& extent,
                      const DistributionOptions& options);

/// A number of each part, for each of its axes.
Eigen::VectorXd by_axis(const Eigen::VectorXd& of_parts, const std::vector<Eigen::Index>& parts);

}  // namespace dmp::detail
