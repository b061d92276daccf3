#pragma once

#include <dmp/basis.hpp>
#include <dmp/demonstration.hpp>
#include <dmp/forcing.hpp>
#include <dmp/options.hpp>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "primitive/turning_reference.hpp"

namespace dmp::detail {

/// The largest |Log(Rg R^T)| on the way, rad.
double largest_log(const OrientationDemonstration& demonstration, LogBranch branch);

/// Settles OrientationForm::automatic for a model whose largest logarithm is as given. Throws InvalidArgument
/// unless there is a reference if and only if the form needs one.
void settle_form(DmpOptions& options, double largest_log, const RowMatrix& reference);

/// Settles it for demonstrations, which are learned together, and finds what the turning form turns with.
std::optional<TurningReference> choose_form(DmpOptions& options,
                                            const std::vector<const OrientationDemonstration*>& together);

GaussianBasis basis_of(const DmpOptions& resolved);

/// Where a demonstration is looked at: at its samples, or, where they are few for the kernels, on the spline
/// at ten points a kernel. `time` (T) s from 0.
Eigen::VectorXd fit_times(const Eigen::VectorXd& time, const DmpOptions& options);

/// One demonstration as a fit sees it: start, goal, range, and the forcing term that would reproduce it.
struct PositionLesson {
  Eigen::VectorXd start;
  Eigen::VectorXd goal;
  Eigen::VectorXd start_z;  ///< tau yd(0), or 0 for a start at rest
  Eigen::VectorXd amplitude;
  ForcingTarget target;  ///< its scale is left at 1
};
PositionLesson lesson_of(const Demonstration& demonstration, const DmpOptions& options);

struct OrientationLesson {
  Eigen::Matrix3d start;
  Eigen::Matrix3d goal;
  Eigen::Vector3d start_eta;    ///< tau omega(0), or 0
  Eigen::Vector3d start_error;  ///< Log(Rg R0^T) on its branch
  Eigen::Vector3d amplitude;
  ForcingTarget target;
};
/// In the turning form without `reference` there is no target.
OrientationLesson lesson_of(const OrientationDemonstration& demonstration, const DmpOptions& options,
                            const TurningReference* reference = nullptr);

/// Sets a target's scale (its axes from `first` on) after the scaling that the options name: the forcing of a
/// demonstration whose displacement is `displacement`, in a model whose displacement is `reference`.
void apply_scaling(ForcingTarget& target, Eigen::Index first, const Eigen::VectorXd& displacement,
                   const Eigen::VectorXd& reference, const Eigen::VectorXd& amplitude,
                   const DmpOptions& options);

}  // namespace dmp::detail
