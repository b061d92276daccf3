#include "detail/spring_damper.hpp"

#include <cmath>

namespace dmp::detail {

void SpringDamper::prepare(double sigma) noexcept {
  if (sigma == sigma_) return;
  sigma_ = sigma;
  prepare_free_motion(sigma);
  prepare_response(sigma);
}

void SpringDamper::prepare_free_motion(double sigma) noexcept {
  const double mu = 0.5 * alpha_;
  const double discriminant = mu * mu - stiffness_;
  const double t = discriminant * sigma * sigma;
  double c = 0.0;  // cosh(sqrt(discriminant) sigma)
  double s = 0.0;  // sinh(..) / sqrt(discriminant)
  if (std::abs(t) < 1e-6) {
    c = 1.0 + 0.5 * t * (1.0 + t / 12.0);
    s = sigma * (1.0 + t / 6.0 * (1.0 + t / 20.0));
  } else if (t > 0.0) {
    const double root = std::sqrt(discriminant);
    c = std::cosh(root * sigma);
    s = std::sinh(root * sigma) / root;
  } else {
    const double root = std::sqrt(-discriminant);
    c = std::cos(root * sigma);
    s = std::sin(root * sigma) / root;
  }
  e_ << c + mu * s, s, -stiffness_ * s, c - mu * s;
  e_ *= std::exp(-mu * sigma);
}

/// p_j = int_0^sigma exp(A (sigma - u)) (u / sigma)^j du [0; 1], then the parabola through the three values.
void SpringDamper::prepare_response(double sigma) noexcept {
  Eigen::Matrix2d a;
  a << 0.0, 1.0, -stiffness_, -alpha_;
  const Eigen::Vector2d input(0.0, 1.0);
  Eigen::Vector2d p[3];
  if (0.5 * alpha_ * sigma < 0.5 && stiffness_ * sigma * sigma < 1.0) {
    for (int j = 0; j < 3; ++j) {  // sigma sum_k (A sigma)^k j! / (k + j + 1)! [0; 1]
      Eigen::Vector2d term = input * (sigma / (j + 1));
      p[j] = term;
      for (int k = 1; k < 24; ++k) {
        term = a * term * (sigma / (k + j + 1));
        p[j] += term;
      }
    }
  } else {  // A p_0 = (exp(A sigma) - 1) [0; 1],  A p_j = j p_{j-1} / sigma - [0; 1]
    Eigen::Matrix2d inverse;
    inverse << -alpha_, -1.0, stiffness_, 0.0;
    inverse /= stiffness_;
    p[0] = inverse * (e_ * input - input);
    for (int j = 1; j < 3; ++j) p[j] = inverse * (p[j - 1] * (j / sigma) - input);
  }
  b_.col(0) = p[0] - 3.0 * p[1] + 2.0 * p[2];
  b_.col(1) = 4.0 * (p[1] - p[2]);
  b_.col(2) = 2.0 * p[2] - p[1];
}

}  // namespace dmp::detail
