#include <dmp/error.hpp>
#include <dmp/time_optimal.hpp>
#include <dmp/time_scaling.hpp>

#include <algorithm>
#include <cmath>

#include "robot/arm_dynamics.hpp"
#include "timing/path_timing.hpp"
#include "timing/spline_extremes.hpp"

namespace dmp {
namespace {

constexpr double pace_of_rest = 0.01;  // by which the path parameter goes on where the joints rest
constexpr int corrections = 3;
constexpr double good_enough = 1.02;  // of the duration, beyond what the limits ask for

// One over the speed that each joint may have; 1 where none is stated.
Eigen::RowVectorXd slowness(const Eigen::VectorXd& velocity_limit) {
  Eigen::RowVectorXd weight(velocity_limit.size());
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    weight[i] = std::isfinite(velocity_limit[i]) ? 1.0 / velocity_limit[i] : 1.0;
  return weight;
}

// The parameter of the path: the time that the way takes at the velocity limits, and a little of the given
// time, so that it grows where the joints rest. Unlike time itself it does not stand still at the ends of a
// motion from rest to rest, where the path would have no direction.
Eigen::VectorXd path_parameter(const JointTrajectory& joints, const Eigen::RowVectorXd& weight) {
  const Eigen::Index parts = joints.time.size() - 1;
  Eigen::VectorXd way(parts);
  for (Eigen::Index k = 0; k < parts; ++k)
    way[k] = (joints.position.row(k + 1) - joints.position.row(k)).cwiseProduct(weight).norm();
  const double pace = pace_of_rest * way.sum() / (joints.time[parts] - joints.time[0]);
  Eigen::VectorXd u(parts + 1);
  u[0] = 0.0;
  for (Eigen::Index k = 0; k < parts; ++k)
    u[k + 1] = u[k] + std::hypot(way[k], pace * (joints.time[k + 1] - joints.time[k]));
  return u;
}

void check_limits(const TimingLimits& limits, Eigen::Index count) {
  detail::check_limit(limits.velocity, count, "limits.velocity");
  detail::check_limit(limits.acceleration, count, "limits.acceleration");
  if (limits.effort) detail::check_limit(*limits.effort, count, "limits.effort");
  for (Eigen::Index i = 0; i < count; ++i)
    if (!std::isfinite(limits.acceleration[i]))
      throw InvalidArgument("limits.acceleration[" + std::to_string(i) + "]: expected a finite value.");
}

// One motion, its limits, and what it takes to hold and to move the arm.
class Timing {
 public:
  Timing(const JointTrajectory& joints, const TimingLimits& limits, detail::ArmDynamics* dynamics)
      : joints_(joints),
        limits_(limits),
        dynamics_(dynamics),
        u_(path_parameter(joints, slowness(limits.velocity))),
        path_(JointTrajectory::through(u_, joints.position)),
        timing_(u_, largest_speeds()) {
    if (dynamics_)
      holding_ = detail::holding_efforts(*dynamics_, joints.position, *limits.effort, "limits.effort");
    for (Eigen::Index k = 0; k < u_.size(); ++k) add_rows(k);
  }

  JointTrajectory fastest() const {
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(u_.size());
    JointTrajectory best;
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < corrections; ++i) {
      const JointTrajectory timed =
          JointTrajectory::through(times(timing_.fastest(scale)), joints_.position, {}, SplineEnds::at_rest);
      const Eigen::VectorXd excess = squared_factors(timed);
      const double factor = std::sqrt(excess.maxCoeff());
      const double duration = factor * (timed.time[timed.time.size() - 1] - timed.time[0]);
      if (duration < shortest) {
        shortest = duration;
        best = stretched(timed, factor);
      }
      if (factor < good_enough) break;
      slow_down(excess, scale);
    }
    return best;
  }

 private:
  // (du/dt)^2 at the velocity limits; where the joints rest, twice what they can come to elsewhere.
  Eigen::VectorXd largest_speeds() const {
    const double most = 4.0 * static_cast<double>(limits_.velocity.size());
    Eigen::VectorXd largest = Eigen::VectorXd::Constant(u_.size(), most);
    for (Eigen::Index k = 0; k < u_.size(); ++k)
      for (Eigen::Index i = 0; i < limits_.velocity.size(); ++i) {
        const double speed = limits_.velocity[i] / std::abs(path_.velocity(k, i));
        largest[k] = std::min(largest[k], speed * speed);
      }
    return largest;
  }

