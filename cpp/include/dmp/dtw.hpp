#pragma once

#include <dmp/export.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

namespace dmp {

/// Which samples of two motions belong together.
struct Alignment {
  /// Pairs (sample of the first, sample of the second), from the first of both to the last of both; each pair
  /// goes on by one sample in one motion or in both.
  std::vector<std::pair<Eigen::Index, Eigen::Index>> path;
  double distance =
      0.0;  ///< sum over the path of the distances of its pairs; divide by path.size() for the mean
};

/// Dynamic time warping (Sakoe and Chiba 1978, "Dynamic programming algorithm optimization for spoken word
/// recognition"; steps of weight 1 each): the path with the least sum of Euclidean distances between rows of
/// a (T x d) and b (S x d).
///
/// `band`: how many samples of b a pair may lie off the straight line from the first pair to the last; it is
/// widened to half a sample, and to half the ratio of the lengths, where no path would fit. Without it every
/// pair is allowed. Time and memory (a byte a pair) grow with T S, or with T times the band.
/// Throws InvalidArgument, naming the row, for no samples, different columns, numbers that are not finite or
/// so large that distances overflow, or a negative band.
DMP_EXPORT Alignment align(const RowMatrix& a, const RowMatrix& b, std::optional<double> band = {});

/// The same for poses, whose distance is |pa - pb| + angle_weight * angle(Ra, Rb). angle_weight: m/rad; 0
/// leaves positions alone. Throws InvalidArgument as above, for a matrix that is no rotation, and for a
/// negative weight.
DMP_EXPORT Alignment align(const Poses& a, const Poses& b, double angle_weight = 0.2,
                           std::optional<double> band = {});

/// Discrete Frechet distance of the rows of a (T x d) and b (S x d), in their unit: the shortest leash that
/// lets a walker on each path reach the end, both going forward only, from sample to sample (Eiter and
/// Mannila 1994, "Computing discrete Frechet distance", TU Wien CD-TR 94/64). Throws InvalidArgument as
/// `align`.
DMP_EXPORT double frechet(const RowMatrix& a, const RowMatrix& b);

}  // namespace dmp
