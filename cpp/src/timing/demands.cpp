#include "timing/demands.hpp"

#include <algorithm>
#include <cmath>
#include <dmp/error.hpp>
#include <string>

#include "timing/spline_extremes.hpp"

namespace dmp::detail {
namespace {

void check(const Arm* arm, const JointTrajectory& joints, const PacingLimits& limits) {
  const Eigen::Index count = joints.position.cols();
  if (arm && arm->joint_count() != count)
    throw InvalidArgument("joints: " + std::to_string(count) + " columns, expected " +
                          std::to_string(arm->joint_count()) + ", one for each joint of the arm.");
  check_limit(limits.velocity, count, "velocity");
  check_limit(limits.acceleration, count, "acceleration");
  if (limits.jerk) check_limit(*limits.jerk, count, "jerk");
  if (limits.effort) check_limit(*limits.effort, count, "effort");
  if (limits.effort && !arm) throw InvalidArgument("effort: needs an arm; pass it as the first argument.");
  if (!(limits.tool_speed > 0.0)) throw InvalidArgument("tool_speed: not above 0.");
  if (std::isfinite(limits.tool_speed) && !arm)
    throw InvalidArgument("tool_speed: needs an arm; pass it as the first argument.");
  if (!(limits.tempo_rate > 0.0) || !std::isfinite(limits.tempo_rate))
    throw InvalidArgument("tempo_rate: expected > 0 and finite.");
}

Eigen::VectorXd steps_of_tip(const Arm& arm, const RowMatrix& positions) {
  const Poses poses = arm.forward_kinematics(positions);
  Eigen::VectorXd way = Eigen::VectorXd::Zero(positions.rows());
  for (std::size_t k = 1; k < poses.size(); ++k)
    way[static_cast<Eigen::Index>(k) - 1] =
        (poses[k].topRightCorner<3, 1>() - poses[k - 1].topRightCorner<3, 1>()).norm();
  return way;
}

}  // namespace

Demands::Demands(const Arm* arm, const JointTrajectory& joints, const PacingLimits& limits)
    : limits_(limits) {
  check(arm, joints, limits);
  if (std::isfinite(limits.tool_speed)) way_ = steps_of_tip(*arm, joints.position);
  if (!limits.effort) return;
  dynamics_.emplace(arm->model(), arm->gravity());
  holding_ = holding_efforts(*dynamics_, joints.position, *limits.effort, "effort");
  moving_ = moving(joints);
  along_.resize(joints.position.rows(), joints.position.cols());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(along_.cols());
  for (Eigen::Index k = 0; k < along_.rows(); ++k)
    along_.row(k) = dynamics_->moving(joints.position.row(k), none, joints.velocity.row(k)).transpose();
}

Eigen::VectorXd Demands::squared(const JointTrajectory& joints) const {
  const Eigen::VectorXd square = without_effort(joints);
  return dynamics_ ? square.cwiseMax(by_effort(moving(joints))) : square;
}

Eigen::VectorXd Demands::squared(const JointTrajectory& joints, const Pace& pace) const {
  const Eigen::VectorXd square = without_effort(joints);
  if (!dynamics_) return square;
  RowMatrix slowed = moving_ - pace.rate.asDiagonal() * along_;
  slowed.array().colwise() /= pace.slowdown.array().square();
  return square.cwiseMax(by_effort(slowed));
}

Eigen::VectorXd Demands::without_effort(const JointTrajectory& joints) const {
  Eigen::VectorXd square = squared_factors(joints, limits_.velocity, limits_.acceleration);
  if (limits_.jerk) square = square.cwiseMax(by_jerk(joints));
  return way_.size() > 0 ? square.cwiseMax(by_tool_speed(joints)) : square;
}

Eigen::VectorXd Demands::by_jerk(const JointTrajectory& joints) const {
  Eigen::VectorXd square = Eigen::VectorXd::Zero(joints.time.size());
  for (Eigen::Index k = 0; k + 1 < square.size(); ++k) {
    const Eigen::VectorXd change = (joints.acceleration.row(k + 1) - joints.acceleration.row(k)).cwiseAbs();
    const double share =
        change.cwiseQuotient(*limits_.jerk).maxCoeff() / (joints.time[k + 1] - joints.time[k]);
    square[k] = std::cbrt(share * share);  // jerk falls with the cube of the factor
  }
  return square;
}

Eigen::VectorXd Demands::by_tool_speed(const JointTrajectory& joints) const {
  Eigen::VectorXd square = Eigen::VectorXd::Zero(joints.time.size());
  for (Eigen::Index k = 0; k + 1 < square.size(); ++k) {
    const double speed = way_[k] / (joints.time[k + 1] - joints.time[k]);
    square[k] = speed * speed / (limits_.tool_speed * limits_.tool_speed);
  }
  return square;
}

Eigen::VectorXd Demands::by_effort(const RowMatrix& moving) const {
  Eigen::VectorXd square(moving.rows());
  for (Eigen::Index k = 0; k < square.size(); ++k) {
    square[k] = 0.0;
    for (Eigen::Index i = 0; i < moving.cols(); ++i) {
      const double room = (*limits_.effort)[i] - std::copysign(1.0, moving(k, i)) * holding_(k, i);
      square[k] = std::max(square[k], std::abs(moving(k, i)) / room);
    }
  }
  return square;
}

RowMatrix Demands::moving(const JointTrajectory& joints) const {
  RowMatrix result(joints.position.rows(), joints.position.cols());
  for (Eigen::Index k = 0; k < result.rows(); ++k)
    result.row(k) =
        dynamics_->moving(joints.position.row(k), joints.velocity.row(k), joints.acceleration.row(k))
            .transpose();
  return result;
}

Demand Demands::largest(const JointTrajectory& joints) const {
  Eigen::Index k = 0;
  const double square = joints.time.size() > 0 ? squared(joints).maxCoeff(&k) : 0.0;
  if (square == 0.0) return {};
  Demand found = of_joint(joints, k);
  if (found.factor < std::sqrt(square) * (1.0 - 1e-9)) found = {0.0, PacedLimit::tool_speed, -1, 0.0};
  found.factor = std::sqrt(square);
  found.time = joints.time[k];
  return found;
}

// The joint and its limit that ask most at sample k and on the way to the next one: every other limit is
// taken away, and what is left is asked again.
Demand Demands::of_joint(const JointTrajectory& joints, Eigen::Index k) const {
  const Eigen::Index count = std::min<Eigen::Index>(2, joints.time.size() - k);
  Demand most;
  const auto take = [&](double square, PacedLimit limit, Eigen::Index joint) {
    if (std::sqrt(square) > most.factor) most = {std::sqrt(square), limit, joint, 0.0};
  };
  for (Eigen::Index i = 0; i < joints.position.cols(); ++i) {
    JointTrajectory one;
    one.time = joints.time.segment(k, count);
    one.position = joints.position.block(k, i, count, 1);
    one.velocity = joints.velocity.block(k, i, count, 1);
    one.acceleration = joints.acceleration.block(k, i, count, 1);
    const Eigen::VectorXd none = Eigen::VectorXd::Constant(1, std::numeric_limits<double>::infinity());
    take(squared_factors(one, limits_.velocity.segment(i, 1), none)[0], PacedLimit::velocity, i);
    take(squared_factors(one, none, limits_.acceleration.segment(i, 1))[0], PacedLimit::acceleration, i);
    if (limits_.jerk && count > 1) {
      const double jerk =
          std::abs(one.acceleration(1, 0) - one.acceleration(0, 0)) / (one.time[1] - one.time[0]);
      take(std::cbrt(std::pow(jerk / (*limits_.jerk)[i], 2.0)), PacedLimit::jerk, i);
    }
    if (dynamics_) {
      const double effort =
          dynamics_->moving(joints.position.row(k), joints.velocity.row(k), joints.acceleration.row(k))[i];
      const double room = (*limits_.effort)[i] - std::copysign(1.0, effort) * holding_(k, i);
      take(std::abs(effort) / room, PacedLimit::effort, i);
    }
  }
  return most;
}

}  // namespace dmp::detail
