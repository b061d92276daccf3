#include <dmp/error.hpp>
#include <dmp/path_fit.hpp>
#include <dmp/so3.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kinematics/fit_arguments.hpp"
#include "kinematics/fit_problem.hpp"
#include "kinematics/path_between.hpp"
#include "robot/kdl_forward.hpp"

namespace dmp {
namespace {

using detail::BorderedBand;
using detail::FitBounds;
using detail::FitMeasure;
using detail::FitProblem;
using detail::FitState;
using detail::Frame;
using Eigen::Index;

constexpr double first_damping = 1e-3, least_damping = 1e-9, most_damping = 1e8;
constexpr double settled = 1e-4;  // relative fall of the cost at which a level ends
constexpr int steps_of_level = 60;
constexpr int levels = 60, levels_without_gain = 5;
constexpr double gain = 1e-3;  // of the factor, below which a level has gained nothing
constexpr double next_level = 0.93, deepest_level = 0.7;
constexpr double coarse = 2e-3;      // m or rad; a tighter tolerance takes twice the coefficients
constexpr double per_second = 40.0;  // coefficients of each joint
constexpr double fewest = 60.0, most = 1000.0;
constexpr double narrower = 0.97;  // the dead zone, after a level that was not accepted between its samples
constexpr int between = 4;         // samples of the last measurement for each one of the fit

Index coefficients_of(double duration, const PathFitOptions& options) {
  if (options.spline_coefficients > 0) return options.spline_coefficients;
  const bool fine = std::min(options.position_tolerance, options.angle_tolerance / 8.7) <= coarse;
  return static_cast<Index>(std::clamp((fine ? 2.0 : 1.0) * per_second * duration, fewest, most));
}

// The report of joints that are themselves what the arm shall do.
PathReport report_of(const JointTrajectory& joints, const Eigen::VectorXd& velocity_limit, double margin) {
  const Index count = joints.time.size();
  PathReport report;
  report.position_error = report.angle_error = Eigen::VectorXd::Zero(count);
  report.status.assign(static_cast<std::size_t>(count), IkStatus::ok);
  report.solved = count;
  report.limit_margin = margin;
  report.starts_tried = 1;
  for (Index k = 1; k < count; ++k) {
    const Eigen::RowVectorXd step = (joints.position.row(k) - joints.position.row(k - 1)).cwiseAbs();
    const double ratio = step.cwiseQuotient(velocity_limit.transpose()).maxCoeff();
    report.max_step = std::max(report.max_step, step.maxCoeff());
    report.velocity_ratio = std::max(report.velocity_ratio, ratio / (joints.time[k] - joints.time[k - 1]));
  }
  return report;
}

struct Candidate {
  FitState state;
  double factor = std::numeric_limits<double>::infinity();
};

class Fit {
 public:
  Fit(const Arm& arm, const Eigen::VectorXd& times, const Poses& poses, const RowMatrix& start,
      const PathFitOptions& options)
      : arm_(arm),
        times_(times),
        poses_(poses),
        options_(options),
        path_(times, poses),
        goal_(options.weight, 1.0),
        bounds_(bounds_of(arm, options)),
        duration_(times[times.size() - 1] - times[0]),
        count_(coefficients_of(duration_, options)),
        problem_(arm.model(), arm.gravity(), goal_, bounds_, targets(), clock(), duration_,
                 options.free_placement),
        system_(count_ * arm.joint_count(), 4 * arm.joint_count() - 1, problem_.border()) {
    const JointTrajectory joints = JointTrajectory::through(times, start);
    RowMatrix sampled(FitProblem::samples_of(count_), arm.joint_count());
    for (Index k = 0; k < sampled.rows(); ++k)
      sampled.row(k) = path_.joints_at(joints, time_of(k)).transpose();
    state_.coefficients = detail::nearest_spline(sampled);
    state_.position = problem_.centre();
  }

  PathFit run(const JointTrajectory& start);

