#include "kinematics/fit_arguments.hpp"

#include <cmath>
#include <dmp/error.hpp>
#include <string>

#include "base/text.hpp"
#include "robot/checks.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;

void check_count(Index count, Index expected, const std::string& name, const char* each) {
  if (count != expected)
    throw InvalidArgument(name + ": " + std::to_string(count) + ", expected " + std::to_string(expected) +
                          ", one for each " + each + ".");
}

void check_values(const std::optional<Eigen::VectorXd>& values, Index count, const std::string& name,
                  const char* each) {
  if (!values) return;
  check_count(values->size(), count, name, each);
  for (Index i = 0; i < count; ++i) check_positive((*values)[i], name + "[" + std::to_string(i) + "]");
}

void check_path(const Eigen::VectorXd& times, const Poses& poses, const RowMatrix& start, Index joints) {
  if (times.size() < 4)
    throw InvalidArgument("times: " + std::to_string(times.size()) + ", expected at least 4.");
  check_times(times);
  check_count(static_cast<Index>(poses.size()), times.size(), "poses", "time");
  for (std::size_t k = 0; k < poses.size(); ++k)
    if (!poses[k].allFinite()) throw InvalidArgument("poses[" + std::to_string(k) + "]: not finite.");
  check_count(start.rows(), times.size(), "start", "time");
  check_count(start.cols(), joints, "start: columns", "joint");
  for (Index k = 0; k < start.rows(); ++k)
    if (!start.row(k).allFinite()) throw InvalidArgument("start[" + std::to_string(k) + "]: not finite.");
}

}  // namespace

void check_fit(const Arm& arm, const Eigen::VectorXd& times, const Poses& poses, const RowMatrix& start,
               const PathFitOptions& options) {
  check_capacity(arm);
  check_path(times, poses, start, arm.joint_count());
  check_positive(options.position_tolerance, "position_tolerance");
  check_positive(options.angle_tolerance, "angle_tolerance");
  check_positive(options.target, "target");
  check_positive(options.iterations, "iterations");
  check_weight(options.weight);
  if (options.spline_coefficients != 0 && options.spline_coefficients < 4)
    throw InvalidArgument(
        "spline_coefficients: " + std::to_string(options.spline_coefficients) +
        ", expected at least 4, or 0 for as many as the duration and the tolerance ask for.");
  check_values(options.velocity, arm.joint_count(), "velocity", "joint");
  check_values(options.acceleration, arm.joint_count(), "acceleration", "joint");
  check_values(options.effort, arm.joint_count(), "effort", "joint");
  check_values(options.slowdown, times.size(), "slowdown", "time");
  if (!options.slowdown_rate) return;
  check_count(options.slowdown_rate->size(), times.size(), "slowdown_rate", "time");
  if (!options.slowdown_rate->allFinite()) throw InvalidArgument("slowdown_rate: not finite.");
}

}  // namespace dmp::detail
