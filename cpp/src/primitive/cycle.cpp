#include "primitive/cycle.hpp"

#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include "base/text.hpp"

namespace dmp::detail {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kOpen = 0.05;      // of the extent
constexpr double kOpenAngle = 0.2;  // rad
constexpr const char* kUse = "expected one cycle, whose last sample is its first one again: see find_cycle.";

VectorXd three_times(const VectorXd& time) {
  const Index n = time.size() - 1;
  const double period = time[n];
  VectorXd times(3 * n + 1);
  for (Index k = 0; k < 3 * n + 1; ++k) times[k] = time[k % n] + period * static_cast<double>(k / n);
  return times;
}

VectorXd middle_times(double period, Index count) {
  const double step = period / static_cast<double>(count);
  return VectorXd::LinSpaced(count, period, period + static_cast<double>(count - 1) * step);
}

}  // namespace

void require_closed(const Demonstration& cycle) {
  const RowMatrix& y = cycle.position();
  const double extent = (y.colwise().maxCoeff() - y.colwise().minCoeff()).norm();
  const double open = (y.row(y.rows() - 1) - y.row(0)).norm();
  if (cycle.size() < 8 || open > kOpen * extent)
    throw InvalidArgument("demonstration: " + std::to_string(cycle.size()) + " samples that end " +
                          number(open) + " from where they start, of an extent of " + number(extent) + "; " +
                          kUse);
}

void require_closed(const OrientationDemonstration& cycle) {
  const double open = so3::distance(cycle.rotation().front(), cycle.rotation().back());
  if (cycle.size() < 8 || open > kOpenAngle)
    throw InvalidArgument("demonstration: " + std::to_string(cycle.size()) + " samples that end " +
                          number(open) + " rad from where they start; " + kUse);
}

Demonstration three_of(const Demonstration& cycle) {
  const Index n = cycle.size() - 1;
  RowMatrix positions(3 * n + 1, cycle.dimension());
  for (Index k = 0; k < positions.rows(); ++k) positions.row(k) = cycle.position().row(k % n);
  return {three_times(cycle.time()), positions};
}

OrientationDemonstration three_of(const OrientationDemonstration& cycle) {
  const std::size_t n = static_cast<std::size_t>(cycle.size() - 1);
  Rotations rotations;
  for (std::size_t k = 0; k < 3 * n + 1; ++k) rotations.push_back(cycle.rotation()[k % n]);
  return {three_times(cycle.time()), rotations};
}

Trajectory round_of(const Demonstration& cycle, Index count) {
  Trajectory round = three_of(cycle).at(middle_times(cycle.duration(), count));
  round.time.array() -= cycle.duration();
  return round;
}

OrientationTrajectory round_of(const OrientationDemonstration& cycle, Index count) {
  OrientationTrajectory round = three_of(cycle).at(middle_times(cycle.duration(), count));
  round.time.array() -= cycle.duration();
  return round;
}

}  // namespace dmp::detail
