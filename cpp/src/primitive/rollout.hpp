#pragma once

#include <dmp/error.hpp>
#include <dmp/primitive.hpp>
#include <dmp/status.hpp>

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "primitive/adaptation.hpp"
#include "primitive/product_space.hpp"
#include "primitive/runner.hpp"

namespace dmp::detail {

/// The times at which a rollout is sampled.
struct Timetable {
  Eigen::VectorXd times;  ///< (T) s, increasing from 0 or later
  double dt;              ///< the step between all of them but perhaps the last, or 0 if it is not one
  bool divides = true;    ///< so that the last step is one as well
  double step(Eigen::Index k, double since) const {
    const bool whole = k > 0 && dt > 0.0 && (divides || k + 1 < times.size());
    return whole ? dt : times[k] - since;
  }
};

/// 0, dt, ... and the duration, which ends a shorter step where dt does not divide it.
inline Timetable every(double dt, double duration) {
  if (!(std::isfinite(dt) && dt > 0.0))
    throw InvalidArgument("dt: " + number(dt) + ", expected a positive time step in s.");
  const double steps = std::floor(duration / dt + 1e-6);
  if (!(steps < 1e7))
    throw InvalidArgument("dt: " + number(dt) + " s makes more than 10^7 samples of " + number(duration) +
                          " s. Choose a larger one.");
  const bool divides = steps > 0.0 && duration - steps * dt <= 1e-6 * dt;
  const Eigen::Index count = static_cast<Eigen::Index>(steps) + (divides ? 1 : 2);
  Timetable table{dt * Eigen::VectorXd::LinSpaced(count, 0.0, static_cast<double>(count - 1)), dt, divides};
  table.times[count - 1] = duration;
  return table;
}

inline void require_duration(double duration) {
  if (!(duration >= 1e-9 && duration <= 1e15))
    throw InvalidArgument("duration: " + number(duration) + ", expected a time in s, 1e-9 to 1e15.");
}

/// Steps a runner from one time to the next and calls record(k) at each.
template <class Runner, class Record>
void step_through(Runner& runner, const Timetable& timetable, Record record) {
  const Eigen::VectorXd& times = timetable.times;
  double now = 0.0;
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    if (!(std::isfinite(times[k]) && times[k] >= now))
      throw InvalidArgument(indexed("times", k) + ": " + number(times[k]) + " s after " + number(now) +
                            " s, expected increasing times from 0 s on.");
    const Status status = runner.step(timetable.step(k, now));
    if (status == Status::not_finite)
      throw InvalidArgument("rollout: the motion left the finite numbers at " + number(times[k]) +
                            " s. Check goal, duration and options.");
    if (status == Status::invalid_input)
      throw InvalidArgument(indexed("times", k) + ": " + number(times[k] - now) +
                            " s after the one before, expected at most 10 durations.");
    now = times[k];
    record(k);
  }
}

/// Throws InvalidArgument, naming it, unless vias[j] can be passed.
template <class Space>
void require_via(const std::vector<Via<Space>>& vias, std::size_t j, const Primitive<Space>& model) {
  constexpr double kMostCycles = 10.0;
  const double end = model.options().motion == Motion::rhythmic ? kMostCycles : 1.0 - kLeastReach;
  const Via<Space>& via = vias[j];
  const std::string name = indexed("via", static_cast<long>(j));
  const double least = j == 0 ? kLeastReach : vias[j - 1].phase + kLeastReach;
  if (!(via.phase >= least - 1e-9 && via.phase <= end))
    throw InvalidArgument(name + ".phase: " + number(via.phase) + ", expected " + number(least) + " to " +
                          number(end) +
                          ": via-points in the order of their phases, 0.01 or more from each other and from "
                          "the start (0) and the end (1).");
  Geometry<Space>::require(via.point, model.start(), name + ".point");
  const Eigen::Index axes = model.dimension();
  if (via.velocity && !(via.velocity->size() == axes && via.velocity->allFinite()))
    throw InvalidArgument(name + ".velocity: of the wrong size or not finite, expected " +
                          std::to_string(axes) + " finite numbers per s.");
  if (!is_reach(via.reach))
    throw InvalidArgument(name + ".reach: " + number(via.reach.rise) + ", " + number(via.reach.fall) +
                          ", expected parts of the phase, 0.01 to 1.");
}

template <class Space>
Runner<Space> runner_of(const Primitive<Space>& model) {
  return Runner<Space>(model.options(), model.forcing(), model.forcing_of_run(), model.duration(),
                       Geometry<Space>::ends_of(model.parameters()));
}

/// Sets what a rollout is asked for, and leads it through the times.
template <class Space, class Runner, class Stepped, class Record>
void lead(Runner& runner, Stepped& stepped, const Primitive<Space>& model, const Timetable& timetable,
          const std::optional<typename Space::Point>& goal, std::optional<double> duration, Record record) {
  if (duration) {
    require_duration(*duration);
    runner.set_duration(*duration);
  }
  if (goal) {
    Geometry<Space>::require(*goal, model.start(), "goal");
    runner.start_with_goal(*goal);
  }
  step_through(stepped, timetable, record);
}

/// Rolls a model out and calls take(k, output) at each time.
template <class Space, class Take>
void follow(const Primitive<Space>& model, const Timetable& timetable,
            const std::optional<typename Space::Point>& goal, std::optional<double> duration, Take take) {
  Runner<Space> runner = runner_of(model);
  lead(runner, runner, model, timetable, goal, duration,
       [&](Eigen::Index k) { take(k, runner.system().output()); });
}

/// The same past via-points.
template <class Space, class Take>
void follow(const Primitive<Space>& model, const Timetable& timetable,
            const std::optional<typename Space::Point>& goal, std::optional<double> duration,
            const std::vector<Via<Space>>& vias, Take take) {
  const int count = static_cast<int>(vias.size());
  AdaptedRunner<Space> run(runner_of(model), model.start(), model.dimension(), count);
  for (std::size_t j = 0; j < vias.size(); ++j) {
    require_via<Space>(vias, j, model);
    const Via<Space>& via = vias[j];
    run.adaptation.set(0.0, via.phase, via.point, via.velocity ? via.velocity->data() : nullptr, via.reach);
  }
  lead(run.runner, run, model, timetable, goal, duration,
       [&](Eigen::Index k) { take(k, run.system().output()); });
}

template <class Space>
typename Space::Trajectory roll_out(const Primitive<Space>& model, const Timetable& timetable,
                                    const std::optional<typename Space::Point>& goal,
                                    std::optional<double> duration,
                                    const std::vector<Via<Space>>& vias = {}) {
  using G = Geometry<Space>;
  typename Space::Trajectory result = G::room_for(timetable.times, model.start());
  const auto record = [&](Eigen::Index k, const typename Space::Output& output) {
    G::record(result, k, output);
  };
  if (vias.empty()) {
    follow(model, timetable, goal, duration, record);
  } else {
    follow(model, timetable, goal, duration, vias, record);
  }
  return result;
}

}  // namespace dmp::detail
