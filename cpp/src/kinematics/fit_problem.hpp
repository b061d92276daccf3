#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "kinematics/bordered_band.hpp"
#include "kinematics/fit_spline.hpp"
#include "kinematics/pose_goal.hpp"
#include "robot/arm_dynamics.hpp"
#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// What joints along a path must hold.
struct FitBounds {
  Joints lower, upper, velocity, acceleration;
  std::optional<Joints> effort;
  double floor = -std::numeric_limits<double>::infinity();
  double position_tolerance, angle_tolerance;
};

/// Joints as a uniform cubic B-spline, and how the path is placed: moved to `position` about its centre,
/// turned by `yaw` about z, and the tool turned by `tool`.
struct FitState {
  RowMatrix coefficients;  ///< (M x n)
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0.0;
  Eigen::Matrix3d tool = Eigen::Matrix3d::Identity();
};

/// The worst of all samples.
struct FitMeasure {
  double position = 0.0, angle = 0.0;  ///< m, rad from the placed path
  double outside = 0.0;                ///< rad or m beyond a joint limit
  double below = 0.0;                  ///< m below the floor
  double rate = 0.0;                   ///< duration factor by velocity and acceleration
  double effort = 0.0;                 ///< share of the effort limit at the factor that was asked for
};

/// How much slower than the path each sample is carried out (>= 1), and how quickly the logarithm of that
/// changes [1/s].
struct FitClock {
  Eigen::VectorXd slowdown, rate;
};

/// The least-squares problem at one duration factor: residuals at K = 3 (M - 3) + 1 samples, evenly spaced.
class FitProblem {
 public:
  /// `targets` (K) in the base frame, `clock` (K) on which the limits are held.
  FitProblem(const ChainModel& model, const Eigen::Vector3d& gravity, const PoseGoal& goal,
             const FitBounds& bounds, std::vector<Frame> targets, FitClock clock, double duration,
             bool free_placement);

  static Eigen::Index samples_of(Eigen::Index coefficients) { return 3 * (coefficients - 3) + 1; }
  Eigen::Index joint_count() const { return chain_.joint_count(); }
  Eigen::Index border() const { return free_ ? 7 : 0; }
  const Eigen::Vector3d& centre() const { return centre_; }

  /// The sum of the squared residuals; fills `system` with the normal equations unless it is null.
  double evaluate(const FitState& state, double factor, FitMeasure& measure, BorderedBand* system);
  /// `state` after a step of the normal equations.
  FitState moved(const FitState& state, const Eigen::VectorXd& step, const Eigen::VectorXd& placement) const;
  Frame placed(const Frame& target, const FitState& state) const;
  /// How wide the dead zone is, of the tolerance.
  void set_zone(double share) { zone_ = share; }

 private:
  struct Sample;
  void read(const FitState& state, Eigen::Index k, Sample& sample) const;
  double pose_terms(const FitState& state, Sample& sample, FitMeasure& measure, bool linear);
  double rate_terms(double factor, Sample& sample, FitMeasure& measure) const;
  double limit_terms(Sample& sample, FitMeasure& measure) const;
  double floor_terms(Sample& sample, FitMeasure& measure) const;
  /// `largest` becomes the largest share of an effort limit at this sample.
  double effort_terms(double factor, Sample& sample, FitMeasure& measure, double& largest,
                      BorderedBand* system);
  void add_effort_rows(double factor, const Sample& sample, const Eigen::VectorXd& effort,
                       BorderedBand& system);
  void scatter(const Sample& sample, BorderedBand& system) const;

  FlatChain chain_;
  PoseGoal goal_;
  FitBounds bounds_;
  std::vector<Frame> targets_;
  FitClock clock_;
  double spacing_, weight_, zone_ = 0.92;
  bool free_;
  Eigen::Vector3d centre_;
  std::optional<ArmDynamics> dynamics_;
};

}  // namespace dmp::detail
