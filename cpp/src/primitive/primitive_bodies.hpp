#pragma once

#include <dmp/primitive.hpp>
#include <dmp/stepper.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "primitive/automatic_fit.hpp"
#include "primitive/fitting.hpp"
#include "primitive/forcing_fit.hpp"
#include "primitive/parameters.hpp"
#include "primitive/rescaling.hpp"
#include "primitive/rollout.hpp"

namespace dmp {

namespace detail {

/// Scaling::automatic, and whether a scaling is guarded, decided by whether there is an advance.
template <class Space>
void settle_advance(typename Space::Parameters& parameters) {
  Scaling& scaling = parameters.options.scaling;
  const bool given = parameters.advance.size() > 0;
  if (scaling == Scaling::automatic) scaling = given ? Scaling::advance : Scaling::none;
  bool& guard = parameters.options.scaling_guard;
  guard = guard && given && multiplies(scaling);
  const bool needed = advances(parameters.options);
  if (given && !needed)
    throw InvalidArgument(
        "advance: given, expected none unless options.scaling is advance, or guarded "
        "(options.scaling_guard).");
  if (needed) require_weights(parameters.advance, parameters.weights.rows(), parts_of<Space>(), "advance");
}

/// What a run goes by: the weights and, behind them, those of the advance.
template <class Parameters>
ForcingTerm forcing_of_run(const Parameters& parameters) {
  if (parameters.advance.size() == 0) return {basis_of(parameters.options), parameters.weights};
  RowMatrix both(parameters.weights.rows(), parameters.weights.cols() + parameters.advance.cols());
  both << parameters.weights, parameters.advance;
  return {basis_of(parameters.options), both};
}

/// Checked, with rotations made exact and options decided.
template <class Space>
typename Space::Parameters checked(const typename Space::Parameters& given) {
  using G = Geometry<Space>;
  const Eigen::Index dimension = dimension_of<Space>(given.start);
  if (dimension == 0) throw InvalidArgument("start: empty, expected at least one dimension.");
  typename Space::Parameters parameters = given;
  parameters.options = settled(given.options, given.weights);
  visit_fields(given, FieldCheck<G>(parameters.options.basis_count, given.start, dimension));
  parameters.start = G::projected(given.start);
  parameters.goal = G::projected(given.goal);
  const Ends<Space> ends = G::ends_of(parameters);
  if (ends.reference.rows() > 0 && rotations_in<Space>() != 1)
    throw InvalidArgument("reference: given, expected none for motions of other than one rotation.");
  parameters.options = G::settle(parameters.options, ends);
  settle_advance<Space>(parameters);
  return parameters;
}

/// The weights that a learner of the user's own finds.
inline RowMatrix learned(const Learner& learner, const DmpOptions& options,
                         const std::vector<ForcingTarget>& targets) {
  const GaussianBasis basis = basis_of(options);
  RowMatrix weights = learner(basis, targets);
  require_weights(weights, basis.count(), targets.front().value.cols(), "learner: weights");
  return weights;
}

template <class Space>
Primitive<Space> fit(const Demonstrations<Space>& demonstrations, const DmpOptions& options,
                     const Learner& learner) {
  if (options.automatic()) {
    require_alike<Space>(demonstrations);
    options.validate();
    return fit_automatically<Space>(demonstrations, options,
                                    [&](const Demonstrations<Space>& prepared, const DmpOptions& stated) {
                                      return fit<Space>(prepared, stated, learner);
                                    });
  }
  LearningTask<Space> task = task_of<Space>(demonstrations, options);
  const DmpOptions decided = task.parameters.options;
  RowMatrix own;
  if (learner) own = learned(learner, decided, task.targets);
  ForcingFit regression(basis_of(decided), decided, columns_of(task));
  typename Space::Parameters parameters = learned(std::move(task), regression);
  if (learner) parameters.weights = own;
  return Primitive<Space>(parameters);
}

}  // namespace detail

// Primitive

template <class Space>
struct Primitive<Space>::Data {
  Parameters parameters;
  ForcingTerm forcing;
  ForcingTerm of_run;
};

template <class Space>
Primitive<Space> Primitive<Space>::fit(const Demonstration& demonstration, const DmpOptions& options,
                                       const Learner& learner) {
  return detail::fit<Space>({&demonstration}, options, learner);
}

template <class Space>
Primitive<Space> Primitive<Space>::fit(const std::vector<Demonstration>& demonstrations,
                                       const DmpOptions& options, const Learner& learner) {
  return detail::fit<Space>(detail::pointers_to(demonstrations), options, learner);
}

template <class Space>
std::vector<ForcingTarget> Primitive<Space>::targets(const std::vector<Demonstration>& demonstrations,
                                                     const DmpOptions& options) {
  const auto pointers = detail::pointers_to(demonstrations);
  if (!options.automatic()) return detail::task_of<Space>(pointers, options).targets;
  DmpOptions stated = detail::fit<Space>(pointers, options, {}).options();
  if (options.derivatives != Derivatives::automatic) return detail::task_of<Space>(pointers, stated).targets;
  stated.derivatives = Derivatives::interpolate;  // of what is left without the noise, as fit does
  std::vector<Demonstration> cleaned;
  std::vector<NoiseEstimate> noise;
  for (const Demonstration& one : demonstrations)
    cleaned.push_back(detail::Geometry<Space>::denoised(one, noise));
  return detail::task_of<Space>(detail::pointers_to(cleaned), stated).targets;
}

template <class Space>
Primitive<Space>::Primitive(const Parameters& parameters) {
  Parameters known = detail::checked<Space>(parameters);
  ForcingTerm forcing(detail::basis_of(known.options), known.weights);
  ForcingTerm of_run = detail::forcing_of_run(known);
  data_ = std::make_shared<const Data>(Data{std::move(known), std::move(forcing), std::move(of_run)});
}

template <class Space>
Primitive<Space> Primitive<Space>::with_weights(const RowMatrix& weights) const {
  Parameters changed = parameters();
  changed.weights = weights;
  return Primitive(changed);
}

template <class Space>
Primitive<Space> Primitive<Space>::with_scaling(Scaling scaling) const {
  return detail::rescaled(*this, scaling);
}

template <class Space>
std::vector<std::string> Primitive<Space>::scaling_notes(const Point& goal) const {
  detail::Geometry<Space>::require(goal, start(), "goal");
  return detail::scaling_notes(*this, goal);
}

template <class Space>
const typename Space::Parameters& Primitive<Space>::parameters() const noexcept {
  return data_->parameters;
}
template <class Space>
const ForcingTerm& Primitive<Space>::forcing() const noexcept {
  return data_->forcing;
}
template <class Space>
const ForcingTerm& Primitive<Space>::forcing_of_run() const noexcept {
  return data_->of_run;
}
template <class Space>
Eigen::Index Primitive<Space>::dimension() const noexcept {
  return detail::dimension_of<Space>(start());
}

template <class Space>
typename Space::Trajectory Primitive<Space>::rollout(const std::optional<Point>& goal,
                                                     std::optional<double> duration, double dt,
                                                     const std::vector<Via<Space>>& vias) const {
  if (duration) detail::require_duration(*duration);
  return detail::roll_out(*this, detail::every(dt, duration.value_or(this->duration())), goal, duration,
                          vias);
}

template <class Space>
typename Space::Trajectory Primitive<Space>::rollout_at(const Eigen::VectorXd& times,
                                                        const std::optional<Point>& goal,
                                                        std::optional<double> duration,
                                                        const std::vector<Via<Space>>& vias) const {
  return detail::roll_out(*this, {times, 0.0}, goal, duration, vias);
}

// Stepper

template <class Space>
struct Stepper<Space>::State {
  Primitive<Space> model;
  detail::AdaptedRunner<Space> run;
  Eigen::VectorXd start_z;      // demonstrated
  Eigen::VectorXd z;            // scratch: a velocity,
  Eigen::VectorXd rate;         // an acceleration,
  typename Space::Point point;  // and where they are
};

template <class Space>
Stepper<Space>::Stepper(const Primitive<Space>& model)
    : state_(std::make_unique<State>(
          State{model,
                {detail::runner_of(model), model.start(), model.dimension(), kMostVias},
                detail::Geometry<Space>::ends_of(model.parameters()).z,
                Eigen::VectorXd::Zero(model.dimension()),
                Eigen::VectorXd::Zero(model.dimension()),
                model.start()})) {}
template <class Space>
Stepper<Space>::Stepper(const Stepper& other) : state_(std::make_unique<State>(*other.state_)) {}
template <class Space>
Stepper<Space>::Stepper(Stepper&& other) noexcept = default;
template <class Space>
Stepper<Space>& Stepper<Space>::operator=(const Stepper& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
template <class Space>
Stepper<Space>& Stepper<Space>::operator=(Stepper&& other) noexcept = default;
template <class Space>
Stepper<Space>::~Stepper() = default;

template <class Space>
Status Stepper<Space>::step(double dt) noexcept {
  return state_->run.step(dt);
}
template <class Space>
Status Stepper<Space>::step(double dt, const Coupling<Space>& coupling) noexcept {
  return state_->run.step(dt, &coupling);
}

template <class Space>
Status Stepper<Space>::step(double dt, SafetyFilter& filter) noexcept {
  return state_->run.step(dt, detail::SafetyAccess::of(filter));
}
template <class Space>
Status Stepper<Space>::step(double dt, const Coupling<Space>& coupling, SafetyFilter& filter) noexcept {
  return state_->run.step(dt, detail::SafetyAccess::of(filter), &coupling);
}

template <class Space>
Status Stepper<Space>::set_goal(PointArgument goal) noexcept {
  if (!detail::Geometry<Space>::accepts(goal, state_->model.start())) return Status::invalid_input;
  const Status status = state_->run.runner.set_goal(goal);
  state_->run.adaptation.changed(phase());
  return status;
}
template <class Space>
Status Stepper<Space>::set_duration(double duration) noexcept {
  const Status status = state_->run.runner.set_duration(duration);
  state_->run.adaptation.changed_tempo(phase());
  return status;
}
template <class Space>
Status Stepper<Space>::set_amplitude(double amplitude) noexcept {
  const Status status = state_->run.runner.set_amplitude(amplitude);
  state_->run.adaptation.changed(phase());
  return status;
}
template <class Space>
double Stepper<Space>::amplitude() const noexcept {
  return state_->run.runner.amplitude();
}
template <class Space>
Status Stepper<Space>::set_tracking_error(double error) noexcept {
  return state_->run.runner.set_tracking_error(error);
}
template <class Space>
void Stepper<Space>::pause() noexcept {
  state_->run.runner.pause();
}
template <class Space>
void Stepper<Space>::resume() noexcept {
  state_->run.runner.resume();
}
template <class Space>
bool Stepper<Space>::paused() const noexcept {
  return state_->run.runner.phase().paused();
}

template <class Space>
Status Stepper<Space>::start_from(PointArgument point, TangentArgument velocity) noexcept {
  const bool fits = velocity.size() == state_->z.size() && velocity.allFinite();
  if (!fits || !detail::Geometry<Space>::accepts(point, state_->model.start())) return Status::invalid_input;
  state_->z = duration() * velocity;
  state_->run.adaptation.restart(0.0);
  return state_->run.runner.restart(point, state_->z);
}
template <class Space>
Status Stepper<Space>::start_from(PointArgument point, TangentArgument velocity,
                                  const Reach& reach) noexcept {
  const bool fits = velocity.size() == state_->z.size() && velocity.allFinite() && detail::is_reach(reach);
  if (!fits || paused() || !detail::Geometry<Space>::accepts(point, state_->model.start()))
    return Status::invalid_input;
  state_->z = velocity;
  reset();
  state_->rate.setZero();
  state_->run.bridge_from(point, state_->z.data(), state_->rate.data(), reach);
  return status();
}
template <class Space>
Status Stepper<Space>::join(Stepper& next, const Reach& reach) noexcept {
  if (&next == this || !detail::is_reach(reach) || next.paused() || next.status() == Status::not_finite ||
      status() == Status::not_finite || next.state_->z.size() != state_->z.size())
    return Status::invalid_input;
  using In = detail::OffsetIn<Space>;
  In::point(output(), state_->point);
  In::velocity(output(), 1.0, state_->z.data());
  In::acceleration(output(), state_->rate.data());
  next.state_->run.bridge_from(state_->point, state_->z.data(), state_->rate.data(), reach);
  state_.swap(next.state_);
  return status();
}

template <class Space>
Status Stepper<Space>::via(double phase, PointArgument point, const Reach& reach) noexcept {
  if (!detail::Geometry<Space>::accepts(point, state_->model.start())) return Status::invalid_input;
  return state_->run.adaptation.set(this->phase(), phase, point, nullptr, reach);
}
template <class Space>
Status Stepper<Space>::via(double phase, PointArgument point, TangentArgument velocity,
                           const Reach& reach) noexcept {
  const bool fits = velocity.size() == state_->z.size() && velocity.allFinite();
  if (!fits || !detail::Geometry<Space>::accepts(point, state_->model.start())) return Status::invalid_input;
  state_->z = velocity;
  return state_->run.adaptation.set(this->phase(), phase, point, state_->z.data(), reach);
}
template <class Space>
Status Stepper<Space>::move_via(double phase, PointArgument point) noexcept {
  if (!detail::Geometry<Space>::accepts(point, state_->model.start())) return Status::invalid_input;
  return state_->run.adaptation.move(this->phase(), phase, point);
}
template <class Space>
void Stepper<Space>::clear_vias() noexcept {
  state_->run.adaptation.clear(phase());
}
template <class Space>
const CouplingState<Space>& Stepper<Space>::ahead(double phase) noexcept {
  return state_->run.adaptation.ahead(state_->run.runner, phase);
}

template <class Space>
void Stepper<Space>::reset() noexcept {
  state_->run.adaptation.restart(0.0);
  state_->run.runner.restart(state_->model.start(), state_->start_z);
}

template <class Space>
const CouplingState<Space>& Stepper<Space>::state() noexcept {
  return state_->run.adaptation.present(state_->run.runner);
}
template <class Space>
typename Space::Output Stepper<Space>::output() const noexcept {
  return state_->run.system().output();
}
template <class Space>
typename Space::PointView Stepper<Space>::goal() const noexcept {
  return state_->run.system().goal();
}
template <class Space>
double Stepper<Space>::time() const noexcept {
  return state_->run.runner.phase().time();
}
template <class Space>
double Stepper<Space>::phase() const noexcept {
  return state_->run.runner.phase().s();
}
template <class Space>
double Stepper<Space>::duration() const noexcept {
  return state_->run.runner.phase().duration();
}
template <class Space>
Status Stepper<Space>::status() const noexcept {
  return state_->run.runner.status();
}

}  // namespace dmp
