#pragma once

#include <dmp/export.hpp>
#include <dmp/pose_gripper_dmp.hpp>
#include <dmp/primitive.hpp>
#include <dmp/spread.hpp>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace dmp {

/// How a Distribution is learned.
struct DistributionOptions {
  int control_points = 14;  ///< N of the cubic B-splines over the phase, 4 to 200
  /// Weight nu of the inverse-Wishart prior, in demonstrations: it ties the axes of one control point
  /// together, but no two control points. 0.1 to 1000.
  double prior = 8.0;
  int iterations = 20;  ///< of expectation maximisation, 1 to 1000
};

/// What is known of a motion at a phase: a point, a velocity or both, of all its axes or of some.
template <class Space>
struct Given {
  using Point = typename Space::Point;
  using Tangent = typename Space::Tangent;

  Given(double at, const std::optional<Point>& where, const std::optional<Tangent>& how_fast = {})
      : phase(at), point(where), velocity(how_fast) {}

  double phase;                     ///< 0 to 1
  std::optional<Point> point;       ///< position, rotation or pose
  std::optional<Tangent> velocity;  ///< (d) per s; rotations in rad/s, world frame
  /// (d x d) of the point, of rotations about the axes of the world; exact unless given.
  std::optional<Eigen::MatrixXd> covariance;
  std::optional<Eigen::MatrixXd> velocity_covariance;  ///< (d x d) of the velocity; exact unless given
  std::vector<Eigen::Index> axes;  ///< that are known, 0 to d - 1; all if empty. Positions come first.
};

/// All that a Distribution is: what a model file holds. n = N d weights, those of one control point together.
template <class Space>
struct DistributionParameters {
  DistributionOptions options;
  Eigen::Index demonstrations = 2;  ///< M that it was learned from
  double duration = 1.0;            ///< s, mean of theirs
  /// (K x columns) the motion at even phases that the weights deviate from: positions; rotations as w x y z.
  RowMatrix reference;
  Eigen::VectorXd mean;   ///< (n) of the weights
  RowMatrix factor;       ///< (n x n) F: the covariance of the weights is F F^T
  Eigen::VectorXd noise;  ///< (parts) standard deviation of a sample, of vectors and of rotations, m or rad
};

/// A probabilistic movement primitive: a motion and how it varies, learned from several demonstrations, each
/// taken at s = t / duration (Paraschos et al. 2018, Autonomous Robots 42; the prior after Gomez-Gonzalez et
/// al. 2020, IEEE T-RO 36).
///
///   y(s) = Exp(B(s) w) y_ref(s) + noise,   w ~ N(mean, F F^T)
///
/// B: cubic B-splines. Of rotations B(s) w is a rotation vector in the world frame, so that no orientation
/// and no number of turns is special; of vectors Exp(v) y is v + y. Immutable. The covariance is positive
/// semidefinite by construction, and all results are the same in every unit, but for rounding.
template <class Space>
class DMP_EXPORT Distribution {
 public:
  using Point = typename Space::Point;
  using Tangent = typename Space::Tangent;
  using Demonstration = typename Space::Demonstration;
  using Trajectory = typename Space::Trajectory;
  using Parameters = DistributionParameters<Space>;
  using Covariance = typename SpreadOf<Space>::Covariance;

  /// By expectation maximisation. The covariance is widened for what M demonstrations leave open of the mean
  /// and of itself. Throws InvalidArgument, naming it, for options out of range, fewer than two
  /// demonstrations, different dimensions, and demonstrations that do not belong together: one that goes
  /// another way than all others, or lies 150 deg from their mean.
  static Distribution fit(const std::vector<Demonstration>& demonstrations,
                          const DistributionOptions& options = {});
  /// Throws InvalidArgument, naming the field, for wrong sizes or numbers that are not finite.
  explicit Distribution(const Parameters& parameters);

  const Parameters& parameters() const noexcept;
  double duration() const noexcept { return parameters().duration; }  ///< s
  Eigen::Index dimension() const noexcept;                            ///< d

  /// Of the motions that pass what is given. Throws InvalidArgument, naming given[k], for phases, sizes or
  /// covariances out of range, and where nothing is left open: two exact points at one phase, or more of
  /// them than there are control points near by.
  Distribution condition(const std::vector<Given<Space>>& given) const;
  /// Of the motions that go on from a recording of their beginning, or of a part from `phase` on, at the pace
  /// of `duration` (s, of the whole motion; the mean one unless given). `noise` (parts) is the standard
  /// deviation of a sample; unless given that of the demonstrations with `observation_covariance`.
  Distribution condition(const Demonstration& part, std::optional<double> duration = {}, double phase = 0.0,
                         const std::optional<Eigen::VectorXd>& noise = {}) const;
  /// (d x d) how far an observed motion may lie from what the weights can say at a phase: the noise of a
  /// sample and a share of the variance there. For Given::covariance of what was measured.
  Eigen::MatrixXd observation_covariance(double phase) const;
  /// How many standard deviations (Mahalanobis) what is given lies from the mean, noise included.
  double distance(const Given<Space>& given) const;

  /// The mean as a primitive.
  Primitive<Space> mean(const DmpOptions& options = {}) const;
  /// The mean motion over `duration`, at `samples` even times (2 or more).
  Trajectory rollout(Eigen::Index samples = 101) const;
  /// One motion drawn from it; the same for the same seed on every machine, but for rounding.
  Trajectory sample(std::uint64_t seed, Eigen::Index samples = 101) const;
  /// Mean and covariance at `count` even phases, without the noise of samples; of rotations about the axes
  /// of the world.
  SpreadOf<Space> spread(Eigen::Index count = 101) const;
  /// Logarithm of the density of a demonstration, taken at s = t / its duration: of all its numbers, in the
  /// units of the demonstrations.
  double log_likelihood(const Demonstration& demonstration) const;

  /// (d x d) stiffness that is high where the demonstrations agree: sqrt(k) (1 + s^-1 V s^-1)^-1 sqrt(k), V
  /// the covariance at the phase, k = most (d) and s = spread (d), both positive: at a standard deviation of
  /// `spread` it is half of `most`. Positive definite and no more than `most` by construction (after Calinon
  /// et al. 2010).
  Eigen::MatrixXd stiffness(double phase, const Eigen::VectorXd& most, const Eigen::VectorXd& spread) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// 2 zeta sqrt(K) of a symmetric positive definite stiffness, for unit masses. Throws InvalidArgument for
/// another matrix or a zeta that is not positive.
DMP_EXPORT Eigen::MatrixXd damping_of(const Eigen::MatrixXd& stiffness, double zeta = 1.0);

/// The product of distributions to powers (Paraschos et al. 2018): what they agree on. weights: one for each,
/// positive. Their reference is the first one's; rotations to first order in what lies between the
/// references. Throws InvalidArgument for none, other numbers of control points, dimensions or weights, and
/// for a distribution that leaves nothing open somewhere (conditioned exactly).
template <class Space>
DMP_EXPORT Distribution<Space> blend(const std::vector<Distribution<Space>>& distributions,
                                     const Eigen::VectorXd& weights);

using DmpDistribution = Distribution<VectorSpace>;
using OrientationDistribution = Distribution<RotationSpace>;
using PoseDistribution = Distribution<PoseSpace>;
using PoseGripperDistribution = Distribution<PoseGripperSpace>;
extern template class Distribution<VectorSpace>;
extern template class Distribution<RotationSpace>;
extern template class Distribution<PoseSpace>;
extern template class Distribution<PoseGripperSpace>;

}  // namespace dmp
