#include <dmp/error.hpp>
#include <dmp/inverse_kinematics.hpp>
#include <dmp/path_tracking.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/pose.hpp"
#include "kinematics/ik_solver.hpp"
#include "kinematics/route_search.hpp"
#include "robot/checks.hpp"

namespace dmp {
namespace {

std::string at(const char* name, Eigen::Index k) {
  return std::string(name) + "[" + std::to_string(k) + "]: ";
}

void check_path(const Eigen::VectorXd& times, const Poses& poses) {
  if (poses.empty()) throw InvalidArgument("poses: empty, expected at least one.");
  if (times.size() != static_cast<Eigen::Index>(poses.size()))
    throw InvalidArgument("times: " + std::to_string(times.size()) + " values, expected " +
                          std::to_string(poses.size()) + ", one for each pose.");
  detail::check_times(times);
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    const Eigen::Matrix4d& pose = poses[static_cast<std::size_t>(k)];
    if (!pose.allFinite()) throw InvalidArgument(at("poses", k) + "not finite.");
    if (!detail::is_pose(pose))
      throw InvalidArgument(at("poses", k) +
                            "det(R) = " + std::to_string(pose.topLeftCorner<3, 3>().determinant()) +
                            ", expected [R p; 0 1] with R orthonormal to 1e-3 and det(R) = +1.");
  }
}

void check_options(const FollowOptions& options, const Arm& arm) {
  detail::check_positive(options.max_step, "options.max_step");
  detail::check_positive(options.anchors, "options.anchors");
  detail::check_positive(options.starts, "options.starts");
  detail::check_positive(options.position_tolerance, "options.position_tolerance");
  detail::check_positive(options.angle_tolerance, "options.angle_tolerance");
  if (options.start) detail::brought_within_limits(*options.start, arm, "options.start");
}

detail::TargetPath target_path(const Eigen::VectorXd& times, const Poses& poses, const FollowOptions& options,
                               const Eigen::VectorXd& velocity_limit) {
  detail::TargetPath path;
  path.time.assign(times.data(), times.data() + times.size());
  for (const Eigen::Matrix4d& pose : poses) path.target.push_back(detail::rigid_frame(pose));
  detail::Joints step = detail::Joints::Constant(velocity_limit.size(), options.max_step);
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    const double dt = k + 1 < times.size() ? times[k + 1] - times[k] : 0.0;
    path.step.push_back(
        options.respect_velocity && dt > 0.0 ? detail::Joints(step.cwiseMin(velocity_limit * dt)) : step);
  }
  return path;
}

// Why sample k of the route misses its pose, from what holds its joints back.
IkStatus reason(const detail::TargetPath& path, const detail::Route& route, std::size_t k,
                const detail::BoundedLm& lm, const detail::JointRange& range) {
  const detail::Joints& q = route.joints[k];
  detail::Jacobian jacobian;
  const detail::Vector6 error = lm.goal().error(path.target[k], lm.chain().forward(q, jacobian));
  const detail::Joints wish = lm.goal().wish(path.target[k], jacobian, error);
  bool limited = false, stepped = false;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    if (std::abs(wish[i]) < 1e-12) continue;
    const double side = wish[i] > 0.0 ? range.upper[i] : range.lower[i];
    limited = limited || std::abs(side - q[i]) < 1e-9;
    for (const std::size_t other : {k - 1, k + 1})
      if (other < path.target.size())
        stepped =
            stepped || std::abs(q[i] - route.joints[other][i]) > path.step[std::min(k, other)][i] - 1e-9;
  }
  if (stepped) return IkStatus::step_limited;
  return limited ? IkStatus::limit_blocked : IkStatus::out_of_reach;
}

void list_missed(PathReport& report) {
  const auto count = static_cast<Eigen::Index>(report.status.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    if (report.status[static_cast<std::size_t>(k)] == IkStatus::ok) {
      ++report.solved;
    } else if (!report.missed.empty() && report.missed.back().second == k - 1) {
      report.missed.back().second = k;
    } else {
      report.missed.emplace_back(k, k);
    }
  }
}

double largest_step(const detail::Route& route) {
  double largest = 0.0;
  for (std::size_t k = 1; k < route.joints.size(); ++k)
    largest = std::max(largest, (route.joints[k] - route.joints[k - 1]).cwiseAbs().maxCoeff());
  return largest;
}

// A whole turn of a joint meets the same poses: the route may be any number of them away from the middle.
void wind_to_middle(const detail::JointRange& range, detail::Route& route) {
  range.wind_to_middle(route.joints);
  route.margin = std::numeric_limits<double>::infinity();
  for (const detail::Joints& q : route.joints) route.margin = std::min(route.margin, range.margin(q));
}

}  // namespace

PathReport InverseKinematics::Solver::report(const detail::TargetPath& path, const detail::Route& route,
                                             const FollowOptions& limits) {
  PathReport report;
  const std::size_t count = path.target.size();
  report.position_error.resize(static_cast<Eigen::Index>(count));
  report.angle_error.resize(static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    detail::Found found;
    found.joints = route.joints[k];
    search.measure(path.target[k], found);
    report.position_error[static_cast<Eigen::Index>(k)] = found.position_error;
    report.angle_error[static_cast<Eigen::Index>(k)] = found.angle_error;
    const bool met =
        found.position_error <= limits.position_tolerance && found.angle_error <= limits.angle_tolerance;
    report.status.push_back(met ? IkStatus::ok : reason(path, route, k, search.lm(), search.range()));
  }
  list_missed(report);
  report.max_step = largest_step(route);
  report.velocity_ratio = route.velocity_ratio;
  report.limit_margin = route.margin;
  return report;
}

JointTrajectory InverseKinematics::follow(const Eigen::VectorXd& times, const Poses& poses,
                                          const FollowOptions& given) {
  check_path(times, poses);
  check_options(given, arm());
  FollowOptions options = given;
  if (options.start) options.start = detail::brought_within_limits(*given.start, arm(), "options.start");
  const detail::TargetPath path = target_path(times, poses, options, arm().velocity_limit());
  const detail::Tolerances tolerances = {options.position_tolerance, options.angle_tolerance,
                                         solver_->search.lm().goal()};
  detail::RouteSearch routes(arm().model(), tolerances, options, solver_->options.random_seed);
  detail::Route route = routes.best(path);
  if (!options.start) wind_to_middle(solver_->search.range(), route);
  RowMatrix positions(times.size(), arm().joint_count());
  for (Eigen::Index k = 0; k < times.size(); ++k)
    positions.row(k) = route.joints[static_cast<std::size_t>(k)].transpose();
  JointTrajectory joints = JointTrajectory::through(times, positions, arm().joint_names());
  joints.report = solver_->report(path, route, options);
  joints.report.starts_tried = routes.routes_tried();
  return joints;
}

}  // namespace dmp
