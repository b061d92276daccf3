#include <dmp/error.hpp>
#include <dmp/inverse_kinematics.hpp>

#include <array>

#include "geometry/pose.hpp"
#include "kinematics/ik_solver.hpp"
#include "kinematics/singularity.hpp"
#include "robot/checks.hpp"

namespace dmp {
namespace {

// So many descents must have stalled before the pose counts as missed for good.
constexpr int descents_for_a_verdict = 8;

void check(const Arm& arm, const IkOptions& options) {
  detail::check_positive(options.position_tolerance, "options.position_tolerance");
  detail::check_positive(options.angle_tolerance, "options.angle_tolerance");
  detail::check_angle_weight(options.angle_weight);
  detail::check_positive(options.iteration_limit, "options.iteration_limit");
  detail::check_positive(options.max_step, "options.max_step");
  detail::check_weight(options.weight);
  if (options.backend != IkBackend::bounded_lm && options.weight != detail::Vector6::Ones())
    throw InvalidArgument("options.weight: KDL's solvers know whole poses only; use bounded_lm.");
  detail::check_capacity(arm);
}

std::vector<Eigen::Index> blocked_joints(const detail::JointRange& range, const detail::Joints& q,
                                         const detail::Joints& wish) {
  std::vector<Eigen::Index> blocked;
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if ((wish[i] > 0.0 && range.upper[i] - q[i] < 1e-9) || (wish[i] < 0.0 && q[i] - range.lower[i] < 1e-9))
      blocked.push_back(i);
  return blocked;
}

}  // namespace

const char* name_of(IkStatus status) {
  constexpr std::array<const char*, 7> names = {"ok",       "out_of_reach", "limit_blocked", "step_limited",
                                                "singular", "budget",       "invalid_input"};
  return names[static_cast<std::size_t>(status)];
}

InverseKinematics::Solver::Solver(Arm arm_, const IkOptions& options_)
    : arm(std::move(arm_)), options(options_), search(arm.model(), options), chain(arm.model()) {}

// Whether the arm stands where it cannot set out for the target, or has come there.
bool InverseKinematics::Solver::stuck(const detail::Frame& target, const detail::Joints& q) const {
  detail::Jacobian jacobian;
  const detail::PoseGoal& goal = search.lm().goal();
  const detail::Vector6 error = goal.error(target, chain.forward(q, jacobian));
  return detail::is_singular(goal, target, jacobian, error);
}

// Why the best joints found do not meet the pose.
IkStatus InverseKinematics::Solver::diagnosis(const detail::Frame& target, const detail::Joints& seed,
                                              const detail::Found& best, bool blocked) {
  const detail::JointRange& range = search.range();
  if (std::isfinite(options.max_step) && search.find(target, seed, range.lower, range.upper).ok)
    return stuck(target, seed) || stuck(target, best.joints) ? IkStatus::singular : IkStatus::step_limited;
  if (best.stalled < descents_for_a_verdict) return IkStatus::budget;
  if (options.diagnose ? search.find_beyond_limits(target, seed).ok : blocked) return IkStatus::limit_blocked;
  return IkStatus::out_of_reach;
}

IkResult InverseKinematics::Solver::solve(const detail::Frame& target, const detail::Joints& wanted_seed) {
  const detail::JointRange& range = search.range();
  const detail::Joints seed = wanted_seed.cwiseMax(range.lower).cwiseMin(range.upper);
  const detail::Joints lower = range.lower.array().max(seed.array() - options.max_step);
  const detail::Joints upper = range.upper.array().min(seed.array() + options.max_step);
  const detail::Found best = search.find(target, seed, lower, upper);
  IkResult result = search.result(target, best.joints, best.iterations);
  if (result.ok()) return result;
  const detail::PoseGoal& goal = search.lm().goal();
  detail::Jacobian jacobian;
  const detail::Vector6 error = goal.error(target, chain.forward(best.joints, jacobian));
  result.blocked = blocked_joints(range, best.joints, goal.wish(target, jacobian, error));
  result.status = diagnosis(target, seed, best, !result.blocked.empty());
  return result;
}

InverseKinematics::InverseKinematics(Arm arm, const IkOptions& options) {
  check(arm, options);
  solver_ = std::make_unique<Solver>(std::move(arm), options);
}
InverseKinematics::InverseKinematics(const InverseKinematics& other)
    : InverseKinematics(other.solver_->arm, other.solver_->options) {}
InverseKinematics::InverseKinematics(InverseKinematics&&) noexcept = default;
InverseKinematics& InverseKinematics::operator=(InverseKinematics other) noexcept {
  solver_.swap(other.solver_);
  return *this;
}
InverseKinematics::~InverseKinematics() = default;

const Arm& InverseKinematics::arm() const { return solver_->arm; }
const IkOptions& InverseKinematics::options() const { return solver_->options; }
Eigen::VectorXd InverseKinematics::middle() const { return solver_->search.range().middle(); }

IkResult InverseKinematics::solve(const Eigen::Matrix4d& pose, const Eigen::VectorXd& seed) {
  if (!detail::is_pose(pose) || seed.size() != arm().joint_count() || !seed.allFinite()) {
    IkResult refused;
    refused.joints = middle();
    return refused;
  }
  return solver_->solve(detail::rigid_frame(pose), seed);
}

IkBatch InverseKinematics::solve_many(const Poses& poses, const Eigen::VectorXd& seed) {
  const auto count = static_cast<Eigen::Index>(poses.size());
  IkBatch batch;
  batch.joints.resize(count, arm().joint_count());
  batch.position_error.resize(count);
  batch.angle_error.resize(count);
  Eigen::VectorXd from = seed;
  for (Eigen::Index k = 0; k < count; ++k) {
    const IkResult one = solve(poses[static_cast<std::size_t>(k)], from);
    batch.joints.row(k) = one.joints.transpose();
    batch.position_error[k] = one.position_error;
    batch.angle_error[k] = one.angle_error;
    batch.status.push_back(one.status);
    batch.solved += one.ok() ? 1 : 0;
    if (one.ok()) from = one.joints;
  }
  return batch;
}

}  // namespace dmp
