#pragma once

#include <dmp/dmp.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace dmp {

/// One model for each demonstration; see Primitive::fit_each.
template <class Demonstration>
auto fit_each(const std::vector<Demonstration>& demonstrations, const DmpOptions& options = {},
              int threads = 1) {
  return Primitive<typename SpaceOf<Demonstration>::type>::fit_each(demonstrations, options, threads);
}

// For lists in braces, whose type no template can deduce.
inline std::vector<Dmp> fit_each(const std::vector<Demonstration>& demonstrations,
                                 const DmpOptions& options = {}, int threads = 1) {
  return Dmp::fit_each(demonstrations, options, threads);
}
inline std::vector<OrientationDmp> fit_each(const std::vector<OrientationDemonstration>& demonstrations,
                                            const DmpOptions& options = {}, int threads = 1) {
  return OrientationDmp::fit_each(demonstrations, options, threads);
}
inline std::vector<PoseDmp> fit_each(const std::vector<PoseDemonstration>& demonstrations,
                                     const DmpOptions& options = {}, int threads = 1) {
  return PoseDmp::fit_each(demonstrations, options, threads);
}

/// The same for demonstrations on one time grid (T) s: positions (T x d), rotations (T) or poses (T) each.
template <class Path>
auto fit_each(const Eigen::VectorXd& times, const std::vector<Path>& paths, const DmpOptions& options = {},
              int threads = 1) {
  return Primitive<typename SpaceOf<Path>::type>::fit_each(times, paths, options, threads);
}

/// One motion for each goal and duration; see Primitive::rollout_each.
template <class Space>
void rollout_each(const Primitive<Space>& model, const std::vector<typename Space::Point>& goals,
                  const Eigen::VectorXd& durations, Eigen::Index samples,
                  const Take<typename Space::Trajectory>& take, int threads = 1) {
  model.rollout_each(goals, durations, samples, take, threads);
}

/// The same, all of them kept.
template <class Space>
std::vector<typename Space::Trajectory> rollout_each(const Primitive<Space>& model,
                                                     const std::vector<typename Space::Point>& goals,
                                                     const Eigen::VectorXd& durations, Eigen::Index samples,
                                                     int threads = 1) {
  using Result = typename Space::Trajectory;
  std::vector<Result> motions(std::max(goals.size(), static_cast<std::size_t>(durations.size())));
  model.rollout_each(
      goals, durations, samples,
      [&](Eigen::Index m, const Result& motion) { motions[static_cast<std::size_t>(m)] = motion; }, threads);
  return motions;
}

}  // namespace dmp
