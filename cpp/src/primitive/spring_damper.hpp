#pragma once

#include <Eigen/Core>
#include <array>

#include "geometry/flush.hpp"

namespace dmp::detail {

/// The linear part of the transformation system over a step sigma of the phase, exactly:
///   d/ds [u; z] = A [u; z] + [0; 1] F(s),  A = [0 1; -alpha beta, -alpha],  u = y - g,
/// with F given at the step's start, middle and end and taken as the parabola through them: fourth order in
/// sigma, exact for the spring alone. docs/formulation.md, "Integration".
class SpringDamper {
 public:
  SpringDamper(double alpha, double beta) noexcept : alpha_(alpha), stiffness_(alpha * beta) {}

  double alpha() const noexcept { return alpha_; }
  double stiffness() const noexcept { return stiffness_; }

  /// Prepares a step of size sigma > 0: some forty operations for a step of a control loop, none when it is
  /// that of the last call.
  void prepare(double sigma) noexcept;

  /// One axis: u and z after the step, from the forcing at its start, middle and end.
  [[gnu::always_inline]] void advance(double& u, double& z, double f_start, double f_middle,
                                      double f_end) const noexcept {
    const Eigen::Array2d next = e_.col(0).array() * u + e_.col(1).array() * z + b_.col(0).array() * f_start +
                                b_.col(1).array() * f_middle + b_.col(2).array() * f_end;
    const Eigen::Array2d state = flushed<Eigen::Array2d>(next);
    u = state[0];
    z = state[1];
  }

 private:
  using Response = std::array<Eigen::Vector2d, 3>;

  void prepare_free_motion(double sigma) noexcept;
  Response short_response(double sigma) noexcept;
  Response long_response(double sigma) const noexcept;

  double alpha_;
  double stiffness_;
  double sigma_ = 0.0;
  Eigen::Matrix2d e_ = Eigen::Matrix2d::Identity();  // exp(A sigma)
  Eigen::Matrix<double, 2, 3> b_ =
      Eigen::Matrix<double, 2, 3>::Zero();  // of the forcing at start, middle, end
};

}  // namespace dmp::detail
