#include <dmp/arm.hpp>
#include <dmp/error.hpp>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <kdl/chainjnttojacsolver.hpp>

#include "base/text_file.hpp"
#include "robot/arm_dynamics.hpp"
#include "robot/checks.hpp"
#include "robot/kdl_forward.hpp"
#include "robot/tool_frame.hpp"
#include "robot/urdf_chain.hpp"

namespace dmp {
namespace {

Eigen::Matrix4d matrix_of(const detail::Frame& frame) {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = frame.rotation;
  pose.topRightCorner<3, 1>() = frame.position;
  return pose;
}

void replace(Eigen::VectorXd& limit, const std::optional<Eigen::VectorXd>& other, const std::string& name) {
  if (!other) return;
  if (other->size() != limit.size())
    throw InvalidArgument(name + ": " + std::to_string(other->size()) + " values, expected " +
                          std::to_string(limit.size()) + ", one for each joint.");
  limit = *other;
}

void name_sources(LimitSources& sources, LimitKind kind, const std::optional<Eigen::VectorXd>& limit,
                  const LimitOverrides& overrides) {
  if (!limit) return;
  const auto k = static_cast<std::size_t>(kind);
  const auto& single = overrides.sources[k];
  if (!single.empty() && single.size() != sources[k].size())
    throw InvalidArgument("source: " + std::to_string(single.size()) + " values, expected " +
                          std::to_string(sources[k].size()) + ", one for each joint.");
  for (std::size_t i = 0; i < sources[k].size(); ++i) {
    const LimitSource given = single.empty() ? overrides.source : single[i];
    sources[k][i] = std::isfinite((*limit)[static_cast<Eigen::Index>(i)]) ? given : LimitSource::unstated;
  }
}

constexpr double earth = 9.81;  // m/s^2

void check_positive(const Eigen::VectorXd& limit, const std::string& name) {
  for (Eigen::Index i = 0; i < limit.size(); ++i)
    if (!(limit[i] > 0.0))
      throw InvalidArgument(name + "[" + std::to_string(i) + "]: " + std::to_string(limit[i]) +
                            ", expected > 0.");
}

}  // namespace

Arm::Arm(std::shared_ptr<const detail::ChainModel> model) : model_(std::move(model)) {}

Arm Arm::from_urdf(const std::string& text, const std::string& base, const std::string& tip,
                   const std::string& folder) {
  auto model = std::make_shared<detail::ChainModel>(detail::read_urdf(text, base, tip));
  model->folder = folder;
  return Arm(std::move(model));
}

Arm Arm::from_urdf_file(const std::string& path, const std::string& base, const std::string& tip) {
  const std::string text = detail::read_text(path, "a URDF");
  try {
    return from_urdf(text, base, tip, std::filesystem::absolute(path).parent_path().string());
  } catch (const InvalidArgument& error) {
    throw InvalidArgument("'" + path + "': " + error.what());
  }
}

Arm Arm::with_limits(const LimitOverrides& limits) const {
  auto model = std::make_shared<detail::ChainModel>(*model_);
  replace(model->lower, limits.lower, "lower");
  replace(model->upper, limits.upper, "upper");
  replace(model->velocity_limit, limits.velocity, "velocity");
  replace(model->acceleration_limit, limits.acceleration, "acceleration");
  replace(model->jerk_limit, limits.jerk, "jerk");
  replace(model->effort_limit, limits.effort, "effort");
  for (Eigen::Index i = 0; i < joint_count(); ++i)
    if (!(model->lower[i] < model->upper[i]))
      throw InvalidArgument("lower[" + std::to_string(i) + "]: " + std::to_string(model->lower[i]) +
                            ", expected less than upper = " + std::to_string(model->upper[i]) + ".");
  check_positive(model->velocity_limit, "velocity");
  check_positive(model->acceleration_limit, "acceleration");
  check_positive(model->jerk_limit, "jerk");
  check_positive(model->effort_limit, "effort");
  model->tool_speed_limit = limits.tool_speed.value_or(model->tool_speed_limit);
  check_positive(Eigen::VectorXd::Constant(1, model->tool_speed_limit), "tool_speed");
  const auto name = [&](LimitKind kind, const std::optional<Eigen::VectorXd>& limit) {
    name_sources(model->limit_sources, kind, limit, limits);
  };
  name(LimitKind::position, limits.lower);
  name(LimitKind::position, limits.upper);
  name(LimitKind::velocity, limits.velocity);
  name(LimitKind::acceleration, limits.acceleration);
  name(LimitKind::jerk, limits.jerk);
  name(LimitKind::effort, limits.effort);
  return Arm(std::move(model));
}

Arm Arm::with_tool(const Eigen::Matrix4d& frame) const {
  auto model = std::make_shared<detail::ChainModel>(*model_);
  detail::add_tool(*model, frame);
  return Arm(std::move(model));
}

const std::string& Arm::name() const { return model_->name; }
const std::string& Arm::base() const { return model_->base; }
const std::string& Arm::tip() const { return model_->tip; }
const std::string& Arm::choice() const { return model_->choice; }
Eigen::Index Arm::joint_count() const { return model_->lower.size(); }
const std::vector<std::string>& Arm::joint_names() const { return model_->joint_names; }
const Eigen::VectorXd& Arm::lower() const { return model_->lower; }
const Eigen::VectorXd& Arm::upper() const { return model_->upper; }
const Eigen::VectorXd& Arm::velocity_limit() const { return model_->velocity_limit; }
const Eigen::VectorXd& Arm::acceleration_limit() const { return model_->acceleration_limit; }
const Eigen::VectorXd& Arm::jerk_limit() const { return model_->jerk_limit; }
const std::vector<LimitSource>& Arm::limit_sources(LimitKind kind) const {
  return model_->limit_sources[static_cast<std::size_t>(kind)];
}
const Eigen::VectorXd& Arm::effort_limit() const { return model_->effort_limit; }
double Arm::tool_speed_limit() const { return model_->tool_speed_limit; }
const std::vector<std::string>& Arm::warnings() const { return model_->warnings; }
const std::string& Arm::urdf() const { return model_->urdf; }
const std::string& Arm::folder() const { return model_->folder; }

// The chain is shared between threads, the KDL solvers are not: each call has its own (see ChainModel).
Eigen::Matrix4d Arm::forward_kinematics(const Eigen::VectorXd& q) const {
  detail::check_joints(q, joint_count(), "q");
  return matrix_of(detail::KdlForward(*model_)(q));
}

Poses Arm::forward_kinematics(const RowMatrix& q) const {
  detail::KdlForward forward(*model_);
  Poses poses;
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    detail::check_joints(q.row(k), joint_count(), "q[" + std::to_string(k) + "]");
    poses.push_back(matrix_of(forward(q.row(k).transpose())));
  }
  return poses;
}

