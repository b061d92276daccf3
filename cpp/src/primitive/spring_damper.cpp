#include "primitive/spring_damper.hpp"

#include <cmath>

namespace dmp::detail {

void SpringDamper::prepare(double sigma) noexcept {
  if (sigma == sigma_) return;
  sigma_ = sigma;
  Response p;
  if (0.5 * alpha_ * sigma < 0.5 && stiffness_ * sigma * sigma < 1.0) {
    p = short_response(sigma);
  } else {
    prepare_free_motion(sigma);
    p = long_response(sigma);
  }
  // The parabola through the forcing at the start, the middle and the end.
  b_.col(0) = p[0] - 3.0 * p[1] + 2.0 * p[2];
  b_.col(1) = 4.0 * (p[1] - p[2]);
  b_.col(2) = 2.0 * p[2] - p[1];
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

// p_j = int_0^sigma exp(A (sigma - u)) (u / sigma)^j du [0; 1]

/// The step of a control loop, cheap even if its length changes every time: p_2 by its series, sigma sum_k
/// (A sigma)^k 2! / (k + 3)! [0; 1], then p_{j-1} = sigma / j (A p_j + [0; 1]) and exp(A sigma) [0; 1] = A
/// p_0
/// + [0; 1].
SpringDamper::Response SpringDamper::short_response(double sigma) noexcept {
  const auto times_a = [this](const Eigen::Vector2d& v) {
    return Eigen::Vector2d(v[1], -stiffness_ * v[0] - alpha_ * v[1]);
  };
  Response p;
  Eigen::Vector2d term(0.0, sigma / 3.0);
  p[2] = term;
  for (int k = 1; k < 24; ++k) {
    term = times_a(term) * (sigma / (k + 3));
    p[2] += term;
    if (std::abs(term[0]) <= 1e-18 * std::abs(p[2][0]) && std::abs(term[1]) <= 1e-18 * std::abs(p[2][1]))
      break;
  }
  const Eigen::Vector2d input(0.0, 1.0);
  for (int j = 2; j > 0; --j) p[j - 1] = (times_a(p[j]) + input) * (sigma / j);
  const Eigen::Vector2d second = times_a(p[0]) + input;  // column of exp(A sigma) = c + s A
  e_ << second[1] + alpha_ * second[0], second[0], -stiffness_ * second[0], second[1];
  return p;
}

/// A p_0 = (exp(A sigma) - 1) [0; 1],  A p_j = j p_{j-1} / sigma - [0; 1]
SpringDamper::Response SpringDamper::long_response(double sigma) const noexcept {
  const Eigen::Vector2d input(0.0, 1.0);
  Eigen::Matrix2d inverse;
  inverse << -alpha_, -1.0, stiffness_, 0.0;
  inverse /= stiffness_;
  Response p;
  p[0] = inverse * (e_ * input - input);
  for (int j = 1; j < 3; ++j) p[j] = inverse * (p[j - 1] * (j / sigma) - input);
  return p;
}

}  // namespace dmp::detail
