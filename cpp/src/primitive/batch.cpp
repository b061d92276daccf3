#include <dmp/batch.hpp>
#include <dmp/error.hpp>
#include <dmp/parallel.hpp>

#include <optional>
#include <string>

#include "base/text.hpp"
#include "primitive/forcing_fit.hpp"
#include "primitive/rollout.hpp"

namespace dmp {

using Eigen::Index;
using Eigen::VectorXd;

namespace detail {

/// Fits one demonstration after another with one memory for what they share.
struct BatchFit {
  template <class Model, class Demonstration>
  static std::vector<Model> all(const std::vector<Demonstration>& demonstrations, const DmpOptions& options,
                                int threads) {
    return each<Model>(
        static_cast<Index>(demonstrations.size()), threads, [&](Index first, Index last, auto fit) {
          for (Index j = first; j < last; ++j)
            fit(
                j, [&]() -> const Demonstration& { return demonstrations[static_cast<std::size_t>(j)]; },
                options);
        });
  }

  /// values (one for each demonstration) at the same times.
  template <class Model, class Demonstration, class Values>
  static std::vector<Model> on_grid(const VectorXd& times, const std::vector<Values>& values,
                                    const DmpOptions& options, int threads) {
    return each<Model>(static_cast<Index>(values.size()), threads, [&](Index first, Index last, auto fit) {
      std::optional<Demonstration> grid;
      for (Index j = first; j < last; ++j) {
        const Values& given = values[static_cast<std::size_t>(j)];
        fit(
            j,
            [&] {
              if (!grid) grid.emplace(times, given);
              return j == first ? *grid : grid->with(given);
            },
            options);
      }
    });
  }

 private:
  /// fit_range(first, last, fit) calls fit(j, demonstration, options) for each j.
  template <class Model, class FitRange>
  static std::vector<Model> each(Index count, int threads, FitRange fit_range) {
    std::vector<std::optional<Model>> models(static_cast<std::size_t>(count));
    parallel_for(count, threads, [&](Index first, Index last) {
      std::unique_ptr<ForcingFit> memory;
      fit_range(first, last, [&](Index j, auto demonstration, const DmpOptions& options) {
        try {
          const auto& one = demonstration();
          models[static_cast<std::size_t>(j)] = Model::fit_together(&one, 1, options, memory);
        } catch (const InvalidArgument& error) {
          throw InvalidArgument(indexed("demonstrations", static_cast<long>(j)) + ": " + error.what());
        }
      });
    });
    std::vector<Model> result;
    result.reserve(models.size());
    for (std::optional<Model>& model : models) result.push_back(std::move(*model));
    return result;
  }
};

namespace {

template <class Goals>
Index count_of(const Goals& goals, const VectorXd& durations) {
  const Index given = static_cast<Index>(goals.size());
  if (given > 0 && durations.size() > 0 && given != durations.size())
    throw InvalidArgument("durations: " + std::to_string(durations.size()) + " for " + std::to_string(given) +
                          " goals, expected as many of both, or none.");
  return std::max(given, durations.size());
}

template <class Model, class Goals, class Take>
void roll_out_each(const Model& model, const Goals& goals, const VectorXd& durations, Index samples,
                   const Take& take, int threads) {
  if (samples < 2) throw InvalidArgument("samples: " + std::to_string(samples) + ", expected 2 or more.");
  parallel_for(count_of(goals, durations), threads, [&](Index first, Index last) {
    for (Index m = first; m < last; ++m) {
      std::optional<typename Goals::value_type> goal;
      if (!goals.empty()) goal = goals[static_cast<std::size_t>(m)];
      const double duration = durations.size() > 0 ? durations[m] : model.duration();
      try {
        require_duration(duration);
        auto motion = model.rollout(goal, duration, duration / static_cast<double>(samples - 1));
        take(m, std::move(motion));
      } catch (const InvalidArgument& error) {
        throw InvalidArgument(indexed("rollouts", static_cast<long>(m)) + ": " + error.what());
      }
    }
  });
}

template <class Motion, class Model, class Goals>
std::vector<Motion> rolled_out(const Model& model, const Goals& goals, const VectorXd& durations,
                               Index samples, int threads) {
  std::vector<Motion> motions(static_cast<std::size_t>(count_of(goals, durations)));
  const auto keep = [&](Index m, Motion&& motion) {
    motions[static_cast<std::size_t>(m)] = std::move(motion);
  };
  roll_out_each(model, goals, durations, samples, keep, threads);
  return motions;
}

}  // namespace
}  // namespace detail

std::vector<Dmp> fit_each(const std::vector<Demonstration>& demonstrations, const DmpOptions& options,
                          int threads) {
  return detail::BatchFit::all<Dmp>(demonstrations, options, threads);
}
std::vector<OrientationDmp> fit_each(const std::vector<OrientationDemonstration>& demonstrations,
                                     const DmpOptions& options, int threads) {
  return detail::BatchFit::all<OrientationDmp>(demonstrations, options, threads);
}
std::vector<PoseDmp> fit_each(const std::vector<PoseDemonstration>& demonstrations, const DmpOptions& options,
                              int threads) {
  return detail::BatchFit::all<PoseDmp>(demonstrations, options, threads);
}

std::vector<Dmp> fit_each(const VectorXd& times, const std::vector<RowMatrix>& positions,
                          const DmpOptions& options, int threads) {
  return detail::BatchFit::on_grid<Dmp, Demonstration>(times, positions, options, threads);
}
std::vector<OrientationDmp> fit_each(const VectorXd& times, const std::vector<Rotations>& rotations,
                                     const DmpOptions& options, int threads) {
  return detail::BatchFit::on_grid<OrientationDmp, OrientationDemonstration>(times, rotations, options,
                                                                             threads);
}
std::vector<PoseDmp> fit_each(const VectorXd& times, const std::vector<Poses>& poses,
                              const DmpOptions& options, int threads) {
  return detail::BatchFit::on_grid<PoseDmp, PoseDemonstration>(times, poses, options, threads);
}

std::vector<Trajectory> rollout_each(const Dmp& model, const std::vector<VectorXd>& goals,
                                     const VectorXd& durations, Index samples, int threads) {
  return detail::rolled_out<Trajectory>(model, goals, durations, samples, threads);
}
std::vector<OrientationTrajectory> rollout_each(const OrientationDmp& model, const Rotations& goals,
                                                const VectorXd& durations, Index samples, int threads) {
  return detail::rolled_out<OrientationTrajectory>(model, goals, durations, samples, threads);
}
std::vector<PoseTrajectory> rollout_each(const PoseDmp& model, const Poses& goals, const VectorXd& durations,
                                         Index samples, int threads) {
  return detail::rolled_out<PoseTrajectory>(model, goals, durations, samples, threads);
}

void rollout_each(const Dmp& model, const std::vector<VectorXd>& goals, const VectorXd& durations,
                  Index samples, const Take<Trajectory>& take, int threads) {
  detail::roll_out_each(model, goals, durations, samples, take, threads);
}
void rollout_each(const OrientationDmp& model, const Rotations& goals, const VectorXd& durations,
                  Index samples, const Take<OrientationTrajectory>& take, int threads) {
  detail::roll_out_each(model, goals, durations, samples, take, threads);
}
void rollout_each(const PoseDmp& model, const Poses& goals, const VectorXd& durations, Index samples,
                  const Take<PoseTrajectory>& take, int threads) {
  detail::roll_out_each(model, goals, durations, samples, take, threads);
}

}  // namespace dmp
