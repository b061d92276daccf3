#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// Weights w ~ N(mean, F F^T). With the factor, the covariance is positive semidefinite whatever is done.
struct WeightGaussian {
  Eigen::VectorXd mean;    ///< (n)
  Eigen::MatrixXd factor;  ///< (n x n) F
};

/// Observations o = H w + N(0, R R^T).
struct LinearObservation {
  Eigen::MatrixXd rows;       ///< (m x n) H
  Eigen::VectorXd value;      ///< (m) o
  Eigen::MatrixXd deviation;  ///< (m x m) R, lower triangle; zero if exact
};

/// Many observations summed up: H^T Q^-1 H and H^T Q^-1 o.
struct Information {
  Eigen::MatrixXd matrix;  ///< (n x n)
  Eigen::VectorXd vector;  ///< (n)
};

/// The Gaussian given the observation, by the square root update of Andrews 1968 (AIAA Journal 6). False,
/// with nothing changed, where it leaves nothing open: a combination of the rows has no variance.
bool condition(WeightGaussian& weights, const LinearObservation& seen);
/// The same for observations summed up.
void condition(WeightGaussian& weights, const Information& seen);

/// -2 log N(r; 0, H F F^T H^T + Q) less the constant, of r = o - H mean and seen = {H^T Q^-1 H, H^T Q^-1 r}:
/// what the weights change of |r|^2 over Q plus log det Q.
double deviance_change(const Eigen::MatrixXd& factor, const Information& seen);

}  // namespace dmp::detail
