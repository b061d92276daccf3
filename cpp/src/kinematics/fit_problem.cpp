#include "kinematics/fit_problem.hpp"

#include <algorithm>
#include <cmath>
#include <dmp/so3.hpp>
#include <utility>

#include "kinematics/fit_penalties.hpp"

namespace dmp::detail {
namespace {

using Eigen::Index;

constexpr double velocity_aim = 0.985, acceleration_aim = 0.97;  // of the limits
constexpr double effort_aim = 0.95, effort_edge = 0.98;
constexpr double effort_watched = 0.6;  // share at a knot from which the samples behind it are looked at too
constexpr double effort_difference = 1e-6;

const std::array<SplineRow, 4> rows = {SplineRow(0.0), SplineRow(1.0 / 3.0), SplineRow(2.0 / 3.0),
                                       SplineRow(1.0)};

using Placement = Eigen::Matrix<double, 6, 7>;

}  // namespace

// Joints at one sample, and what its residuals add to the normal equations: of the pose a full block, of
// rates and limits a diagonal.
struct FitProblem::Sample {
  Index first = 0, k = 0;         // of the four coefficients; of the samples
  std::array<double, 4> b, v, a;  // what they add to position, velocity, and acceleration on the clock
  double slowdown = 1.0;
  Joints q, qd, qdd;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, joint_capacity, joint_capacity> pose;
  Joints pose_right, q_weight, q_right, qd_weight, qd_right, qdd_weight, qdd_right;
  Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor, joint_capacity, 7> edge;
  Eigen::Matrix<double, 7, 7> corner;
  Eigen::Matrix<double, 7, 1> right_end;
  Frame target;  // as placed

