#include <dmp/error.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/so3.hpp>

#include <cmath>

#include "primitive/automatic_fit.hpp"
#include "primitive/forcing_fit.hpp"
#include "primitive/learning.hpp"
#include "primitive/orientation_motion.hpp"
#include "primitive/parameters.hpp"
#include "primitive/rollout.hpp"
#include "primitive/runner.hpp"

namespace dmp {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

struct OrientationDmp::Data {
  OrientationDmpParameters parameters;
  ForcingTerm forcing;
};

struct OrientationRun::State {
  std::shared_ptr<const OrientationDmp::Data> model;
  detail::Runner<detail::OrientationMotion> runner;
};

namespace {

OrientationDmpParameters checked(const OrientationDmpParameters& given) {
  OrientationDmpParameters parameters = given;
  parameters.options = detail::settled(given.options, given.weights);
  detail::require_duration(given.duration);
  so3::require_rotation(given.start, "start");
  so3::require_rotation(given.goal, "goal");
  parameters.start = detail::projected(given.start);
  parameters.goal = detail::projected(given.goal);
  detail::require_finite(given.start_velocity, 3, "start_velocity");
  detail::require_finite(given.start_error, 3, "start_error");
  detail::require_finite(given.amplitude, 3, "amplitude");
  detail::require_weights(given.weights, parameters.options.basis_count, 3);
  detail::settle_form(parameters.options, given.start_error.norm(), given.reference);
  return parameters;
}

OrientationDmpParameters means_of(const OrientationDemonstration* demonstrations,
                                  const std::vector<detail::OrientationLesson>& lessons,
                                  const DmpOptions& options) {
  OrientationDmpParameters mean;
  mean.options = options;
  mean.duration = 0.0;
  Rotations starts;
  Rotations goals;
  const double share = 1.0 / static_cast<double>(lessons.size());
  for (std::size_t j = 0; j < lessons.size(); ++j) {
    mean.duration += share * demonstrations[j].duration();
    mean.start_velocity += share * lessons[j].start_eta;
    mean.amplitude += share * lessons[j].amplitude;
    starts.push_back(lessons[j].start);
    goals.push_back(lessons[j].goal);
  }
  mean.start_velocity /= mean.duration;
  mean.start = so3::mean_rotation(starts);
  mean.goal = so3::mean_rotation(goals);
  const Quaterniond turn = Quaterniond(mean.goal) * Quaterniond(mean.start).conjugate();
  mean.start_error = options.log_branch == LogBranch::lifted ? so3::lifted_log(turn, lessons[0].start_error)
                                                             : so3::log(turn);
  return mean;
}

}  // namespace

OrientationDmp OrientationDmp::fit(const OrientationDemonstration& demonstration, const DmpOptions& options) {
  std::unique_ptr<detail::ForcingFit> memory;
  return fit_together(&demonstration, 1, options, memory);
}

OrientationDmp OrientationDmp::fit(const std::vector<OrientationDemonstration>& demonstrations,
                                   const DmpOptions& options) {
  std::unique_ptr<detail::ForcingFit> memory;
  return fit_together(demonstrations.data(), demonstrations.size(), options, memory);
}

OrientationDmp OrientationDmp::fit_together(const OrientationDemonstration* demonstrations, std::size_t count,
                                            const DmpOptions& options,
                                            std::unique_ptr<detail::ForcingFit>& memory) {
  if (count == 0) throw InvalidArgument("demonstrations: none, expected at least one.");
  if (options.automatic()) {
    options.validate();
    return detail::fit_automatically<OrientationDmp>(
        demonstrations, count, options,
        [](const OrientationDemonstration* one, std::size_t number, const DmpOptions& stated) {
          std::unique_ptr<detail::ForcingFit> none;
          return fit_together(one, number, stated, none);
        });
  }
  DmpOptions resolved = options.resolved();
  std::vector<const OrientationDemonstration*> turns;
  for (std::size_t j = 0; j < count; ++j) turns.push_back(&demonstrations[j]);
  const std::optional<detail::TurningReference> reference = detail::choose_form(resolved, turns);
  std::vector<detail::OrientationLesson> lessons;
  for (std::size_t j = 0; j < count; ++j)
    lessons.push_back(detail::lesson_of(demonstrations[j], resolved, reference ? &*reference : nullptr));
  OrientationDmpParameters parameters = means_of(demonstrations, lessons, resolved);
  if (reference) parameters.reference = reference->coefficients();
  std::vector<ForcingTarget> targets;
  for (detail::OrientationLesson& lesson : lessons) {
    detail::apply_scaling(lesson.target, 0, lesson.start_error, parameters.start_error, parameters.amplitude,
                          resolved);
    targets.push_back(std::move(lesson.target));
  }
  if (!memory || memory->dimension() != targets.front().value.cols())
    memory = std::make_unique<detail::ForcingFit>(detail::basis_of(resolved), resolved,
                                                  targets.front().value.cols());
  parameters.weights = memory->weights(targets);
  return OrientationDmp(parameters);
}

OrientationDmp::OrientationDmp(const OrientationDmpParameters& parameters) {
  OrientationDmpParameters known = checked(parameters);
  ForcingTerm forcing(detail::basis_of(known.options), known.weights);
  data_ = std::make_shared<const Data>(Data{std::move(known), std::move(forcing)});
}

const OrientationDmpParameters& OrientationDmp::parameters() const noexcept { return data_->parameters; }
const ForcingTerm& OrientationDmp::forcing() const noexcept { return data_->forcing; }

OrientationTrajectory OrientationDmp::rollout(const std::optional<Matrix3d>& goal,
                                              std::optional<double> duration, double dt) const {
  if (duration) detail::require_duration(*duration);
  return roll_out(detail::every(dt, duration.value_or(this->duration())), goal, duration);
}

OrientationTrajectory OrientationDmp::rollout_at(const Eigen::VectorXd& times,
                                                 const std::optional<Matrix3d>& goal,
                                                 std::optional<double> duration) const {
  return roll_out({times, 0.0}, goal, duration);
}

OrientationTrajectory OrientationDmp::roll_out(const detail::Timetable& timetable,
                                               const std::optional<Matrix3d>& goal,
                                               std::optional<double> duration) const {
  const Eigen::VectorXd& times = timetable.times;
  OrientationRun run(*this);
  auto& runner = run.state_->runner;
  if (duration) {
    detail::require_duration(*duration);
    runner.set_duration(*duration);
  }
  if (goal) {
    so3::require_rotation(*goal, "goal");
    runner.motion().start_with_goal(detail::unit_quaternion(*goal));
  }
  runner.publish();
  OrientationTrajectory result{times, {}, RowMatrix(times.size(), 3), RowMatrix(times.size(), 3)};
  result.rotation.reserve(static_cast<std::size_t>(times.size()));
  detail::roll_out(runner, timetable, [&](Index k) {
    result.rotation.push_back(run.rotation());
    result.angular_velocity.row(k) = run.angular_velocity();
    result.angular_acceleration.row(k) = run.angular_acceleration();
  });
  return result;
}

OrientationRun::OrientationRun(const OrientationDmp& dmp) {
  const OrientationDmpParameters& p = dmp.parameters();
  const detail::OrientationMotion motion(p.options, p.start, p.goal, p.start_error,
                                         p.duration * p.start_velocity, p.amplitude, p.reference);
  state_ = std::make_unique<State>(State{
      dmp.data_, detail::Runner<detail::OrientationMotion>(p.options, dmp.forcing(), p.duration, motion)});
}
OrientationRun::OrientationRun(const OrientationRun& other)
    : state_(std::make_unique<State>(*other.state_)) {}
OrientationRun::OrientationRun(OrientationRun&& other) noexcept = default;
OrientationRun& OrientationRun::operator=(const OrientationRun& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
OrientationRun& OrientationRun::operator=(OrientationRun&& other) noexcept = default;
OrientationRun::~OrientationRun() = default;

Status OrientationRun::step(double dt) noexcept { return state_->runner.step(dt); }

Status OrientationRun::set_goal(const Matrix3d& goal) noexcept {
  if (!so3::is_rotation(goal)) return Status::invalid_input;
  const Quaterniond rotation = detail::unit_quaternion(goal);
  if (state_->runner.at_start()) {
    state_->runner.motion().start_with_goal(rotation);
    state_->runner.publish();
  } else {
    state_->runner.motion().set_goal(rotation);
  }
  return status();
}

Status OrientationRun::set_duration(double duration) noexcept {
  return state_->runner.set_duration(duration);
}
Status OrientationRun::set_tracking_error(double error) noexcept {
  return state_->runner.set_tracking_error(error);
}
void OrientationRun::pause() noexcept { state_->runner.pause(); }
void OrientationRun::resume() noexcept { state_->runner.resume(); }
bool OrientationRun::paused() const noexcept { return state_->runner.phase().paused(); }

Status OrientationRun::start_from(const Matrix3d& rotation, const Vector3d& angular_velocity) noexcept {
  if (!so3::is_rotation(rotation) || !angular_velocity.allFinite()) return Status::invalid_input;
  state_->runner.reset_phase();
  state_->runner.motion().begin(detail::unit_quaternion(rotation), duration() * angular_velocity);
  state_->runner.restart();
  return status();
}

void OrientationRun::reset() noexcept {
  const OrientationDmpParameters& p = state_->model->parameters;
  state_->runner.motion().begin(Quaterniond(p.start), p.duration * p.start_velocity);
  state_->runner.restart();
}

Matrix3d OrientationRun::rotation() const noexcept { return quaternion().toRotationMatrix(); }
const Quaterniond& OrientationRun::quaternion() const noexcept { return state_->runner.motion().rotation(); }
const Vector3d& OrientationRun::angular_velocity() const noexcept {
  return state_->runner.motion().velocity();
}
const Vector3d& OrientationRun::angular_acceleration() const noexcept {
  return state_->runner.motion().acceleration();
}
Matrix3d OrientationRun::goal() const noexcept { return state_->runner.motion().goal().toRotationMatrix(); }
double OrientationRun::time() const noexcept { return state_->runner.phase().time(); }
double OrientationRun::phase() const noexcept { return state_->runner.phase().s(); }
double OrientationRun::duration() const noexcept { return state_->runner.phase().duration(); }
Status OrientationRun::status() const noexcept { return state_->runner.status(); }

}  // namespace dmp