 private:
  static FitBounds bounds_of(const Arm& arm, const PathFitOptions& options) {
    FitBounds bounds;
    bounds.lower = arm.lower();
    bounds.upper = arm.upper();
    bounds.velocity = options.velocity.value_or(arm.velocity_limit());
    bounds.acceleration = options.acceleration.value_or(arm.acceleration_limit());
    if (options.effort) bounds.effort = detail::Joints(*options.effort);
    bounds.floor = options.floor;
    bounds.position_tolerance = options.position_tolerance;
    bounds.angle_tolerance = options.angle_tolerance;
    return bounds;
  }

  double time_of(Index k) const {
    return times_[0] +
           duration_ * static_cast<double>(k) / static_cast<double>(FitProblem::samples_of(count_) - 1);
  }

  std::vector<Frame> targets() const {
    std::vector<Frame> result;
    for (Index k = 0; k < FitProblem::samples_of(count_); ++k) result.push_back(path_.at(time_of(k)));
    return result;
  }

  detail::FitClock clock() const {
    const Index samples = FitProblem::samples_of(count_);
    detail::FitClock clock{Eigen::VectorXd::Ones(samples), Eigen::VectorXd::Zero(samples)};
    for (Index k = 0; k < samples; ++k) {
      if (options_.slowdown) clock.slowdown[k] = path_.value_at(*options_.slowdown, time_of(k));
      if (options_.slowdown_rate) clock.rate[k] = path_.value_at(*options_.slowdown_rate, time_of(k));
    }
    return clock;
  }

  double whole_factor(const FitMeasure& measure, double asked) const;
  bool level(double asked);
  void keep(const FitState& state, const FitMeasure& measure, double asked);
  bool accepted(Candidate& candidate, PathFit& found);
  PathFit measured(const FitState& state) const;

