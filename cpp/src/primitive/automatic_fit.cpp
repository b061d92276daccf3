#include "primitive/automatic_fit.hpp"

#include <dmp/so3.hpp>

#include <cmath>

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kShareOfNoise = 0.25;  // of the error that smoothing leaves: 3 % more in all
constexpr double kShareOfDetail = 0.4;  // of what neighbours leave open of a sample
constexpr double kFinest = 3e-6;        // of the extent
constexpr double kCoarsest = 3e-4;      // likewise
constexpr double kLeastExtent = 0.3;    // rad; what turns less is no motion of the orientation
constexpr double kRounding = 1e-9;      // of the largest value
constexpr Index kMostTimes = 400;       // at which a model is compared

/// How close is close enough. The error that smoothing leaves is sigma sqrt(axes freedom).
Closeness closeness(const NoiseEstimate& noise, int axes, double extent, double least) {
  const double detail = std::clamp(kShareOfDetail * noise.unpredicted, kFinest * extent, kCoarsest * extent);
  if (!noise.found()) return {std::max(detail, least), extent, false};
  const double left = noise.sigma * std::sqrt(axes * noise.freedom);
  return {std::max({kShareOfNoise * left, kFinest * extent, least}), extent, true};
}

/// The tolerance of a part that has noise, over its extent.
double share_left(const Closeness& part) {
  return part.smoothed && part.extent > 0.0 ? std::min(part.tolerance / part.extent, kCoarsest) : 0.0;
}

Closeness closeness(const Demonstration& motion, const NoiseEstimate& noise) {
  const RowMatrix& y = motion.position();
  const double extent = (y.colwise().maxCoeff() - y.colwise().minCoeff()).norm();
  return closeness(noise, static_cast<int>(y.cols()), extent,
                   std::max(kRounding * y.cwiseAbs().maxCoeff(), 1e-12));
}

Closeness closeness(const OrientationDemonstration& motion, const NoiseEstimate& noise) {
  double extent = kLeastExtent;
  for (const Eigen::Matrix3d& rotation : motion.rotation())
    extent = std::max(extent, so3::distance(rotation, motion.rotation().front()));
  return closeness(noise, 3, extent, kRounding);
}

double root_of_mean(double squares, std::size_t count) {
  return std::sqrt(squares / static_cast<double>(count));
}

double distance_of(const Demonstration& motion, const std::vector<Index>& chosen, const RowMatrix& position) {
  double squares = 0.0;
  for (std::size_t k = 0; k < chosen.size(); ++k)
    squares += (position.row(static_cast<Index>(k)) - motion.position().row(chosen[k])).squaredNorm();
  return root_of_mean(squares, chosen.size());
}

template <class RotationAt>
double angle_of(const OrientationDemonstration& motion, const std::vector<Index>& chosen,
                RotationAt rotation) {
  double squares = 0.0;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const double angle = so3::distance(rotation(k), motion.rotation()[static_cast<std::size_t>(chosen[k])]);
    squares += angle * angle;
  }
  return root_of_mean(squares, chosen.size());
}

}  // namespace

void share_noise(std::vector<Closeness>& parts) {
  for (Closeness& part : parts)
    for (const Closeness& other : parts)
      if (&other != &part) part.tolerance = std::max(part.tolerance, share_left(other) * part.extent);
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

Prepared<Demonstration> prepared(const Demonstration& given, Derivatives derivatives) {
  NoiseEstimate noise;
  const Demonstration motion = given.denoised(&noise);
  if (derivatives != Derivatives::automatic) return {given, {closeness(given, noise)}};
  return {motion, {closeness(motion, noise)}};
}

Prepared<OrientationDemonstration> prepared(const OrientationDemonstration& given, Derivatives derivatives) {
  NoiseEstimate noise;
  const OrientationDemonstration motion = given.denoised(&noise);
  if (derivatives != Derivatives::automatic) return {given, {closeness(given, noise)}};
  return {motion, {closeness(motion, noise)}};
}

Prepared<PoseDemonstration> prepared(const PoseDemonstration& given, Derivatives derivatives) {
  NoiseEstimate position, orientation;
  const PoseDemonstration cleaned = given.denoised(&position, &orientation);
  const PoseDemonstration& motion = derivatives == Derivatives::automatic ? cleaned : given;
  std::vector<Closeness> parts{closeness(motion.position(), position),
                               closeness(motion.orientation(), orientation)};
  share_noise(parts);
  return {motion, parts};
}

void add_misses(std::vector<double>& misses, const Demonstration& motion, const std::vector<Index>& chosen,
                const Trajectory& again) {
  misses.push_back(distance_of(motion, chosen, again.position));
}

void add_misses(std::vector<double>& misses, const OrientationDemonstration& motion,
                const std::vector<Index>& chosen, const OrientationTrajectory& again) {
  misses.push_back(angle_of(motion, chosen, [&](std::size_t k) { return again.rotation[k]; }));
}

void add_misses(std::vector<double>& misses, const PoseDemonstration& motion,
                const std::vector<Index>& chosen, const PoseTrajectory& again) {
  RowMatrix position(static_cast<Index>(chosen.size()), 3);
  for (std::size_t k = 0; k < chosen.size(); ++k)
    position.row(static_cast<Index>(k)) = again.pose[k].topRightCorner<3, 1>().transpose();
  misses.push_back(distance_of(motion.position(), chosen, position));
  misses.push_back(angle_of(motion.orientation(), chosen, [&](std::size_t k) -> Eigen::Matrix3d {
    return again.pose[k].topLeftCorner<3, 3>();
  }));
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
