#pragma once

#include <dmp/dmp.hpp>
#include <dmp/export.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace dmp {

/// One model for each demonstration: what fit(demonstrations[j], options) gives, bit for bit. Demonstrations
/// with the same time grid one after another share what depends on the times alone. threads: as
/// parallel_for. Throws InvalidArgument as fit does, before it the number of the demonstration.
DMP_EXPORT std::vector<Dmp> fit_each(const std::vector<Demonstration>& demonstrations,
                                     const DmpOptions& options = {}, int threads = 1);
DMP_EXPORT std::vector<OrientationDmp> fit_each(const std::vector<OrientationDemonstration>& demonstrations,
                                                const DmpOptions& options = {}, int threads = 1);
DMP_EXPORT std::vector<PoseDmp> fit_each(const std::vector<PoseDemonstration>& demonstrations,
                                         const DmpOptions& options = {}, int threads = 1);

/// The same for demonstrations on one time grid (T) s: positions (T x dims), rotations (T) or poses (T) each.
DMP_EXPORT std::vector<Dmp> fit_each(const Eigen::VectorXd& times, const std::vector<RowMatrix>& positions,
                                     const DmpOptions& options = {}, int threads = 1);
DMP_EXPORT std::vector<OrientationDmp> fit_each(const Eigen::VectorXd& times,
                                                const std::vector<Rotations>& rotations,
                                                const DmpOptions& options = {}, int threads = 1);
DMP_EXPORT std::vector<PoseDmp> fit_each(const Eigen::VectorXd& times, const std::vector<Poses>& poses,
                                         const DmpOptions& options = {}, int threads = 1);

/// One motion for each goal and duration, `samples` (2 or more) evenly from 0 to its duration: what
/// model.rollout(goal, duration, duration / (samples - 1)) gives, bit for bit. goals or durations may be
/// empty: the demonstrated one for all; otherwise there must be as many of both.
DMP_EXPORT std::vector<Trajectory> rollout_each(const Dmp& model, const std::vector<Eigen::VectorXd>& goals,
                                                const Eigen::VectorXd& durations, Eigen::Index samples,
                                                int threads = 1);
DMP_EXPORT std::vector<OrientationTrajectory> rollout_each(const OrientationDmp& model,
                                                           const Rotations& goals,
                                                           const Eigen::VectorXd& durations,
                                                           Eigen::Index samples, int threads = 1);
DMP_EXPORT std::vector<PoseTrajectory> rollout_each(const PoseDmp& model, const Poses& goals,
                                                    const Eigen::VectorXd& durations, Eigen::Index samples,
                                                    int threads = 1);

/// The same, none of them kept: each is handed to take(m, motion), on the thread that made it.
template <class Motion>
using Take = std::function<void(Eigen::Index m, const Motion& motion)>;
DMP_EXPORT void rollout_each(const Dmp& model, const std::vector<Eigen::VectorXd>& goals,
                             const Eigen::VectorXd& durations, Eigen::Index samples,
                             const Take<Trajectory>& take, int threads = 1);
DMP_EXPORT void rollout_each(const OrientationDmp& model, const Rotations& goals,
                             const Eigen::VectorXd& durations, Eigen::Index samples,
                             const Take<OrientationTrajectory>& take, int threads = 1);
DMP_EXPORT void rollout_each(const PoseDmp& model, const Poses& goals, const Eigen::VectorXd& durations,
                             Eigen::Index samples, const Take<PoseTrajectory>& take, int threads = 1);

}  // namespace dmp
