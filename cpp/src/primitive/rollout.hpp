#pragma once

#include <dmp/error.hpp>
#include <dmp/primitive.hpp>
#include <dmp/status.hpp>

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>

#include "base/text.hpp"
#include "primitive/product_space.hpp"
#include "primitive/runner.hpp"

namespace dmp::detail {

/// The times at which a rollout is sampled.
struct Timetable {
  Eigen::VectorXd times;  ///< (T) s, increasing from 0 or later
  double dt;              ///< the step between all of them, or 0 if it is not one
  double step(Eigen::Index k, double since) const { return k > 0 && dt > 0.0 ? dt : times[k] - since; }
};

/// 0, dt, ... up to the duration: floor(duration / dt + 1e-6) + 1 times.
inline Timetable every(double dt, double duration) {
  if (!(std::isfinite(dt) && dt > 0.0))
    throw InvalidArgument("dt: " + number(dt) + ", expected a positive time step in s.");
  const double steps = std::floor(duration / dt + 1e-6);
  if (!(steps < 1e7))
    throw InvalidArgument("dt: " + number(dt) + " s makes more than 10^7 samples of " + number(duration) +
                          " s. Choose a larger one.");
  const Eigen::Index count = static_cast<Eigen::Index>(steps) + 1;
  return {dt * Eigen::VectorXd::LinSpaced(count, 0.0, static_cast<double>(count - 1)), dt};
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

template <class Space>
Runner<Space> runner_of(const Primitive<Space>& model) {
  return Runner<Space>(model.options(), model.forcing_of_run(), model.duration(),
                       Geometry<Space>::ends_of(model.parameters()));
}

/// Rolls a model out and calls take(k, output) at each time.
template <class Space, class Take>
void follow(const Primitive<Space>& model, const Timetable& timetable,
            const std::optional<typename Space::Point>& goal, std::optional<double> duration, Take take) {
  Runner<Space> runner = runner_of(model);
  if (duration) {
    require_duration(*duration);
    runner.set_duration(*duration);
  }
  if (goal) {
    Geometry<Space>::require(*goal, model.start(), "goal");
    runner.start_with_goal(*goal);
  }
  step_through(runner, timetable, [&](Eigen::Index k) { take(k, runner.system().output()); });
}

template <class Space>
typename Space::Trajectory roll_out(const Primitive<Space>& model, const Timetable& timetable,
                                    const std::optional<typename Space::Point>& goal,
                                    std::optional<double> duration) {
  using G = Geometry<Space>;
  typename Space::Trajectory result = G::room_for(timetable.times, model.start());
  follow(model, timetable, goal, duration,
         [&](Eigen::Index k, const typename Space::Output& output) { G::record(result, k, output); });
  return result;
}

}  // namespace dmp::detail