  void clear(Index n) {
    pose.setZero(n, n);
    edge.setZero(n, 7);
    corner.setZero();
    right_end.setZero();
    for (Joints* each : {&pose_right, &q_weight, &q_right, &qd_weight, &qd_right, &qdd_weight, &qdd_right})
      each->setZero(n);
  }
};

FitProblem::FitProblem(const ChainModel& model, const Eigen::Vector3d& gravity, const PoseGoal& goal,
                       const FitBounds& bounds, std::vector<Frame> targets, FitClock clock, double duration,
                       bool free_placement)
    : chain_(model),
      goal_(goal),
      bounds_(bounds),
      targets_(std::move(targets)),
      clock_(std::move(clock)),
      spacing_(3.0 * duration / static_cast<double>(targets_.size() - 1)),
      weight_(1.0 / static_cast<double>(targets_.size())),
      free_(free_placement) {
  Eigen::Vector3d low = targets_.front().position, high = low;
  for (const Frame& target : targets_) {
    low = low.cwiseMin(target.position);
    high = high.cwiseMax(target.position);
  }
  centre_ = 0.5 * (low + high);
  if (bounds_.effort) dynamics_.emplace(model, gravity);
}

Frame FitProblem::placed(const Frame& target, const FitState& state) const {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(state.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return {turn * target.rotation * state.tool, state.position + turn * (target.position - centre_)};
}

FitState FitProblem::moved(const FitState& state, const Eigen::VectorXd& step,
                           const Eigen::VectorXd& placement) const {
  FitState next = state;
  Eigen::Map<Eigen::VectorXd>(next.coefficients.data(), next.coefficients.size()) += step;
  if (!free_) return next;
  next.position += placement.head<3>();
  next.yaw += placement[3];
  next.tool = state.tool * so3::exp(Eigen::Vector3d(placement.tail<3>()));
  return next;
}

void FitProblem::read(const FitState& state, Index k, Sample& sample) const {
  const Index last = state.coefficients.rows() - 4;
  sample.k = k;
  sample.first = std::min(k / 3, last);
  const SplineRow& row = rows[static_cast<std::size_t>(k - 3 * sample.first)];
  sample.slowdown = clock_.slowdown[k];
  const double h = spacing_, rate = clock_.rate[k];
  sample.q.setZero(joint_count());
  sample.qd = sample.qdd = sample.q;
  for (std::size_t i = 0; i < 4; ++i) {
    sample.b[i] = row.value[i];
    sample.v[i] = row.slope[i] / h;
    sample.a[i] = row.curve[i] / (h * h) - rate * sample.v[i];
    const Joints c = state.coefficients.row(sample.first + static_cast<Index>(i)).transpose();
    sample.q += sample.b[i] * c;
    sample.qd += sample.v[i] * c;
    sample.qdd += sample.a[i] * c;
  }
}

double FitProblem::evaluate(const FitState& state, double factor, FitMeasure& measure, BorderedBand* system) {
  measure = {};
  if (system) system->set_zero();
  double cost = 0.0, nearest_effort = 0.0;
  Sample sample;
  for (Index k = 0; k < static_cast<Index>(targets_.size()); ++k) {
    read(state, k, sample);
    const double asked = factor * sample.slowdown;
    sample.clear(joint_count());
    cost += pose_terms(state, sample, measure, system != nullptr);
    cost += rate_terms(asked, sample, measure);
    cost += limit_terms(sample, measure);
    if (free_ && std::isfinite(bounds_.floor)) cost += floor_terms(sample, measure);
    if (dynamics_ && (k % 3 == 0 || nearest_effort > effort_watched))
      cost += effort_terms(asked, sample, measure, nearest_effort, system);
    if (system) scatter(sample, *system);
  }
  return weight_ * cost;
}

double FitProblem::pose_terms(const FitState& state, Sample& sample, FitMeasure& measure, bool linear) {
  sample.target = free_ ? placed(targets_[static_cast<std::size_t>(sample.k)], state)
                        : targets_[static_cast<std::size_t>(sample.k)];
  Jacobian jacobian;
  const Frame tip = linear ? chain_.forward(sample.q, jacobian) : chain_.forward(sample.q);
  const Vector6 error = goal_.weighted(sample.target, goal_.error(sample.target, tip));
  measure.position = std::max(measure.position, error.head<3>().norm());
  measure.angle = std::max(measure.angle, error.tail<3>().norm());
  const std::array<double, 2> width = {zone_ * bounds_.position_tolerance, zone_ * bounds_.angle_tolerance};
  if (linear) jacobian = goal_.weighted(sample.target, jacobian);
  Placement placement = Placement::Zero();
  if (linear && free_) {
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    placement.topLeftCorner<3, 3>().setIdentity();
    placement.block<3, 1>(0, 3) = z.cross(sample.target.position - state.position);
    placement.block<3, 1>(3, 3) = z;
    placement.bottomRightCorner<3, 3>() = sample.target.rotation;
    placement = goal_.weighted(sample.target, placement);
  }
  double cost = 0.0;
  for (Index part = 0; part < 2; ++part) {
    const double size = width[static_cast<std::size_t>(part)];
    Eigen::Vector3d residual;
    Eigen::Matrix3d slope;
    cost += dead_zone(error.segment<3>(3 * part) / size, residual, slope);
    if (!linear) continue;
    slope /= size;
    const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, joint_capacity> by_q =
        -slope * jacobian.middleRows<3>(3 * part);
    sample.pose.noalias() += by_q.transpose() * by_q;
    sample.pose_right.noalias() -= by_q.transpose() * residual;
    if (!free_) continue;
    const Eigen::Matrix<double, 3, 7> by_place = slope * placement.middleRows<3>(3 * part);
    sample.edge.noalias() += by_q.transpose() * by_place;
    sample.corner.noalias() += by_place.transpose() * by_place;
    sample.right_end.noalias() -= by_place.transpose() * residual;
  }
  return cost;
}

double FitProblem::rate_terms(double factor, Sample& sample, FitMeasure& measure) const {
  double cost = 0.0;
  const auto take = [&](const Penalty& penalty, double& weight, double& right) {
    weight += penalty.weight;
    right += penalty.right;
    cost += penalty.cost;
  };
  for (Index j = 0; j < joint_count(); ++j) {
    const double v = bounds_.velocity[j], a = bounds_.acceleration[j];
    const double speed = std::abs(sample.qd[j]) / (v * sample.slowdown);
    const double gain = std::abs(sample.qdd[j]) / (a * sample.slowdown * sample.slowdown);
    measure.rate = std::max({measure.rate, speed, std::sqrt(gain)});
    if (std::isfinite(v))
      take(rate_penalty(sample.qd[j], factor * v, velocity_aim), sample.qd_weight[j], sample.qd_right[j]);
    if (std::isfinite(a))
      take(rate_penalty(sample.qdd[j], factor * factor * a, acceleration_aim), sample.qdd_weight[j],
           sample.qdd_right[j]);
  }
  return cost;
}

double FitProblem::limit_terms(Sample& sample, FitMeasure& measure) const {
  double cost = 0.0;
  for (Index j = 0; j < joint_count(); ++j) {
    const double above = sample.q[j] - bounds_.upper[j], below = bounds_.lower[j] - sample.q[j];
    measure.outside = std::max({measure.outside, above, below});
    const Penalty penalty = limit_penalty(std::max(above, below));
    sample.q_weight[j] += penalty.weight;
    sample.q_right[j] += above > below ? penalty.right : -penalty.right;
    cost += penalty.cost;
  }
  return cost;
}

double FitProblem::floor_terms(Sample& sample, FitMeasure& measure) const {
  const double below = bounds_.floor - sample.target.position.z();
  measure.below = std::max(measure.below, below);
  const Penalty penalty = floor_penalty(below);
  sample.corner(2, 2) += penalty.weight;
  sample.right_end[2] -= penalty.right;
  return penalty.cost;
}

double FitProblem::effort_terms(double factor, Sample& sample, FitMeasure& measure, double& largest,
                                BorderedBand* system) {
  largest = 0.0;
  const Eigen::VectorXd velocity = sample.qd / factor, acceleration = sample.qdd / (factor * factor);
  const Eigen::VectorXd effort = dynamics_->total(sample.q, velocity, acceleration);
  double cost = 0.0;
  for (Index j = 0; j < joint_count(); ++j) {
    const double share = std::abs(effort[j]) / (effort_aim * (*bounds_.effort)[j]);
    largest = std::max(largest, effort_aim * share);
    const double over = share - effort_edge;
    if (over > 0.0) cost += 0.25 * steep * steep * over * over;
  }
  measure.effort = std::max(measure.effort, largest);
  if (system && cost > 0.0) add_effort_rows(factor, sample, effort, *system);
  return cost;
}

// The derivatives by position, velocity and acceleration, by differences; then of each coefficient.
void FitProblem::add_effort_rows(double factor, const Sample& sample, const Eigen::VectorXd& effort,
                                 BorderedBand& system) {
  const Index n = joint_count();
  const Eigen::VectorXd q = sample.q, velocity = sample.qd / factor,
                        acceleration = sample.qdd / (factor * factor);
  Eigen::MatrixXd by_q(n, n), by_v(n, n), by_a(n, n);
  for (Index j = 0; j < n; ++j) {
    const Eigen::VectorXd step = effort_difference * Eigen::VectorXd::Unit(n, j);
    by_q.col(j) = (dynamics_->total(q + step, velocity, acceleration) - effort) / effort_difference;
    by_v.col(j) = (dynamics_->total(q, velocity + step, acceleration) - effort) / effort_difference;
    by_a.col(j) = (dynamics_->total(q, velocity, acceleration + step) - effort) / effort_difference;
  }
  Eigen::VectorXd row(4 * n);
  for (Index j = 0; j < n; ++j) {
    const double most = effort_aim * (*bounds_.effort)[j], over = std::abs(effort[j]) / most - effort_edge;
    if (!(over > 0.0)) continue;
    const double slope = std::copysign(0.5 * steep / most, effort[j]);
    for (Index i = 0; i < 4; ++i) {
      const auto at = static_cast<std::size_t>(i);
      row.segment(i * n, n) = slope * (sample.b[at] * by_q.row(j) + sample.v[at] / factor * by_v.row(j) +
                                       sample.a[at] / (factor * factor) * by_a.row(j))
                                          .transpose();
    }
    const Index begin = sample.first * n;
    system.right.segment(begin, 4 * n) -= weight_ * 0.5 * steep * over * row;
    for (Index c = 0; c < 4 * n; ++c)
      system.band.row(begin + c).head(4 * n - c) += weight_ * row[c] * row.tail(4 * n - c).transpose();
  }
}

void FitProblem::scatter(const Sample& sample, BorderedBand& system) const {
  const Index n = joint_count(), begin = sample.first * n;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t l = i; l < 4; ++l) {
      const double both = weight_ * sample.b[i] * sample.b[l];
      for (Index j = 0; j < n; ++j) {
        const Index column = begin + static_cast<Index>(i) * n + j;
        double* const to = system.band.data() + column * system.band.cols();
        const Index from = static_cast<Index>(l - i) * n - j;
        for (Index m = i == l ? j : 0; m < n; ++m) to[from + m] += both * sample.pose(j, m);
        to[from + j] +=
            both * sample.q_weight[j] + weight_ * (sample.v[i] * sample.v[l] * sample.qd_weight[j] +
                                                   sample.a[i] * sample.a[l] * sample.qdd_weight[j]);
      }
    }
  for (std::size_t i = 0; i < 4; ++i) {
    const Index at = begin + static_cast<Index>(i) * n;
    system.right.segment(at, n) += weight_ * (sample.b[i] * (sample.pose_right + sample.q_right) +
                                              sample.v[i] * sample.qd_right + sample.a[i] * sample.qdd_right);
    if (free_) system.edge.middleRows(at, n) += weight_ * sample.b[i] * sample.edge;
  }
  if (!free_) return;
  system.corner += weight_ * sample.corner;
  system.right_end += weight_ * sample.right_end;
}

}  // namespace dmp::detail
