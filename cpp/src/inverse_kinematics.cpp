#include <dmp/error.hpp>
#include <dmp/inverse_kinematics.hpp>
#include <dmp/so3.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <array>

#include "detail/ik_solver.hpp"
#include "detail/pose_error.hpp"

namespace dmp {
namespace {

constexpr double singular_value = 1e-3;  // below it the arm has lost a direction
constexpr int descents_for_a_verdict =
    8;  // so many must have stalled before the pose counts as missed for good

void check_positive(double value, const std::string& name) {
  if (!(value > 0.0))
    throw InvalidArgument("options." + name + ": " + std::to_string(value) + ", expected > 0.");
}

void check(const Arm& arm, const IkOptions& options) {
  check_positive(options.position_tolerance, "position_tolerance");
  check_positive(options.angle_tolerance, "angle_tolerance");
  check_positive(options.angle_weight, "angle_weight");
  check_positive(options.iteration_limit, "iteration_limit");
  check_positive(options.max_step, "max_step");
  if (arm.joint_count() > detail::joint_capacity)
    throw InvalidArgument("arm: " + std::to_string(arm.joint_count()) + " free joints, expected at most " +
                          std::to_string(detail::joint_capacity) + "; choose a base nearer to the tip.");
}

std::vector<Eigen::Index> blocked_joints(const detail::JointRange& range, const detail::Joints& q,
                                         const detail::Jacobian& jacobian, const detail::Vector6& error) {
  const detail::Joints wish = jacobian.transpose() * error;  // where each joint would go to come closer
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

namespace detail {

namespace {
double skewness(const Eigen::Matrix3d& r) {
  return (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}
}  // namespace

bool is_rigid(const Eigen::Matrix4d& pose) {
  const Eigen::Matrix3d r = pose.topLeftCorner<3, 3>();
  return pose.allFinite() && skewness(r) <= 1e-3 && r.determinant() > 0.0 &&
         pose.row(3) == Eigen::RowVector4d::Unit(3);
}

Frame rigid_frame(const Eigen::Matrix4d& pose) {
  Frame frame = {pose.topLeftCorner<3, 3>(), pose.topRightCorner<3, 1>()};
  if (skewness(frame.rotation) > 1e-12) frame.rotation = so3::nearest_rotation(frame.rotation);
  return frame;
}

}  // namespace detail

InverseKinematics::Solver::Solver(Arm arm_, const IkOptions& options_)
    : arm(std::move(arm_)), options(options_), search(arm.model(), options), chain(arm.model()) {}

// Why the best joints found do not meet the pose.
IkStatus InverseKinematics::Solver::diagnosis(const detail::Frame& target, const detail::Joints& seed,
                                              const detail::Found& best, const detail::Jacobian& jacobian,
                                              bool blocked) {
  const bool is_singular =
      Eigen::JacobiSVD<Eigen::MatrixXd>(jacobian).singularValues().tail<1>()[0] < singular_value;
  const detail::JointRange& range = search.range();
  if (std::isfinite(options.max_step) && search.find(target, seed, range.lower, range.upper).ok)
    return is_singular ? IkStatus::singular : IkStatus::step_limited;
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
  IkResult result;
  result.joints = best.joints;
  result.position_error = best.position_error;
  result.angle_error = best.angle_error;
  result.iterations = best.iterations;
  result.limit_margin = range.margin(best.joints);
  result.status = IkStatus::ok;
  if (best.ok) return result;
  detail::Jacobian jacobian;
  detail::Vector6 error = detail::pose_error(target, chain.forward(best.joints, jacobian));
  error.tail<3>() *= options.angle_weight * options.angle_weight;
  result.blocked = blocked_joints(range, best.joints, jacobian, error);
  result.status = diagnosis(target, seed, best, jacobian, !result.blocked.empty());
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
  if (!detail::is_rigid(pose) || seed.size() != arm().joint_count() || !seed.allFinite()) {
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
