#pragma once

#include <dmp/parallel.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "primitive/primitive_bodies.hpp"

namespace dmp {

namespace detail {

/// Fits one demonstration after another with one memory for what they share.
template <class Space>
class OneByOne {
 public:
  Primitive<Space> fit(const typename Space::Demonstration& demonstration, const DmpOptions& options) {
    if (options.automatic()) return detail::fit<Space>({&demonstration}, options, {});
    LearningTask<Space> task = task_of<Space>({&demonstration}, options);
    const DmpOptions& decided = task.parameters.options;
    const Eigen::Index columns = columns_of(task);
    if (!memory_ || memory_->dimension() != columns)
      memory_ = std::make_unique<ForcingFit>(basis_of(decided), decided, columns);
    return Primitive<Space>(detail::learned(std::move(task), *memory_));
  }

 private:
  std::unique_ptr<ForcingFit> memory_;
};

/// Calls work(j, one_by_one) for each j, and says which of `what` an error is about.
template <class State, class Work>
void for_each_of(const char* what, Eigen::Index count, int threads, Work work) {
  parallel_for(count, threads, [&](Eigen::Index first, Eigen::Index last) {
    State state;
    for (Eigen::Index j = first; j < last; ++j) try {
        work(j, state);
      } catch (const InvalidArgument& error) {
        throw InvalidArgument(indexed(what, static_cast<long>(j)) + ": " + error.what());
      }
  });
}

template <class Value>
std::vector<Value> unwrapped(std::vector<std::optional<Value>>&& values) {
  std::vector<Value> result;
  result.reserve(values.size());
  for (std::optional<Value>& value : values) result.push_back(std::move(*value));
  return result;
}

/// How many motions goals and durations ask for together.
inline Eigen::Index count_of(std::size_t goals, Eigen::Index durations) {
  const auto given = static_cast<Eigen::Index>(goals);
  if (given > 0 && durations > 0 && given != durations)
    throw InvalidArgument("durations: " + std::to_string(durations) + " for " + std::to_string(given) +
                          " goals, expected as many of both, or none.");
  return std::max(given, durations);
}

}  // namespace detail

template <class Space>
std::vector<Primitive<Space>> Primitive<Space>::fit_each(const std::vector<Demonstration>& demonstrations,
                                                         const DmpOptions& options, int threads) {
  std::vector<std::optional<Primitive>> models(demonstrations.size());
  detail::for_each_of<detail::OneByOne<Space>>(
      "demonstrations", static_cast<Eigen::Index>(models.size()), threads, [&](Eigen::Index j, auto& fits) {
        models[static_cast<std::size_t>(j)] = fits.fit(demonstrations[static_cast<std::size_t>(j)], options);
      });
  return detail::unwrapped(std::move(models));
}

template <class Space>
std::vector<Primitive<Space>> Primitive<Space>::fit_each(const Eigen::VectorXd& times,
                                                         const std::vector<Path>& paths,
                                                         const DmpOptions& options, int threads) {
  struct OnGrid : detail::OneByOne<Space> {
    std::optional<Demonstration> grid;  // whose times all share
  };
  std::vector<std::optional<Primitive>> models(paths.size());
  detail::for_each_of<OnGrid>(
      "demonstrations", static_cast<Eigen::Index>(models.size()), threads, [&](Eigen::Index j, OnGrid& fits) {
        const Path& path = paths[static_cast<std::size_t>(j)];
        const bool is_first = !fits.grid;
        if (is_first) fits.grid.emplace(times, path);
        models[static_cast<std::size_t>(j)] =
            is_first ? fits.fit(*fits.grid, options) : fits.fit(fits.grid->with(path), options);
      });
  return detail::unwrapped(std::move(models));
}

template <class Space>
void Primitive<Space>::rollout_each(const std::vector<Point>& goals, const Eigen::VectorXd& durations,
                                    Eigen::Index samples, const Take<Trajectory>& take, int threads) const {
  if (samples < 2) throw InvalidArgument("samples: " + std::to_string(samples) + ", expected 2 or more.");
  struct Nothing {};
  detail::for_each_of<Nothing>("rollouts", detail::count_of(goals.size(), durations.size()), threads,
                               [&](Eigen::Index m, Nothing&) {
                                 std::optional<Point> goal;
                                 if (!goals.empty()) goal = goals[static_cast<std::size_t>(m)];
                                 const double tau = durations.size() > 0 ? durations[m] : duration();
                                 detail::require_duration(tau);
                                 take(m, rollout(goal, tau, tau / static_cast<double>(samples - 1)));
                               });
}

}  // namespace dmp
