#pragma once

#include <dmp/dmp.hpp>
#include <dmp/pose_dmp.hpp>

#include <Eigen/Core>
#include <vector>

namespace dmp {

/// Where demonstrations of one motion lie over the phase, each taken at s = t / duration.
template <class Space>
struct SpreadOf {
  using Tangent = typename Space::Tangent;
  using Covariance = Eigen::Matrix<double, Tangent::RowsAtCompileTime, Tangent::RowsAtCompileTime>;
  Eigen::VectorXd phase;      ///< (K) 0 to 1
  typename Space::Path mean;  ///< (K) positions (K x d), rotations or poses
  /// (K) d x d, of one demonstration about the mean (divided by M - 1); of rotations the rotation vector from
  /// the mean, world frame
  std::vector<Covariance> covariance;
};
using Spread = SpreadOf<VectorSpace>;
using PoseSpread = SpreadOf<PoseSpace>;  ///< position and rotation vector: m and rad

namespace detail {
template <class Space>
DMP_EXPORT SpreadOf<Space> spread_of(const std::vector<typename Space::Demonstration>& demonstrations,
                                     Eigen::Index count);
}  // namespace detail

/// At `count` even phases (2 or more). With one demonstration the covariance is 0. Throws InvalidArgument for
/// none, or for demonstrations of different dimensions.
template <class Demonstration>
auto spread(const std::vector<Demonstration>& demonstrations, Eigen::Index count = 101) {
  return detail::spread_of<typename SpaceOf<Demonstration>::type>(demonstrations, count);
}
// For lists in braces, whose type no template can deduce.
inline Spread spread(const std::vector<Demonstration>& demonstrations, Eigen::Index count = 101) {
  return spread<Demonstration>(demonstrations, count);
}
inline PoseSpread spread(const std::vector<PoseDemonstration>& demonstrations, Eigen::Index count = 101) {
  return spread<PoseDemonstration>(demonstrations, count);
}

}  // namespace dmp
