#pragma once

#include <Eigen/Core>

#include "detail/flush.hpp"

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

  /// Prepares a step of size sigma > 0; free when it is the step of the last call.
  void prepare(double sigma) noexcept;

  /// One axis: u and z after the step, from the forcing at its start, middle and end.
  void advance(double& u, double& z, double f_start, double f_middle, double f_end) const noexcept {
    const double next =
        e_(0, 0) * u + e_(0, 1) * z + b_(0, 0) * f_start + b_(0, 1) * f_middle + b_(0, 2) * f_end;
    z = flushed(e_(1, 0) * u + e_(1, 1) * z + b_(1, 0) * f_start + b_(1, 1) * f_middle + b_(1, 2) * f_end);
    u = flushed(next);
  }

 private:
  void prepare_free_motion(double sigma) noexcept;
  void prepare_response(double sigma) noexcept;

  double alpha_;
  double stiffness_;
  double sigma_ = 0.0;
  Eigen::Matrix2d e_ = Eigen::Matrix2d::Identity();  // exp(A sigma)
  Eigen::Matrix<double, 2, 3> b_ =
      Eigen::Matrix<double, 2, 3>::Zero();  // of the forcing at start, middle, end
};

}  // namespace dmp::detail
