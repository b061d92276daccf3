#include <dmp/dmp.hpp>
#include <dmp/error.hpp>

#include "primitive/automatic_fit.hpp"
#include "primitive/forcing_fit.hpp"
#include "primitive/learning.hpp"
#include "primitive/parameters.hpp"
#include "primitive/position_motion.hpp"
#include "primitive/rollout.hpp"
#include "primitive/runner.hpp"

namespace dmp {

using Eigen::Index;
using Eigen::VectorXd;

struct Dmp::Data {
  DmpParameters parameters;
  ForcingTerm forcing;
};

struct Run::State {
  std::shared_ptr<const Dmp::Data> model;
  detail::Runner<detail::PositionMotion> runner;
  VectorXd z;  // scratch for a start velocity
};

namespace {

DmpParameters checked(const DmpParameters& given) {
  DmpParameters parameters = given;
  parameters.options = detail::settled(given.options, given.weights);
  const Index dimension = given.start.size();
  if (dimension == 0) throw InvalidArgument("start: empty, expected at least one dimension.");
  detail::require_duration(given.duration);
  detail::require_finite(given.start, dimension, "start");
  detail::require_finite(given.goal, dimension, "goal");
  detail::require_finite(given.start_velocity, dimension, "start_velocity");
  detail::require_finite(given.amplitude, dimension, "amplitude");
  detail::require_weights(given.weights, parameters.options.basis_count, dimension);
  return parameters;
}

/// The means that a model of several demonstrations starts from.
DmpParameters means_of(const Demonstration* demonstrations,
                       const std::vector<detail::PositionLesson>& lessons, const DmpOptions& options) {
  const Index dimension = lessons.front().start.size();
  const VectorXd zero = VectorXd::Zero(dimension);
  DmpParameters mean{options, 0.0, zero, zero, zero, zero, {}};
  const double share = 1.0 / static_cast<double>(lessons.size());
  for (std::size_t j = 0; j < lessons.size(); ++j) {
    mean.duration += share * demonstrations[j].duration();
    mean.start += share * lessons[j].start;
    mean.goal += share * lessons[j].goal;
    mean.start_velocity += share * lessons[j].start_z;
    mean.amplitude += share * lessons[j].amplitude;
  }
  mean.start_velocity /= mean.duration;
  return mean;
}

}  // namespace

Dmp Dmp::fit(const Demonstration& demonstration, const DmpOptions& options) {
  std::unique_ptr<detail::ForcingFit> memory;
  return fit_together(&demonstration, 1, options, memory);
}

Dmp Dmp::fit(const std::vector<Demonstration>& demonstrations, const DmpOptions& options) {
  std::unique_ptr<detail::ForcingFit> memory;
  return fit_together(demonstrations.data(), demonstrations.size(), options, memory);
}

Dmp Dmp::fit_together(const Demonstration* demonstrations, std::size_t count, const DmpOptions& options,
                      std::unique_ptr<detail::ForcingFit>& memory) {
  if (count == 0) throw InvalidArgument("demonstrations: none, expected at least one.");
  if (options.automatic()) {
    options.validate();
    return detail::fit_automatically<Dmp>(
        demonstrations, count, options,
        [](const Demonstration* one, std::size_t number, const DmpOptions& stated) {
          std::unique_ptr<detail::ForcingFit> none;
          return fit_together(one, number, stated, none);
        });
  }
  const DmpOptions resolved = options.resolved();
  std::vector<detail::PositionLesson> lessons;
  for (std::size_t j = 0; j < count; ++j) {
    if (demonstrations[j].dimension() != demonstrations[0].dimension())
      throw InvalidArgument(detail::indexed("demonstrations", static_cast<long>(j)) + ": " +
                            std::to_string(demonstrations[j].dimension()) + " dimensions, expected " +
                            std::to_string(demonstrations[0].dimension()) + " as in the first.");
    lessons.push_back(detail::lesson_of(demonstrations[j], resolved));
  }
  DmpParameters parameters = means_of(demonstrations, lessons, resolved);
  std::vector<ForcingTarget> targets;
  for (detail::PositionLesson& lesson : lessons) {
    detail::apply_scaling(lesson.target, 0, lesson.goal - lesson.start, parameters.goal - parameters.start,
                          parameters.amplitude, resolved);
    targets.push_back(std::move(lesson.target));
  }
  if (!memory || memory->dimension() != targets.front().value.cols())
    memory = std::make_unique<detail::ForcingFit>(detail::basis_of(resolved), resolved,
                                                  targets.front().value.cols());
  parameters.weights = memory->weights(targets);
  return Dmp(parameters);
}

Dmp::Dmp(const DmpParameters& parameters) {
  DmpParameters known = checked(parameters);
  ForcingTerm forcing(detail::basis_of(known.options), known.weights);
  data_ = std::make_shared<const Data>(Data{std::move(known), std::move(forcing)});
}

const DmpParameters& Dmp::parameters() const noexcept { return data_->parameters; }
const ForcingTerm& Dmp::forcing() const noexcept { return data_->forcing; }

Trajectory Dmp::rollout(const std::optional<VectorXd>& goal, std::optional<double> duration,
                        double dt) const {
  if (duration) detail::require_duration(*duration);
  return roll_out(detail::every(dt, duration.value_or(this->duration())), goal, duration);
}

Trajectory Dmp::rollout_at(const Eigen::VectorXd& times, const std::optional<VectorXd>& goal,
                           std::optional<double> duration) const {
  return roll_out({times, 0.0}, goal, duration);
}

Trajectory Dmp::roll_out(const detail::Timetable& timetable, const std::optional<VectorXd>& goal,
                         std::optional<double> duration) const {
  const Eigen::VectorXd& times = timetable.times;
  Run run(*this);
  auto& runner = run.state_->runner;
  if (duration) {
    detail::require_duration(*duration);
    runner.set_duration(*duration);
  }
  if (goal) {
    detail::require_finite(*goal, dimension(), "goal");
    runner.motion().start_with_goal(*goal);
  }
  runner.publish();
  Trajectory result{times, RowMatrix(times.size(), dimension()), RowMatrix(times.size(), dimension()),
                    RowMatrix(times.size(), dimension())};
  detail::roll_out(runner, timetable, [&](Index k) {
    result.position.row(k) = run.position();
    result.velocity.row(k) = run.velocity();
    result.acceleration.row(k) = run.acceleration();
  });
  return result;
}

Run::Run(const Dmp& dmp) {
  const DmpParameters& p = dmp.parameters();
  const VectorXd z = p.duration * p.start_velocity;
  const detail::PositionMotion motion(p.options, p.start, p.goal, z, p.amplitude);
  state_ = std::make_unique<State>(State{
      dmp.data_, detail::Runner<detail::PositionMotion>(p.options, dmp.forcing(), p.duration, motion), z});
}
Run::Run(const Run& other) : state_(std::make_unique<State>(*other.state_)) {}
Run::Run(Run&& other) noexcept = default;
Run& Run::operator=(const Run& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
Run& Run::operator=(Run&& other) noexcept = default;
Run::~Run() = default;

Status Run::step(double dt) noexcept { return state_->runner.step(dt); }

Status Run::set_goal(const Eigen::Ref<const VectorXd>& goal) noexcept {
  if (goal.size() != position().size() || !goal.allFinite()) return Status::invalid_input;
  if (state_->runner.at_start()) {
    state_->runner.motion().start_with_goal(goal);
    state_->runner.publish();
  } else {
    state_->runner.motion().set_goal(goal);
  }
  return status();
}

Status Run::set_duration(double duration) noexcept { return state_->runner.set_duration(duration); }
Status Run::set_tracking_error(double error) noexcept { return state_->runner.set_tracking_error(error); }
void Run::pause() noexcept { state_->runner.pause(); }
void Run::resume() noexcept { state_->runner.resume(); }
bool Run::paused() const noexcept { return state_->runner.phase().paused(); }

Status Run::start_from(const Eigen::Ref<const VectorXd>& position,
                       const Eigen::Ref<const VectorXd>& velocity) noexcept {
  const Index dimension = this->position().size();
  if (position.size() != dimension || velocity.size() != dimension || !position.allFinite() ||
      !velocity.allFinite())
    return Status::invalid_input;
  state_->runner.reset_phase();
  state_->z = duration() * velocity;
  state_->runner.motion().begin(position, state_->z);
  state_->runner.restart();
  return status();
}

void Run::reset() noexcept {
  const DmpParameters& p = state_->model->parameters;
  state_->z = p.duration * p.start_velocity;
  state_->runner.motion().begin(p.start, state_->z);
  state_->runner.restart();
}

const VectorXd& Run::position() const noexcept { return state_->runner.motion().position(); }
const VectorXd& Run::velocity() const noexcept { return state_->runner.motion().velocity(); }
const VectorXd& Run::acceleration() const noexcept { return state_->runner.motion().acceleration(); }
const VectorXd& Run::goal() const noexcept { return state_->runner.motion().goal(); }
double Run::time() const noexcept { return state_->runner.phase().time(); }
double Run::phase() const noexcept { return state_->runner.phase().s(); }
double Run::duration() const noexcept { return state_->runner.phase().duration(); }
Status Run::status() const noexcept { return state_->runner.status(); }

}  // namespace dmp
