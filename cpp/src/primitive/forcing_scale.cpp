#include "primitive/forcing_scale.hpp"

#include <cmath>

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRounding = 1e-14;  // of a displacement: a logarithm anew

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

ForcingScale::ForcingScale(Scaling scaling, const VectorXd& demonstrated, const VectorXd& amplitude)
    : scaling_(scaling),
      demonstrated_(demonstrated),
      amplitude_(amplitude),
      factor_(VectorXd::Ones(demonstrated.size())),
      from_(VectorXd::Zero(demonstrated.size())),
      to_(from_),
      aside_(from_) {
  // A displacement that is nothing beside the path has no direction to scale by.
  if (demonstrated_.norm() > 1e-3 * amplitude_.norm()) {
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
      factor_ = displacement - demonstrated_;
      is_offset_ = factor_.norm() > kRounding * (1.0 + demonstrated_.norm());
      return;
    case Scaling::per_axis:
      factor_ = displacement;
      return;
    case Scaling::per_axis_relative:
      for (Index d = 0; d < factor_.size(); ++d) {
        const bool moved = std::abs(demonstrated_[d]) > 1e-3 * amplitude_[d];
        factor_[d] = moved ? displacement[d] / demonstrated_[d] : 1.0;
      }
      return;
    case Scaling::rotation_dilation:
      set_rotation(displacement);
      return;
  }
}

void ForcingScale::set_rotation(const Eigen::Ref<const VectorXd>& displacement) noexcept {
  const double length = displacement.norm();
  rotates_ = length > 0.0 && from_.squaredNorm() > 0.0;
  dilation_ = from_.squaredNorm() > 0.0 ? length / demonstrated_.norm() : 1.0;
  if (!rotates_) return;
  to_ = displacement / length;
  opposite_ = from_.dot(to_) < -1.0 + 1e-12;
}

void ForcingScale::apply(double* f, const double* advance) const noexcept {
  Eigen::Map<VectorXd> force(f, factor_.size());
  if (is_one()) return;
  if (scaling_ == Scaling::advance) {
    force += *advance * factor_;
    return;
  }
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
