#include <dmp/error.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/so3.hpp>

#include "primitive/automatic_fit.hpp"
#include "primitive/forcing_fit.hpp"
#include "primitive/learning.hpp"
#include "primitive/orientation_motion.hpp"
#include "primitive/parameters.hpp"
#include "primitive/position_motion.hpp"
#include "primitive/rollout.hpp"
#include "primitive/runner.hpp"

namespace dmp {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Twist = Eigen::Matrix<double, 6, 1>;

namespace {

/// Position and orientation in the same steps: the forcing term has three columns for each.
struct PoseMotion {
  detail::PositionMotion position;
  detail::OrientationMotion orientation;

  void advance(double step, const detail::ForcingNodes& f) noexcept {
    position.advance(step, f);
    orientation.advance(step, {f.start + 3, f.middle + 3, f.end + 3});
  }
  void set_phase(double s) noexcept { orientation.set_phase(s); }
  bool look(double speed, double speed_rate, const double* forcing) noexcept {
    return position.look(speed, speed_rate, forcing) && orientation.look(speed, speed_rate, forcing + 3);
  }
  void publish() noexcept {
    position.publish();
    orientation.publish();
  }
};

Vector3d position_of(const Matrix4d& pose) { return pose.topRightCorner<3, 1>(); }
Matrix3d rotation_of(const Matrix4d& pose) { return pose.topLeftCorner<3, 3>(); }

Twist stacked(const Vector3d& linear, const Vector3d& angular) {
  Twist twist;
  twist << linear, angular;
  return twist;
}

PoseMotion motion_of(const PoseDmpParameters& p) {
  const Twist z = p.duration * p.start_twist;
  return {detail::PositionMotion(p.options, position_of(p.start), position_of(p.goal), z.head<3>(),
                                 p.amplitude.head<3>()),
          detail::OrientationMotion(p.options, rotation_of(p.start), rotation_of(p.goal), p.start_error,
                                    z.tail<3>(), p.amplitude.tail<3>(), p.reference)};
}

PoseDmpParameters checked(const PoseDmpParameters& given) {
  PoseDmpParameters parameters = given;
  parameters.options = detail::settled(given.options, given.weights);
  detail::require_duration(given.duration);
  detail::require_pose(given.start, "start");
  detail::require_pose(given.goal, "goal");
  parameters.start.topLeftCorner<3, 3>() = detail::projected(rotation_of(given.start));
  parameters.goal.topLeftCorner<3, 3>() = detail::projected(rotation_of(given.goal));
  detail::require_finite(given.start_twist, 6, "start_twist");
  detail::require_finite(given.start_error, 3, "start_error");
  detail::require_finite(given.amplitude, 6, "amplitude");
  detail::require_weights(given.weights, parameters.options.basis_count, 6);
  detail::settle_form(parameters.options, given.start_error.norm(), given.reference);
  return parameters;
}

/// What one demonstration teaches about both parts, their targets side by side.
struct PoseLesson {
  detail::PositionLesson position;
  detail::OrientationLesson orientation;
  ForcingTarget target;
};

PoseLesson lesson_of(const PoseDemonstration& demonstration, const DmpOptions& options,
                     const detail::TurningReference* reference) {
  PoseLesson lesson{detail::lesson_of(demonstration.position(), options),
                    detail::lesson_of(demonstration.orientation(), options, reference),
                    {}};
  ForcingTarget& position = lesson.position.target;
  ForcingTarget& orientation = lesson.orientation.target;
  lesson.target = {std::move(position.s), RowMatrix(position.value.rows(), 6), Twist::Ones()};
  lesson.target.value << position.value, orientation.value;
  return lesson;
}

PoseDmpParameters means_of(const PoseDemonstration* demonstrations, const std::vector<PoseLesson>& lessons,
                           const DmpOptions& options) {
  PoseDmpParameters mean;
  mean.options = options;
  mean.duration = 0.0;
  Vector3d start = Vector3d::Zero();
  Vector3d goal = Vector3d::Zero();
  Rotations starts;
  Rotations goals;
  const double share = 1.0 / static_cast<double>(lessons.size());
  for (std::size_t j = 0; j < lessons.size(); ++j) {
    const PoseLesson& lesson = lessons[j];
    mean.duration += share * demonstrations[j].duration();
    start += share * lesson.position.start;
    goal += share * lesson.position.goal;
    mean.start_twist += share * stacked(lesson.position.start_z, lesson.orientation.start_eta);
    mean.amplitude += share * stacked(lesson.position.amplitude, lesson.orientation.amplitude);
    starts.push_back(lesson.orientation.start);
    goals.push_back(lesson.orientation.goal);
  }
  mean.start_twist /= mean.duration;
  mean.start = pose_of(so3::mean_rotation(starts), start);
  mean.goal = pose_of(so3::mean_rotation(goals), goal);
  const Quaterniond turn =
      Quaterniond(rotation_of(mean.goal)) * Quaterniond(rotation_of(mean.start)).conjugate();
  mean.start_error = options.log_branch == LogBranch::lifted
                         ? so3::lifted_log(turn, lessons[0].orientation.start_error)
                         : so3::log(turn);
  return mean;
}

}  // namespace

struct PoseDmp::Data {
  PoseDmpParameters parameters;
  ForcingTerm forcing;
};

struct PoseRun::State {
  std::shared_ptr<const PoseDmp::Data> model;
  detail::Runner<PoseMotion> runner;
};

PoseDmp PoseDmp::fit(const PoseDemonstration& demonstration, const DmpOptions& options) {
  std::unique_ptr<detail::ForcingFit> memory;
  return fit_together(&demonstration, 1, options, memory);
}

PoseDmp PoseDmp::fit(const std::vector<PoseDemonstration>& demonstrations, const DmpOptions& options) {
  std::unique_ptr<detail::ForcingFit> memory;
  return fit_together(demonstrations.data(), demonstrations.size(), options, memory);
}

PoseDmp PoseDmp::fit_together(const PoseDemonstration* demonstrations, std::size_t count,
                              const DmpOptions& options, std::unique_ptr<detail::ForcingFit>& memory) {
  if (count == 0) throw InvalidArgument("demonstrations: none, expected at least one.");
  if (options.automatic()) {
    options.validate();
    return detail::fit_automatically<PoseDmp>(
        demonstrations, count, options,
        [](const PoseDemonstration* one, std::size_t number, const DmpOptions& stated) {
          std::unique_ptr<detail::ForcingFit> none;
          return fit_together(one, number, stated, none);
        });
  }
  DmpOptions resolved = options.resolved();
  std::vector<const OrientationDemonstration*> turns;
  for (std::size_t j = 0; j < count; ++j) turns.push_back(&demonstrations[j].orientation());
  const std::optional<detail::TurningReference> reference = detail::choose_form(resolved, turns);
  std::vector<PoseLesson> lessons;
  for (std::size_t j = 0; j < count; ++j)
    lessons.push_back(lesson_of(demonstrations[j], resolved, reference ? &*reference : nullptr));
  PoseDmpParameters parameters = means_of(demonstrations, lessons, resolved);
  if (reference) parameters.reference = reference->coefficients();
  const Vector3d way = position_of(parameters.goal) - position_of(parameters.start);
  std::vector<ForcingTarget> targets;
  for (PoseLesson& lesson : lessons) {
    detail::apply_scaling(lesson.target, 0, lesson.position.goal - lesson.position.start, way,
                          parameters.amplitude.head<3>(), resolved);
    detail::apply_scaling(lesson.target, 3, lesson.orientation.start_error, parameters.start_error,
                          parameters.amplitude.tail<3>(), resolved);
    targets.push_back(std::move(lesson.target));
  }
  if (!memory || memory->dimension() != targets.front().value.cols())
    memory = std::make_unique<detail::ForcingFit>(detail::basis_of(resolved), resolved,
                                                  targets.front().value.cols());
  parameters.weights = memory->weights(targets);
  return PoseDmp(parameters);
}

PoseDmp::PoseDmp(const PoseDmpParameters& parameters) {
  PoseDmpParameters known = checked(parameters);
  ForcingTerm forcing(detail::basis_of(known.options), known.weights);
  data_ = std::make_shared<const Data>(Data{std::move(known), std::move(forcing)});
}

const PoseDmpParameters& PoseDmp::parameters() const noexcept { return data_->parameters; }
const ForcingTerm& PoseDmp::forcing() const noexcept { return data_->forcing; }

PoseTrajectory PoseDmp::rollout(const std::optional<Matrix4d>& goal, std::optional<double> duration,
                                double dt) const {
  if (duration) detail::require_duration(*duration);
  return roll_out(detail::every(dt, duration.value_or(this->duration())), goal, duration);
}

PoseTrajectory PoseDmp::rollout_at(const Eigen::VectorXd& times, const std::optional<Matrix4d>& goal,
                                   std::optional<double> duration) const {
  return roll_out({times, 0.0}, goal, duration);
}

PoseTrajectory PoseDmp::roll_out(const detail::Timetable& timetable, const std::optional<Matrix4d>& goal,
                                 std::optional<double> duration) const {
  const Eigen::VectorXd& times = timetable.times;
  PoseRun run(*this);
  auto& runner = run.state_->runner;
  if (duration) {
    detail::require_duration(*duration);
    runner.set_duration(*duration);
  }
  if (goal) {
    detail::require_pose(*goal, "goal");
    runner.motion().position.start_with_goal(position_of(*goal));
    runner.motion().orientation.start_with_goal(detail::unit_quaternion(rotation_of(*goal)));
  }
  runner.publish();
  PoseTrajectory result{times, {}, RowMatrix(times.size(), 6), RowMatrix(times.size(), 6)};
  result.pose.reserve(static_cast<std::size_t>(times.size()));
  detail::roll_out(runner, timetable, [&](Index k) {
    result.pose.push_back(run.pose());
    result.twist.row(k) = run.twist();
    result.acceleration.row(k) = run.acceleration();
  });
  return result;
}

PoseRun::PoseRun(const PoseDmp& dmp) {
  const PoseDmpParameters& p = dmp.parameters();
  state_ = std::make_unique<State>(
      State{dmp.data_, detail::Runner<PoseMotion>(p.options, dmp.forcing(), p.duration, motion_of(p))});
}
PoseRun::PoseRun(const PoseRun& other) : state_(std::make_unique<State>(*other.state_)) {}
PoseRun::PoseRun(PoseRun&& other) noexcept = default;
PoseRun& PoseRun::operator=(const PoseRun& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
PoseRun& PoseRun::operator=(PoseRun&& other) noexcept = default;
PoseRun::~PoseRun() = default;

Status PoseRun::step(double dt) noexcept { return state_->runner.step(dt); }

Status PoseRun::set_goal(const Matrix4d& goal) noexcept {
  if (!detail::is_pose(goal)) return Status::invalid_input;
  PoseMotion& motion = state_->runner.motion();
  const Quaterniond rotation = detail::unit_quaternion(rotation_of(goal));
  if (state_->runner.at_start()) {
    motion.position.start_with_goal(goal.topRightCorner<3, 1>());
    motion.orientation.start_with_goal(rotation);
    state_->runner.publish();
  } else {
    motion.position.set_goal(goal.topRightCorner<3, 1>());
    motion.orientation.set_goal(rotation);
  }
  return status();
}

Status PoseRun::set_duration(double duration) noexcept { return state_->runner.set_duration(duration); }
Status PoseRun::set_tracking_error(double error) noexcept { return state_->runner.set_tracking_error(error); }
void PoseRun::pause() noexcept { state_->runner.pause(); }
void PoseRun::resume() noexcept { state_->runner.resume(); }
bool PoseRun::paused() const noexcept { return state_->runner.phase().paused(); }

Status PoseRun::start_from(const Matrix4d& pose, const Twist& twist) noexcept {
  if (!detail::is_pose(pose) || !twist.allFinite()) return Status::invalid_input;
  state_->runner.reset_phase();
  const Twist z = duration() * twist;
  state_->runner.motion().position.begin(pose.topRightCorner<3, 1>(), z.head<3>());
  state_->runner.motion().orientation.begin(detail::unit_quaternion(rotation_of(pose)), z.tail<3>());
  state_->runner.restart();
  return status();
}

void PoseRun::reset() noexcept {
  const PoseDmpParameters& p = state_->model->parameters;
  const Twist z = p.duration * p.start_twist;
  state_->runner.motion().position.begin(p.start.topRightCorner<3, 1>(), z.head<3>());
  state_->runner.motion().orientation.begin(Quaterniond(rotation_of(p.start)), z.tail<3>());
  state_->runner.restart();
}

Matrix4d PoseRun::pose() const noexcept { return pose_of(rotation(), position()); }
Vector3d PoseRun::position() const noexcept { return state_->runner.motion().position.position(); }
Matrix3d PoseRun::rotation() const noexcept { return quaternion().toRotationMatrix(); }
const Quaterniond& PoseRun::quaternion() const noexcept {
  return state_->runner.motion().orientation.rotation();
}
Twist PoseRun::twist() const noexcept {
  return stacked(state_->runner.motion().position.velocity(), state_->runner.motion().orientation.velocity());
}
Twist PoseRun::acceleration() const noexcept {
  return stacked(state_->runner.motion().position.acceleration(),
                 state_->runner.motion().orientation.acceleration());
}
Matrix4d PoseRun::goal() const noexcept {
  const PoseMotion& motion = state_->runner.motion();
  return pose_of(motion.orientation.goal().toRotationMatrix(), motion.position.goal());
}
double PoseRun::time() const noexcept { return state_->runner.phase().time(); }
double PoseRun::phase() const noexcept { return state_->runner.phase().s(); }
double PoseRun::duration() const noexcept { return state_->runner.phase().duration(); }
Status PoseRun::status() const noexcept { return state_->runner.status(); }

}  // namespace dmp