Eigen::MatrixXd Arm::jacobian(const Eigen::VectorXd& q) const {
  detail::check_joints(q, joint_count(), "q");
  const auto count = static_cast<unsigned>(model_->couplings.size());
  KDL::ChainJntToJacSolver solver(model_->chain);
  KDL::JntArray joints(count);
  KDL::Jacobian all(count);
  detail::expand(*model_, q, joints);
  solver.JntToJac(joints, all);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(6, joint_count());
  for (std::size_t i = 0; i < model_->couplings.size(); ++i) {
    const detail::Coupling& coupling = model_->couplings[i];
    jacobian.col(coupling.joint) += coupling.multiplier * all.data.col(static_cast<Eigen::Index>(i));
  }
  return jacobian;
}

double Arm::manipulability(const Eigen::VectorXd& q) const {
  const Eigen::MatrixXd j = jacobian(q);
  // Fewer than six joints span a volume of their own number of dimensions.
  const double square = j.cols() < 6 ? (j.transpose() * j).determinant() : (j * j.transpose()).determinant();
  return std::sqrt(std::max(square, 0.0));
}

Eigen::Vector3d Arm::gravity() const { return -earth * model_->up; }

Eigen::VectorXd Arm::inverse_dynamics(const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
                                      const Eigen::VectorXd& acceleration) const {
  detail::check_joints(q, joint_count(), "q");
  detail::check_joints(velocity, joint_count(), "velocity");
  detail::check_joints(acceleration, joint_count(), "acceleration");
  detail::ArmDynamics dynamics(*model_, gravity());
  Eigen::VectorXd effort = dynamics.holding(q) + dynamics.moving(q, velocity, acceleration);
  if (!effort.allFinite())
    throw InvalidArgument(
        "velocity, acceleration: so large that the efforts are beyond what a double holds.");
  return effort;
}

RowMatrix Arm::gravity_effort(const RowMatrix& q) const {
  detail::ArmDynamics dynamics(*model_, gravity());
  RowMatrix efforts(q.rows(), joint_count());
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    detail::check_joints(q.row(k), joint_count(), "q[" + std::to_string(k) + "]");
    efforts.row(k) = dynamics.holding(q.row(k)).transpose();
  }
  return efforts;
}

}  // namespace dmp
