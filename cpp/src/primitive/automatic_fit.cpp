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

/// At most so many of the times of a demonstration, the first and the last among them.
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
  Closeness first = closeness(motion.position(), position);
  Closeness second = closeness(motion.orientation(), orientation);
  // Where one part has noise, the other need not be closer to its extent than that one can be.
  first.tolerance = std::max(first.tolerance, share_left(second) * first.extent);
  second.tolerance = std::max(second.tolerance, share_left(first) * second.extent);
  return {motion, {first, second}};
}

double miss(const Dmp& model, const Prepared<Demonstration>& aim) {
  const std::vector<Index> chosen = some(aim.motion.size());
  const Trajectory again = model.rollout_at(times_at(aim.motion.time(), chosen));
  return distance_of(aim.motion, chosen, again.position) / aim.parts[0].tolerance;
}

double miss(const OrientationDmp& model, const Prepared<OrientationDemonstration>& aim) {
  const std::vector<Index> chosen = some(aim.motion.size());
  const OrientationTrajectory again = model.rollout_at(times_at(aim.motion.time(), chosen));
  return angle_of(aim.motion, chosen, [&](std::size_t k) { return again.rotation[k]; }) /
         aim.parts[0].tolerance;
}

double miss(const PoseDmp& model, const Prepared<PoseDemonstration>& aim) {
  const std::vector<Index> chosen = some(aim.motion.size());
  const PoseTrajectory again = model.rollout_at(times_at(aim.motion.time(), chosen));
  RowMatrix position(static_cast<Index>(chosen.size()), 3);
  for (std::size_t k = 0; k < chosen.size(); ++k)
    position.row(static_cast<Index>(k)) = again.pose[k].topRightCorner<3, 1>().transpose();
  const double angle = angle_of(aim.motion.orientation(), chosen, [&](std::size_t k) -> Eigen::Matrix3d {
    return again.pose[k].topLeftCorner<3, 3>();
  });
  return std::max(distance_of(aim.motion.position(), chosen, position) / aim.parts[0].tolerance,
                  angle / aim.parts[1].tolerance);
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