  const Arm& arm_;
  const Eigen::VectorXd& times_;
  const Poses& poses_;
  const PathFitOptions& options_;
  detail::PathBetween path_;
  detail::PoseGoal goal_;
  FitBounds bounds_;
  double duration_;
  Index count_;
  FitProblem problem_;
  BorderedBand system_;
  FitState state_;
  FitMeasure last_;
  double zone_ = 0.92;
  int spent_ = 0;
  Candidate best_of_level_;
};

// The factor that velocity, acceleration and, as far as it is known at the factor asked for, effort need.
double Fit::whole_factor(const FitMeasure& measure, double asked) const {
  if (!bounds_.effort) return measure.rate;
  if (measure.effort > 1.0)
    return std::max(measure.rate, asked * std::sqrt(1.0 + 1.6 * (measure.effort - 1.0)));
  return std::max(measure.rate, asked);
}

void Fit::keep(const FitState& state, const FitMeasure& measure, double asked) {
  const bool within = measure.position <= options_.position_tolerance &&
                      measure.angle <= options_.angle_tolerance && measure.outside <= 0.0 &&
                      (!options_.free_placement || measure.below <= 0.0);
  const double factor = whole_factor(measure, asked);
  if (within && factor < best_of_level_.factor) best_of_level_ = {state, factor};
}

// Levenberg and Marquardt at one factor; false if the budget is spent.
bool Fit::level(double asked) {
  double cost = problem_.evaluate(state_, asked, last_, &system_), damping = first_damping;
  Eigen::VectorXd step, placement;
  for (int i = 0; i < steps_of_level; ++i) {
    if (++spent_ > options_.iterations) return false;
    FitState next;
    FitMeasure measure;
    double lower = std::numeric_limits<double>::infinity();
    if (system_.solve(damping, step, placement)) {
      next = problem_.moved(state_, step, placement);
      lower = problem_.evaluate(next, asked, measure, nullptr);
    }
    if (!(lower < cost)) {
      damping *= 8.0;
      if (damping > most_damping) return true;
      continue;
    }
    const double fall = (cost - lower) / cost;
    state_ = std::move(next);
    last_ = measure;
    keep(state_, last_, asked);
    if (fall < settled) return true;
    cost = problem_.evaluate(state_, asked, last_, &system_);
    damping = std::max(0.2 * damping, least_damping);
  }
  return true;
}

PathFit Fit::measured(const FitState& state) const {
  const double spacing = duration_ / static_cast<double>(count_ - 3);
  RowMatrix joints(times_.size(), arm_.joint_count());
  for (Index k = 0; k < joints.rows(); ++k)
    joints.row(k) = detail::spline_at(state.coefficients, spacing, times_[k] - times_[0]);
  PathFit found;
  found.joints = JointTrajectory::through(times_, joints, arm_.joint_names());
  const Index samples = between * (FitProblem::samples_of(count_) - 1) + 1;
  detail::KdlForward forward(arm_.model());
  double position = 0.0, angle = 0.0;
  found.limit_margin = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < samples; ++k) {
    const double t = duration_ * static_cast<double>(k) / static_cast<double>(samples - 1);
    const Eigen::VectorXd q = path_.joints_at(found.joints, times_[0] + t);
    const Frame target = problem_.placed(path_.at(times_[0] + t), state);
    const detail::Vector6 error = goal_.weighted(target, goal_.error(target, forward(q)));
    const double away = error.head<3>().norm(), turned = error.tail<3>().norm();
    found.position_max = std::max(found.position_max, away);
    found.angle_max = std::max(found.angle_max, turned);
    position += away * away;
    angle += turned * turned;
    found.limit_margin =
        std::min({found.limit_margin, (q - arm_.lower()).minCoeff(), (arm_.upper() - q).minCoeff()});
  }
  found.position_rms = std::sqrt(position / static_cast<double>(samples));
  found.angle_rms = std::sqrt(angle / static_cast<double>(samples));
  found.joints.report = report_of(found.joints, arm_.velocity_limit(), found.limit_margin);
  const Frame origin{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  FitState turned = state;
  turned.tool.setIdentity();
  const Frame base = problem_.placed(origin, turned);
  found.base_change.topLeftCorner<3, 3>() = base.rotation;
  found.base_change.topRightCorner<3, 1>() = base.position;
  found.tool_change.topLeftCorner<3, 3>() = state.tool;
  return found;
}

// Whether the best of a level holds between its samples too, and to those who were asked.
bool Fit::accepted(Candidate& candidate, PathFit& found) {
  found = measured(candidate.state);
  const bool within = found.position_max <= options_.position_tolerance &&
                      found.angle_max <= options_.angle_tolerance && found.limit_margin >= 0.0;
  if (!within) {
    zone_ *= narrower;
    problem_.set_zone(zone_);
    return false;
  }
  return !options_.accept || options_.accept(found.joints);
}

PathFit Fit::run(const JointTrajectory& start) {
  PathFit best;
  best.joints = start;
  problem_.evaluate(state_, 1.0, last_, nullptr);
  double asked = last_.rate;
  if (bounds_.effort && asked > 0.0) {
    problem_.evaluate(state_, asked, last_, nullptr);
    asked = whole_factor(last_, asked);
  }
  best.start_factor = best.duration_factor = asked;
  const FitState begin = state_;
  for (int k = 0, without = 0; k < levels && without < levels_without_gain && asked > 0.0; ++k) {
    if (best.duration_factor <= options_.target) break;
    best_of_level_ = {};
    const bool goes_on = level(asked);
    PathFit found;
    const bool better = best_of_level_.factor < best.duration_factor * (1.0 - gain);
    if (better && accepted(best_of_level_, found)) {
      found.duration_factor = best_of_level_.factor;
      found.start_factor = best.start_factor;
      found.improved = true;
      best = found;
      without = 0;
    } else {
      ++without;
    }
    if (!goes_on) break;
    asked = next_level * std::min(asked, std::max(last_.rate, deepest_level * asked));
  }
  if (!best.improved) {
    PathFit own = measured(begin);
    own.joints = start;
    own.start_factor = own.duration_factor = best.start_factor;
    best = own;
  }
  best.iterations = std::min(spent_, options_.iterations);
  return best;
}

}  // namespace

PathFit fit_path(const Arm& arm, const Eigen::VectorXd& times, const Poses& poses, const RowMatrix& start,
                 const PathFitOptions& options) {
  detail::check_fit(arm, times, poses, start, options);
  return Fit(arm, times, poses, start, options)
      .run(JointTrajectory::through(times, start, arm.joint_names()));
}

}  // namespace dmp
