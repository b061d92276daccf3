#include <dmp/error.hpp>

#include <optional>
#include <utility>

#include "primitive/advance.hpp"
#include "primitive/cycle.hpp"
#include "primitive/learning.hpp"
#include "primitive/parameters.hpp"
#include "primitive/space.hpp"

namespace dmp::detail {

using Eigen::Index;
using Eigen::VectorXd;
using VectorGeometry = Geometry<VectorSpace>;

namespace {

Trajectory sampled(const Demonstration& demonstration, const DmpOptions& options) {
  if (options.derivatives != Derivatives::gradient)
    return demonstration.at(fit_times(demonstration.time(), options));
  const VectorXd& time = demonstration.time();
  const RowMatrix velocity = gradient(time, demonstration.position());
  return {time, demonstration.position(), velocity, gradient(time, velocity)};
}

}  // namespace

void VectorGeometry::require(const VectorXd& point, const VectorXd& like, const std::string& name) {
  require_finite(point, like.size(), name);
}

VectorXd VectorGeometry::mean(const std::vector<VectorXd>& points) {
  const double share = 1.0 / static_cast<double>(points.size());
  VectorXd mean = VectorXd::Zero(points.front().size());
  for (const VectorXd& point : points) mean += share * point;
  return mean;
}

VectorXd VectorGeometry::displacement(const VectorXd& start, const VectorXd& goal, const VectorXd&,
                                      const DmpOptions&) {
  return goal - start;
}

Ends<VectorSpace> VectorGeometry::ends_of(const DmpParameters& p) {
  return {p.start, p.goal, p.duration * p.start_velocity, p.goal - p.start, p.amplitude, {}};
}

void VectorGeometry::set_ends(DmpParameters& p, const Ends<VectorSpace>& ends) {
  p.start = ends.start;
  p.goal = ends.goal;
  p.start_velocity = ends.z / p.duration;
  p.amplitude = ends.amplitude;
}

namespace {

/// Of one cycle about its mean.
Example<VectorSpace> cycle_of(const Demonstration& cycle, const DmpOptions& options) {
  require_closed(cycle);
  Trajectory motion = round_of(cycle, cycle_samples(cycle.size(), options));
  const double tau = cycle.duration();
  const VectorXd start = motion.position.row(0);
  const VectorXd centre = motion.position.colwise().mean();
  const VectorXd range = motion.position.colwise().maxCoeff() - motion.position.colwise().minCoeff();
  const auto to_centre = (-motion.position).rowwise() + centre.transpose();
  Example<VectorSpace> example{
      {start, centre, tau * motion.velocity.row(0), centre - start, range, {}}, {}, {}};
  example.advance = RowMatrix::Zero(motion.time.size(), 1);
  example.target = {motion.time / tau,
                    forcing_of(tau, options.alpha, *options.beta, std::move(motion.acceleration), to_centre,
                               motion.velocity),
                    VectorXd::Ones(start.size())};
  return example;
}

}  // namespace

Example<VectorSpace> VectorGeometry::example_of(const Demonstration& given, const DmpOptions& options,
                                                const RowMatrix&) {
  if (options.motion == Motion::rhythmic)
    return cycle_of(options.derivatives == Derivatives::smooth ? given.smoothed() : given, options);
  const std::optional<Demonstration> smoothed =
      options.derivatives == Derivatives::smooth ? std::optional(given.smoothed()) : std::nullopt;
  const Demonstration& demonstration = smoothed ? *smoothed : given;
  Trajectory motion = sampled(demonstration, options);
  const double tau = demonstration.duration();
  const RowMatrix& position = demonstration.position();
  const VectorXd start = position.row(0);
  const VectorXd goal = position.row(demonstration.size() - 1);
  const VectorXd range = position.colwise().maxCoeff() - position.colwise().minCoeff();
  const auto to_goal = (-motion.position).rowwise() + goal.transpose();
  Example<VectorSpace> example{
      {start, goal, tau * motion.velocity.row(0), goal - start, range, {}}, {}, {}, goal - start};
  example.advance =
      advance_along(motion.time / tau, motion.velocity, goal - start, range, {options.alpha, *options.beta});
  example.target = {
      motion.time / tau,
      forcing_of(tau, options.alpha, *options.beta, std::move(motion.acceleration), to_goal, motion.velocity),
      VectorXd::Ones(start.size())};
  return example;
}

Trajectory VectorGeometry::room_for(const VectorXd& times, const VectorXd& point) {
  const RowMatrix room(times.size(), point.size());
  return {times, room, room, room};
}

void VectorGeometry::record(Trajectory& trajectory, Index k, VectorSpace::Output output) {
  trajectory.position.row(k) = output.position;
  trajectory.velocity.row(k) = output.velocity;
  trajectory.acceleration.row(k) = output.acceleration;
}

void VectorGeometry::deviation(VectorSpace::Output output, const Demonstration& demonstration, Index k,
                               double* away) {
  Eigen::Map<Eigen::RowVectorXd>(away, demonstration.dimension()) =
      output.position.transpose() - demonstration.position().row(k);
}

void VectorGeometry::add_second_differences(const Demonstration& demonstration, Index k,
                                            std::vector<double>& sizes) {
  const RowMatrix& y = demonstration.position();
  const VectorXd& t = demonstration.time();
  const Eigen::RowVectorXd before = (y.row(k) - y.row(k - 1)) / (t[k] - t[k - 1]);
  const Eigen::RowVectorXd after = (y.row(k + 1) - y.row(k)) / (t[k + 1] - t[k]);
  sizes.push_back(2.0 * (after - before).norm() / (t[k + 1] - t[k - 1]));
}

Demonstration VectorGeometry::denoised(const Demonstration& demonstration,
                                       std::vector<NoiseEstimate>& found) {
  return demonstration.denoised(&found.emplace_back());
}

void VectorGeometry::add_extents(const Demonstration& demonstration, std::vector<Extent>& extents) {
  const RowMatrix& y = demonstration.position();
  extents.push_back({y.cols(), (y.colwise().maxCoeff() - y.colwise().minCoeff()).norm(),
                     std::max(1e-9 * y.cwiseAbs().maxCoeff(), 1e-12)});
}

std::vector<VectorXd> VectorGeometry::points_at(const Demonstration& demonstration, const VectorXd& times) {
  const RowMatrix position = demonstration.at(times).position;
  const auto rows = position.rowwise();
  return {rows.begin(), rows.end()};
}

RowMatrix VectorGeometry::path_of(const std::vector<VectorXd>& points) {
  RowMatrix path(static_cast<Index>(points.size()), points.front().size());
  for (std::size_t k = 0; k < points.size(); ++k) path.row(static_cast<Index>(k)) = points[k];
  return path;
}

}  // namespace dmp::detail
