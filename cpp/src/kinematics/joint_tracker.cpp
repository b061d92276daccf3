#include <dmp/error.hpp>
#include <dmp/joint_tracker.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/pose.hpp"
#include "kinematics/path_tracker.hpp"
#include "kinematics/pose_error.hpp"
#include "kinematics/singularity.hpp"
#include "robot/checks.hpp"
#include "robot/kdl_forward.hpp"

namespace dmp {
namespace {

void check(const Arm& arm, const TrackOptions& options) {
  detail::check_capacity(arm);
  detail::check_positive(options.position_tolerance, "options.position_tolerance");
  detail::check_positive(options.angle_tolerance, "options.angle_tolerance");
  detail::check_angle_weight(options.angle_weight);
  detail::check_weight(options.weight);
  if (!(options.limit_pull >= 0.0) || !std::isfinite(options.limit_pull))
    throw InvalidArgument("options.limit_pull: " + std::to_string(options.limit_pull) +
                          ", expected 0 or more.");
}

detail::Tolerances tolerances_of(const TrackOptions& options) {
  return {options.position_tolerance, options.angle_tolerance, {options.weight, options.angle_weight}};
}

}  // namespace

/// The arm comes first: the tracker refers to its model.
struct JointTracker::State {
  State(Arm arm_, const TrackOptions& options_)
      : arm(std::move(arm_)),
        options(options_),
        tracker(arm.model(), tolerances_of(options)),
        forward(arm.model()),
        pull(tracker.has_null_space() ? options.limit_pull : 0.0) {}

  bool accepts(const Eigen::VectorXd& q) const {
    return q.size() == arm.joint_count() && q.allFinite() && excess_of(q) <= detail::limit_tolerance;
  }

  double excess_of(const Eigen::VectorXd& q) const {
    return std::max({0.0, (arm.lower() - q).maxCoeff(), (q - arm.upper()).maxCoeff()});
  }

  void stand_at(const Eigen::VectorXd& q) {
    excess = excess_of(q);
    joints = q;
    at = tracker.standing_at(q.cwiseMax(arm.lower()).cwiseMin(arm.upper()));
    beyond = q - at.joints;
    drift.setZero(q.size());
    velocity.setZero(q.size());
  }

  // Takes a joint beyond a limit back towards it, first of all that it does with a step; returns what is
  // left.
  detail::Joints come_back(const detail::Joints& step) {
    const detail::Joints back = beyond.cwiseMin(step).cwiseMax(-step);
    beyond -= back;
    return step - back.cwiseAbs();
  }

  Arm arm;
  TrackOptions options;
  detail::PathTracker tracker;
  detail::KdlForward forward;
  double pull;
  detail::Descent at;     // within the limits
  detail::Joints beyond;  // how far each joint stands outside them: joints = at.joints + beyond
  detail::Joints drift;   // rad/s or m/s, of the last step within the limits
  Eigen::VectorXd joints, velocity;
  double position_error = 0.0, angle_error = 0.0, excess = 0.0;
};

JointTracker::JointTracker(Arm arm, const Eigen::VectorXd& start, const TrackOptions& options) {
  check(arm, options);
  state_ = std::make_unique<State>(std::move(arm), options);
  detail::brought_within_limits(start, this->arm(), "start");
  state_->stand_at(start);
}
JointTracker::JointTracker(const JointTracker& other)
    : state_(std::make_unique<State>(other.arm(), other.options())) {
  state_->at = other.state_->at;
  state_->beyond = other.state_->beyond;
  state_->drift = other.state_->drift;
  state_->joints = other.state_->joints;
  state_->velocity = other.state_->velocity;
  state_->position_error = other.state_->position_error;
  state_->angle_error = other.state_->angle_error;
  state_->excess = other.state_->excess;
}
JointTracker::JointTracker(JointTracker&&) noexcept = default;
JointTracker& JointTracker::operator=(JointTracker other) noexcept {
  state_.swap(other.state_);
  return *this;
}
JointTracker::~JointTracker() = default;

IkStatus JointTracker::track(const Eigen::Matrix4d& pose, double dt) noexcept {
  State& s = *state_;
  if (!(dt > 0.0) || !std::isfinite(dt) || !detail::is_pose(pose)) return IkStatus::invalid_input;
  const detail::Frame target = detail::rigid_frame(pose);
  const detail::Joints step = s.come_back(s.arm.velocity_limit() * dt);
  const detail::Descent next = s.tracker.advance(s.at, target, step, s.drift * dt, s.pull);
  IkStatus status = s.tracker.verdict(s.at, next, target, step);
  s.drift = (next.joints - s.at.joints) / dt;
  const detail::Joints joints = next.joints + s.beyond;
  s.velocity = (joints - s.joints) / dt;
  s.joints = joints;
  s.at = next;
  if (status == IkStatus::ok && !s.beyond.isZero(0.0) && !s.tracker.meets(target, joints))
    status = IkStatus::step_limited;
  const detail::Vector6 error = s.tracker.goal().error(target, s.forward(s.joints));
  s.position_error = error.head<3>().norm();
  s.angle_error = error.tail<3>().norm();
  return status;
}

IkStatus JointTracker::set_joints(const Eigen::VectorXd& q) noexcept {
  if (!state_->accepts(q)) return IkStatus::invalid_input;
  state_->stand_at(q);
  return IkStatus::ok;
}

const Eigen::VectorXd& JointTracker::joints() const noexcept { return state_->joints; }
const Eigen::VectorXd& JointTracker::velocity() const noexcept { return state_->velocity; }
double JointTracker::position_error() const noexcept { return state_->position_error; }
double JointTracker::angle_error() const noexcept { return state_->angle_error; }
double JointTracker::limit_excess() const noexcept { return state_->excess; }
const Arm& JointTracker::arm() const { return state_->arm; }
const TrackOptions& JointTracker::options() const { return state_->options; }

}  // namespace dmp
