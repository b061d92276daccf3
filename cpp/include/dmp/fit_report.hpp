#pragma once

#include <dmp/dmp.hpp>
#include <dmp/export.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace dmp {

/// What counts as reproduced: root of the mean square over all samples.
struct Tolerance {
  double position = 1e-3;  ///< m, or the unit of the positions
  double angle = 0.0087;   ///< rad; about half a degree
};

/// Accelerations (m/s^2, rad/s^2) in the first and the last 3 % of a demonstration: the largest of the model,
/// and the largest second difference of the samples, which hold no more.
struct EndPeaks {
  double start = 0.0;
  double goal = 0.0;
  double start_samples = 0.0;
  double goal_samples = 0.0;
};

/// How a model reproduces demonstrations, and what was found in them. Columns: the dimensions of a position;
/// the components of the rotation vector between the two orientations (world frame, rad); for poses three of
/// each.
struct FitReport {
  Eigen::VectorXd rmse;  ///< (d) rollout at each demonstration's own start, goal and duration, at its samples
  Eigen::VectorXd largest;  ///< (d)
  Eigen::VectorXd noise;    ///< (d) standard deviation found in the data (NoiseEstimate); 0 if there is none
  Eigen::VectorXd
      removed;  ///< (d) root of the mean square that smoothing took out; 0 unless it was asked for
  /// What each demonstration shows of noise: of its positions, of its orientations, or of both.
  std::vector<std::vector<NoiseEstimate>> evidence;
  /// The same demonstrations and parts: whether the ends are as calm as recorded.
  std::vector<std::vector<EndPeaks>> ends;
  double largest_log = 0.0;  ///< rad, the largest |Log(Rg R^T)| on the way; 0 for positions
  double condition = 1.0;    ///< of the regression's matrix
  int suggested_basis_count =
      0;  ///< the fewest of 10, 20, 40, .. 1280 kernels that reach the tolerance; 0: none does
  std::vector<std::string> warnings;
};

/// Holds a model against demonstrations, those that it was learned from or others. Throws InvalidArgument for
/// none, for another dimension, or for a tolerance that is not positive.
template <class Space>
DMP_EXPORT FitReport assess(const Primitive<Space>& model,
                            const std::vector<typename Space::Demonstration>& demonstrations,
                            const Tolerance& tolerance = {});

}  // namespace dmp
