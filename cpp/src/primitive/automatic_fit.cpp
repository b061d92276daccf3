#include "primitive/automatic_fit.hpp"

#include <algorithm>
#include <cmath>

namespace dmp::detail {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kShareOfNoise = 0.25;  // of the error that smoothing leaves: 3 % more in all
constexpr double kShareOfDetail = 0.4;  // of what neighbours leave open of a sample
constexpr double kFinest = 3e-6;        // of the extent
constexpr double kCoarsest = 3e-4;      // likewise
constexpr Index kMostTimes = 400;       // at which a model is compared

/// The tolerance of a part that has noise, over its extent.
double share_left(const Closeness& part) {
  return part.smoothed && part.extent > 0.0 ? std::min(part.tolerance / part.extent, kCoarsest) : 0.0;
}

/// The error that smoothing leaves is sigma sqrt(axes freedom).
Closeness closeness_of(const Extent& part, const NoiseEstimate& noise) {
  const double extent = part.size;
  const double detail = std::clamp(kShareOfDetail * noise.unpredicted, kFinest * extent, kCoarsest * extent);
  if (!noise.found()) return {part.axes, std::max(detail, part.rounding), extent, false};
  const double left = noise.sigma * std::sqrt(static_cast<double>(part.axes) * noise.freedom);
  return {part.axes, std::max({kShareOfNoise * left, kFinest * extent, part.rounding}), extent, true};
}

}  // namespace

std::vector<Closeness> closeness(const std::vector<Extent>& parts, const std::vector<NoiseEstimate>& noise) {
  std::vector<Closeness> result;
  for (std::size_t i = 0; i < parts.size(); ++i) result.push_back(closeness_of(parts[i], noise[i]));
  // Where one part has noise, no other need be closer to its extent than that one can be.
  for (Closeness& part : result)
    for (const Closeness& other : result)
      if (&other != &part) part.tolerance = std::max(part.tolerance, share_left(other) * part.extent);
  return result;
}

double worst_of(const VectorXd& squares, Index samples, const std::vector<Closeness>& parts) {
  double worst = 0.0;
  Index first = 0;
  for (const Closeness& part : parts) {
    const double mean = squares.segment(first, part.axes).sum() / static_cast<double>(samples);
    worst = std::max(worst, std::sqrt(mean) / part.tolerance);
    first += part.axes;
  }
  return worst;
}

std::vector<Index> some(Index count) {
  const Index wanted = std::min(count, kMostTimes);
  std::vector<Index> chosen;
  for (Index k = 0; k < wanted; ++k) chosen.push_back(k * (count - 1) / (wanted - 1));
  return chosen;
}

VectorXd times_at(const VectorXd& time, const std::vector<Index>& chosen) {
  VectorXd times(static_cast<Index>(chosen.size()));
  for (std::size_t k = 0; k < chosen.size(); ++k) times[static_cast<Index>(k)] = time[chosen[k]];
  return times;
}

DmpOptions with_regression(const DmpOptions& options) {
  DmpOptions stated = options;
  if (options.regression != Regression::automatic) return stated;
  constexpr int kMostForRidge = 4000;
  const bool local = options.passes != DmpOptions{}.passes || options.kernels == Kernels::source ||
                     options.basis_count > kMostForRidge;
  stated.regression = local ? Regression::lwr : Regression::ridge;
  return stated;
}

}  // namespace dmp::detail
