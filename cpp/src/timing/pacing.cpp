#include <dmp/error.hpp>
#include <dmp/pacing.hpp>
#include <dmp/time_scaling.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include "timing/demands.hpp"
#include "timing/spline_extremes.hpp"
#include "timing/tempo_curve.hpp"

namespace dmp {
namespace {

constexpr int most_rounds = 60;
constexpr double gain = 0.7;   // of what a sample asks for, so that neighbours share it
constexpr double more = 1e-3;  // beyond that: rounds come to an end

Pace pace_of(const detail::TempoCurve& curve, const Eigen::VectorXd& original) {
  Pace pace{original, Eigen::VectorXd(original.size()), Eigen::VectorXd(original.size())};
  for (Eigen::Index k = 0; k < original.size(); ++k) {
    if (k > 0) pace.time[k] = pace.time[k - 1] + curve.time_between(original[k - 1], original[k]);
    pace.slowdown[k] = std::exp(curve.value(original[k]));
    pace.rate[k] = curve.slope(original[k]);
  }
  return pace;
}

Pace uniform_pace(const Eigen::VectorXd& original, double factor) {
  const Eigen::Index count = original.size();
  return {original[0] + factor * (original.array() - original[0]), Eigen::VectorXd::Constant(count, factor),
          Eigen::VectorXd::Zero(count)};
}

JointTrajectory on_clock(const JointTrajectory& joints, const Pace& pace, const PacingLimits& limits) {
  JointTrajectory result = JointTrajectory::through(pace.time, joints.position, joints.joint_names);
  result.report = joints.report;
  result.report.velocity_ratio = detail::largest_step_ratio(result, limits.velocity);
  return result;
}

Paced stretched_pace(const Paced& paced, double factor) {
  Paced result{stretched(paced.joints, factor), paced.pace};
  result.pace.time = result.joints.time;
  result.pace.slowdown *= factor;
  return result;
}

void raise(detail::TempoCurve& curve, const Eigen::VectorXd& original, const Eigen::VectorXd& square) {
  std::vector<double> least(static_cast<std::size_t>(original.size()), 0.0);
  for (Eigen::Index k = 0; k < original.size(); ++k)
    if (square[k] > 1.0)
      least[static_cast<std::size_t>(k)] = curve.value(original[k]) + gain * 0.5 * std::log(square[k]) + more;
  for (Eigen::Index k = 0; k < original.size(); ++k) {
    const double here = least[static_cast<std::size_t>(k)];
    if (here == 0.0) continue;
    curve.raise(original[k], here);
    if (k + 1 < original.size()) curve.raise(original[k + 1], here);  // what is asked for on the way there
  }
  curve.settle();
}

Paced locally(const detail::Demands& demands, const JointTrajectory& joints, const PacingLimits& limits) {
  detail::TempoCurve curve(joints.time[0], joints.time[joints.time.size() - 1], limits.tempo_rate);
  for (int round = 0;; ++round) {
    const Pace pace = pace_of(curve, joints.time);
    Paced paced{on_clock(joints, pace, limits), pace};
    const Eigen::VectorXd square = demands.squared(paced.joints, pace);
    if (round == most_rounds || square.maxCoeff() <= 1.0) return paced;
    raise(curve, joints.time, square);
  }
}

Paced paced(const Arm* arm, const JointTrajectory& joints, const PacingLimits& limits) {
  const detail::Demands demands(arm, joints, limits);
  if (joints.time.size() == 0) return {joints, {}};
  const double uniform = std::sqrt(demands.squared(joints).maxCoeff());
  const Paced as_it_is{joints, uniform_pace(joints.time, 1.0)};
  if (uniform <= 1.0 || joints.time.size() < 2) return as_it_is;
  const Paced local = locally(demands, joints, limits);
  const double left = std::max(1.0, std::sqrt(demands.squared(local.joints).maxCoeff()));
  const auto duration = [](const Paced& p) { return p.pace.time[p.pace.time.size() - 1] - p.pace.time[0]; };
  if (left * duration(local) < uniform * duration(as_it_is)) return stretched_pace(local, left);
  return stretched_pace(as_it_is, uniform);
}

}  // namespace

Paced paced(const JointTrajectory& joints, const PacingLimits& limits) {
  return paced(nullptr, joints, limits);
}

Paced paced(const Arm& arm, const JointTrajectory& joints, const PacingLimits& limits) {
  return paced(&arm, joints, limits);
}

Demand largest_demand(const JointTrajectory& joints, const PacingLimits& limits) {
  return detail::Demands(nullptr, joints, limits).largest(joints);
}

Demand largest_demand(const Arm& arm, const JointTrajectory& joints, const PacingLimits& limits) {
  return detail::Demands(&arm, joints, limits).largest(joints);
}

PoseTrajectory retimed(const PoseTrajectory& motion, const Pace& pace) {
  const Eigen::Index count = motion.time.size();
  if (pace.time.size() != count || pace.slowdown.size() != count || pace.rate.size() != count)
    throw InvalidArgument("pace: " + std::to_string(pace.time.size()) + " times, " +
                          std::to_string(pace.slowdown.size()) + " slowdowns and " +
                          std::to_string(pace.rate.size()) + " rates, expected " + std::to_string(count) +
                          ", one for each pose.");
  PoseTrajectory result{pace.time, motion.pose, motion.twist, motion.acceleration};
  for (Eigen::Index k = 0; k < count; ++k) {
    const double slowdown = pace.slowdown[k];
    result.acceleration.row(k) -= pace.rate[k] * motion.twist.row(k);
    result.acceleration.row(k) /= slowdown * slowdown;
    result.twist.row(k) /= slowdown;
  }
  return result;
}

}  // namespace dmp
