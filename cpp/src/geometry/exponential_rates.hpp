#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace dmp::detail {

/// omega and its rate for R = Exp(p) Rg, from p' and p'': omega = J_l(p) p', J_l = 1 + a [p]x + b [p]x^2 with
/// a = (1 - cos theta) / theta^2, b = (theta - sin theta) / theta^3. `turn` is Exp(p): it holds sine and
/// cosine.
class ExponentialRates {
 public:
  ExponentialRates(const Eigen::Vector3d& p, const Eigen::Quaterniond& turn) noexcept : p_(p) {
    const double t = p.squaredNorm();
    if (t < 0.0025) {
      a_ = 0.5 + t * (-1.0 / 24 + t * (1.0 / 720 - t / 40320));
      b_ = 1.0 / 6 + t * (-1.0 / 120 + t * (1.0 / 5040 - t / 362880));
      a_rate_ = -1.0 / 12 + t * (1.0 / 180 - t / 6720);
      b_rate_ = -1.0 / 60 + t * (1.0 / 1260 - t / 60480);
      return;
    }
    const double theta = std::sqrt(t);
    const double s = turn.vec().dot(p) / theta;  // sin(theta / 2)
    a_ = 2.0 * s * s / t;
    b_ = (theta - 2.0 * s * turn.w()) / (t * theta);
    a_rate_ = (1.0 - t * b_ - 2.0 * a_) / t;
    b_rate_ = (a_ - 3.0 * b_) / t;
  }

  Eigen::Vector3d velocity(const Eigen::Vector3d& v) const noexcept {
    const Eigen::Vector3d pv = p_.cross(v);
    return v + a_ * pv + b_ * p_.cross(pv);
  }
  Eigen::Vector3d acceleration(const Eigen::Vector3d& v, const Eigen::Vector3d& v_rate) const noexcept {
    const Eigen::Vector3d pv = p_.cross(v);
    const double along = p_.dot(v);
    return velocity(v_rate) + along * (a_rate_ * pv + b_rate_ * p_.cross(pv)) + b_ * v.cross(pv);
  }

 private:
  Eigen::Vector3d p_;
  double a_;
  double b_;
  double a_rate_;  // da/dt = a_rate_ (p . p')
  double b_rate_;
};

}  // namespace dmp::detail
