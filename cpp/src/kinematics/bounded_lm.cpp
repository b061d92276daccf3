#include "kinematics/bounded_lm.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/box_step.hpp"

namespace dmp::detail {
namespace {

constexpr double trust_region = 1.0;  // rad or m a step, beyond which the linearisation says little
constexpr double least_damping = 1e-12;
constexpr int patience = 8;  // iterations in which the squared error must halve

constexpr int closing_iterations = 200;
constexpr double least_norm = 1e-9;  // m or rad, below which a norm is not divided by

// The squares w^2 e^2 that touch the norms |p| + |r| from above at the present error.
Vector6 norm_weights(const Vector6& error) {
  Vector6 weight;
  weight.head<3>().setConstant(1.0 / std::sqrt(std::max(error.head<3>().norm(), least_norm)));
  weight.tail<3>().setConstant(1.0 / std::sqrt(std::max(error.tail<3>().norm(), least_norm)));
  return weight;
}

// The damping factor of Levenberg-Marquardt: smaller after every success, larger after every failure.
class Damping {
 public:
  double at(double squared_error) const { return factor_ * squared_error + least_damping; }
  void success() { factor_ = std::max(0.3 * factor_, 1e-6); }
  void failure() { factor_ = std::min(4.0 * factor_, 1e8); }

 private:
  double factor_ = 0.1;
};

// Notices when the squared error stops falling.
class Progress {
 public:
  explicit Progress(double squared_error) : mark_(squared_error) {}
  bool stalled(double squared_error) {
    if (squared_error < 0.5 * mark_) {
      mark_ = squared_error;
      since_ = 0;
    }
    return ++since_ > patience;
  }

 private:
  double mark_;
  int since_ = 0;
};

}  // namespace

BoundedLm::BoundedLm(const ChainModel& model, const Tolerances& tolerances, int iteration_limit)
    : chain_(model),
      tolerances_(tolerances),
      lower_(model.lower),
      upper_(model.upper),
      iteration_limit_(iteration_limit) {}

bool BoundedLm::within_tolerances(const Vector6& miss) const {
  return miss.head<3>().norm() <= tolerances_.position && miss.tail<3>().norm() <= tolerances_.angle;
}

Descent BoundedLm::descend(const Frame& target, const Joints& start, const Joints& lower, const Joints& upper,
                           int iteration_limit) const {
  Descent begin;
  begin.joints = start;
  begin.tip = chain_.forward(begin.joints, begin.jacobian);
  return descend_from(begin, target, lower, upper, iteration_limit);
}

Descent BoundedLm::descend_from(const Descent& end, const Frame& target, const Joints& lower,
                                const Joints& upper, int iteration_limit) const {
  const PoseGoal& goal = tolerances_.goal;
  Descent at = end;
  at.iterations = 0;
  at.stalled = false;
  at.error = goal.error(target, at.tip);
  Vector6 weighted = goal.weighted(target, at.error);
  double cost = weighted.squaredNorm();
  Damping damping;
  Progress progress(cost);
  Jacobian jacobian;
  while (!(at.converged = within_tolerances(at.error)) && !at.stalled && at.iterations < iteration_limit) {
    ++at.iterations;
    const Box box = {(lower - at.joints).cwiseMax(-trust_region), (upper - at.joints).cwiseMin(trust_region)};
    const Joints step = box_step(goal.weighted(target, at.jacobian), weighted, damping.at(cost), box);
    const Joints joints = (at.joints + step).cwiseMax(lower).cwiseMin(upper);
    const Frame tip = chain_.forward(joints, jacobian);
    const Vector6 miss = goal.error(target, tip), next_weighted = goal.weighted(target, miss);
    const double next_cost = next_weighted.squaredNorm();
    if (next_cost < cost) {
      at.joints = joints;
      at.tip = tip;
      at.error = miss;
      at.jacobian = jacobian;
      weighted = next_weighted;
      cost = next_cost;
      damping.success();
    } else {
      damping.failure();
    }
    at.stalled = progress.stalled(cost);
  }
  return at;
}

Joints BoundedLm::closest(const Frame& target, const Joints& start, const Joints& lower,
                          const Joints& upper) const {
  Joints best = start;
  Jacobian jacobian, next_jacobian;
  const PoseGoal& goal = tolerances_.goal;
  const auto length = [](const Vector6& way) { return way.head<3>().norm() + way.tail<3>().norm(); };
  Vector6 miss = goal.weighted(target, goal.error(target, chain_.forward(best, jacobian)));
  double distance = length(miss), damping = 1e-2;
  for (int idle = 0, i = 0; idle < patience && i < closing_iterations; ++i) {
    const Vector6 weight = norm_weights(miss);
    const Jacobian scaled = weight.asDiagonal() * goal.weighted(target, jacobian);
    const Box box = {(lower - best).cwiseMax(-trust_region), (upper - best).cwiseMin(trust_region)};
    const Joints step = box_step(scaled, weight.cwiseProduct(miss), damping, box);
    const Joints joints = (best + step).cwiseMax(lower).cwiseMin(upper);
    const Vector6 next = goal.weighted(target, goal.error(target, chain_.forward(joints, next_jacobian)));
    const double next_distance = length(next);
    const Vector6 left = weight.cwiseProduct(miss) - scaled * step;
    const double promised = 0.5 * (weight.cwiseProduct(miss).squaredNorm() - left.squaredNorm());
    damping *=
        distance - next_distance > 0.5 * promised ? 0.3 : 4.0;  // a promise half kept is a step too far
    idle = next_distance < distance * (1.0 - 1e-9) ? 0 : idle + 1;
    if (!(next_distance < distance)) continue;
    best = joints;
    jacobian = next_jacobian;
    miss = next;
    distance = next_distance;
  }
  return best;
}

int BoundedLm::CartToJnt(const KDL::JntArray& q_init, const KDL::Frame& p_in, KDL::JntArray& q_out) {
  Frame target;
  target.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(p_in.M.data);
  target.position = Eigen::Map<const Eigen::Vector3d>(p_in.p.data);
  const Joints start = Joints(q_init.data).cwiseMax(lower_).cwiseMin(upper_);
  const Descent end = descend(target, start, lower_, upper_, iteration_limit_);
  q_out.data = end.joints;
  return error = end.converged ? E_NOERROR : E_NO_CONVERGE;  // `error` is KDL::SolverI's
}

}  // namespace dmp::detail