  void add_rows(Eigen::Index k) {
    timing_.next_knot();
    const auto path_velocity = path_.velocity.row(k), path_acceleration = path_.acceleration.row(k);
    double swiftest = 0.0;
    for (Eigen::Index i = 0; i < limits_.acceleration.size(); ++i) {
      const double most = limits_.acceleration[i];
      timing_.limit(path_velocity[i], path_acceleration[i], -most, most);
      swiftest = std::max(swiftest, most / std::min(limits_.velocity[i], 1.0));
    }
    // Where the joints rest nothing else bounds how fast the parameter gains speed.
    const double most = 4.0 * std::sqrt(static_cast<double>(limits_.velocity.size())) * swiftest;
    timing_.limit(1.0, 0.0, -most, most);
    if (dynamics_) add_effort(k);
  }

  void add_effort(Eigen::Index k) {
    const Eigen::VectorXd q = joints_.position.row(k), v = path_.velocity.row(k),
                          a = path_.acceleration.row(k);
    const Eigen::VectorXd by_w = dynamics_->moving(q, Eigen::VectorXd::Zero(q.size()), v);
    const Eigen::VectorXd by_x = dynamics_->moving(q, v, a);
    for (Eigen::Index i = 0; i < q.size(); ++i)
      if (std::isfinite((*limits_.effort)[i]))
        timing_.limit(by_w[i], by_x[i], -(*limits_.effort)[i] - holding_(k, i),
                      (*limits_.effort)[i] - holding_(k, i));
  }

  Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    Eigen::VectorXd t(u_.size());
    t[0] = joints_.time[0];
    for (Eigen::Index k = 1; k < t.size(); ++k) {
      const double speed = std::sqrt(x[k - 1]) + std::sqrt(x[k]);
      t[k] = t[k - 1] + 2.0 * (u_[k] - u_[k - 1]) / std::max(speed, 1e-9);
    }
    return t;
  }

  // The square of the factor on the time that each sample and the way to the next one ask for.
  Eigen::VectorXd squared_factors(const JointTrajectory& timed) const {
    Eigen::VectorXd square = detail::squared_factors(timed, limits_.velocity, limits_.acceleration);
    if (!dynamics_) return square;
    return square.cwiseMax(detail::squared_effort_factors(*dynamics_, timed, holding_, *limits_.effort));
  }

  // Where the spline exceeds a limit, and beside it, less is allowed the next time.
  static void slow_down(const Eigen::VectorXd& excess, Eigen::VectorXd& scale) {
    const Eigen::Index count = excess.size();
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::Index from = std::max<Eigen::Index>(k - 1, 0), to = std::min(k + 1, count - 1);
      const double worst = excess.segment(from, to - from + 1).maxCoeff();
      if (worst > 1.0) scale[k] /= worst;
    }
  }

  const JointTrajectory& joints_;
  const TimingLimits& limits_;
  detail::ArmDynamics* dynamics_;
  Eigen::VectorXd u_;
  JointTrajectory path_;  // over u
  detail::PathTiming timing_;
  RowMatrix holding_;
};

JointTrajectory timed(const JointTrajectory& joints, const TimingLimits& limits,
                      detail::ArmDynamics* dynamics) {
  check_limits(limits, joints.position.cols());
  const bool rests =
      joints.time.size() < 3 || (joints.position.rowwise() - joints.position.row(0)).isZero(0.0);
  if (rests) return joints;
  JointTrajectory result = Timing(joints, limits, dynamics).fastest();
  result.joint_names = joints.joint_names;
  result.report = joints.report;
  result.report.velocity_ratio = detail::largest_step_ratio(result, limits.velocity);
  return result;
}

}  // namespace

JointTrajectory time_optimal(const JointTrajectory& joints, const TimingLimits& limits) {
  if (limits.effort) throw InvalidArgument("limits.effort: needs an arm; pass it as the first argument.");
  return timed(joints, limits, nullptr);
}

JointTrajectory time_optimal(const Arm& arm, const JointTrajectory& joints, const TimingLimits& limits,
                             const Eigen::Vector3d& gravity) {
  if (joints.position.cols() != arm.joint_count())
    throw InvalidArgument("joints: " + std::to_string(joints.position.cols()) + " columns, expected " +
                          std::to_string(arm.joint_count()) + ", one for each joint of the arm.");
  if (!gravity.allFinite()) throw InvalidArgument("gravity: not finite.");
  if (!limits.effort) return timed(joints, limits, nullptr);
  detail::ArmDynamics dynamics(arm.model(), gravity);
  return timed(joints, limits, &dynamics);
}

}  // namespace dmp
