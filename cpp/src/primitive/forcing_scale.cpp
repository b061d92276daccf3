#include "primitive/forcing_scale.hpp"

#include <algorithm>
#include <cmath>

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRounding = 1e-14;  // of a displacement: a logarithm anew
constexpr double kNoWay = 1e-3;      // of the range: no direction to scale by
constexpr double kShortWay = 0.25;   // likewise: a ratio that a small change of the goal changes much
constexpr double kLargestRatio = 4.0;

/// A unit vector orthogonal to the unit vector a (Gram-Schmidt on the axis that a has least of).
VectorXd orthogonal_to(const VectorXd& a) {
  if (a.size() < 2) return VectorXd::Zero(a.size());
  Index axis = 0;
  a.cwiseAbs().minCoeff(&axis);
  VectorXd aside = -a[axis] * a;
  aside[axis] += 1.0;
  return aside.normalized();
}

}  // namespace

ForcingScale::ForcingScale(const DmpOptions& options, const VectorXd& demonstrated, const VectorXd& amplitude)
    : scaling_(options.scaling),
      guarded_(multiplies(options.scaling) && options.scaling_guard),
      demonstrated_(demonstrated),
      amplitude_(amplitude),
      factor_(VectorXd::Ones(demonstrated.size())),
      offset_(VectorXd::Zero(demonstrated.size())),
      from_(offset_),
      to_(offset_),
      aside_(offset_) {
  if (demonstrated_.norm() > (guarded_ ? kShortWay : kNoWay) * amplitude_.norm()) {
    from_ = demonstrated_.normalized();
    aside_ = orthogonal_to(from_);
  }
}

void ForcingScale::set(const Eigen::Ref<const VectorXd>& displacement) noexcept {
  switch (scaling_) {
    case Scaling::none:
    case Scaling::automatic:
      return;
    case Scaling::advance:
      offset_ = displacement - demonstrated_;
      break;
    case Scaling::per_axis:
    case Scaling::per_axis_relative:
      set_axes(displacement);
      break;
    case Scaling::rotation_dilation:
      set_rotation(displacement);
      break;
  }
  advances_ = offset_.norm() > kRounding * (1.0 + demonstrated_.norm());
}

/// Whether an axis goes far enough for its way to be a measure.
bool ForcingScale::is_scaled(Index axis) const noexcept {
  if (scaling_ == Scaling::rotation_dilation) return from_.squaredNorm() > 0.0;
  if (guarded_) return std::abs(demonstrated_[axis]) > kShortWay * amplitude_[axis];
  return scaling_ == Scaling::per_axis || std::abs(demonstrated_[axis]) > kNoWay * amplitude_[axis];
}

double ForcingScale::within_reach(double way, double demonstrated) const noexcept {
  const double farthest = kLargestRatio * std::abs(demonstrated);
  return guarded_ ? std::clamp(way, -farthest, farthest) : way;
}

void ForcingScale::set_axes(const Eigen::Ref<const VectorXd>& displacement) noexcept {
  for (Index d = 0; d < factor_.size(); ++d) {
    const bool scaled = is_scaled(d);
    const double way = scaled ? within_reach(displacement[d], demonstrated_[d]) : demonstrated_[d];
    if (guarded_) offset_[d] = displacement[d] - way;
    const double unit = scaling_ == Scaling::per_axis ? 1.0 : demonstrated_[d];
    factor_[d] = scaled ? way / unit : 1.0;
  }
}

void ForcingScale::set_rotation(const Eigen::Ref<const VectorXd>& displacement) noexcept {
  const double length = displacement.norm();
  const bool scaled = is_scaled(0);
  rotates_ = length > 0.0 && scaled;
  dilation_ = scaled ? within_reach(length, demonstrated_.norm()) / demonstrated_.norm() : 1.0;
  offset_.setZero();
  if (guarded_ && !scaled) offset_ = displacement - demonstrated_;
  if (!rotates_) return;
  to_ = displacement / length;
  opposite_ = from_.dot(to_) < -1.0 + 1e-12;
  if (guarded_) offset_ = (length - dilation_ * demonstrated_.norm()) * to_;
}

ForcingScale::Guard ForcingScale::guard(Index axis, const VectorXd& displacement) const noexcept {
  if (!guarded_) return Guard::none;
  const bool together = scaling_ == Scaling::rotation_dilation;
  const double range = together ? amplitude_.norm() : amplitude_[axis];
  if (!is_scaled(axis)) return range > 0.0 ? Guard::short_way : Guard::none;
  const double way = together ? displacement.norm() : displacement[axis];
  const double demonstrated = together ? demonstrated_.norm() : demonstrated_[axis];
  return within_reach(way, demonstrated) == way ? Guard::none : Guard::far_goal;
}

void ForcingScale::apply(double* f, const double* advance) const noexcept {
  if (is_one()) return;
  Eigen::Map<VectorXd> force(f, factor_.size());
  if (scaling_ != Scaling::advance) multiply(force);
  if (advances_ && advance != nullptr) force += *advance * offset_;
}

void ForcingScale::multiply(Eigen::Map<VectorXd> force) const noexcept {
  if (scaling_ != Scaling::rotation_dilation) {
    force.array() *= factor_.array();
    return;
  }
  if (rotates_) {  // v - ((a + b).v) (a + b) / (1 + a.b) + 2 (a.v) b: the rotation in the plane of a and b
    const double along = from_.dot(force);
    if (opposite_) {
      force -= 2.0 * along * from_ + 2.0 * aside_.dot(force) * aside_;
    } else {
      const double both = (along + to_.dot(force)) / (1.0 + from_.dot(to_));
      force += (2.0 * along - both) * to_ - both * from_;
    }
  }
  force *= dilation_;
}

}  // namespace dmp::detail
