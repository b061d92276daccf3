#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/export.hpp>

#include <Eigen/Core>
#include <vector>

namespace dmp {

/// Where demonstrations of one motion lie over the phase, each taken at s = t / duration.
struct Spread {
  Eigen::VectorXd phase;  ///< (K) 0 to 1
  RowMatrix mean;         ///< (K x d)
  std::vector<Eigen::MatrixXd>
      covariance;  ///< (K) d x d, of one demonstration about the mean (divided by M - 1)
};

/// The same for poses: mean [R p; 0 1] and the covariance of (p, rotation vector from the mean, world frame),
/// m and rad.
struct PoseSpread {
  Eigen::VectorXd phase;
  Poses mean;
  std::vector<Eigen::Matrix<double, 6, 6>> covariance;
};

/// At `count` even phases (2 or more). With one demonstration the covariance is 0. Throws InvalidArgument for
/// none, or for demonstrations of different dimensions.
DMP_EXPORT Spread spread(const std::vector<Demonstration>& demonstrations, Eigen::Index count = 101);
DMP_EXPORT PoseSpread spread(const std::vector<PoseDemonstration>& demonstrations, Eigen::Index count = 101);

}  // namespace dmp
