#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "spline/knots.hpp"

namespace dmp::detail {

/// The rotation Q(s) that turns along with a demonstration: c / |c| of a quintic B-spline c(s) of quaternions
/// on M equal spans of the phase, at rest at both ends and beyond them; or, of a rhythmic motion, Exp(2 pi s
/// t) Rbar, whole turns |t| a cycle about one axis. Two times continuously differentiable everywhere.
class TurningReference {
 public:
  /// (M + 1 x 4) w x y z, M >= 2: the coefficients, of which the first and the last count three times. Throws
  /// InvalidArgument for another size, ends that are not of length 1, or a spline that comes nearer to 0 than
  /// 0.5.
  /// Two rows are those of a rhythmic motion: the mean rotation Rbar, and 0 and t (turns a cycle, axis).
  explicit TurningReference(const RowMatrix& coefficients);
  /// The one round which a rhythmic motion goes: one cycle, its last sample left out.
  static TurningReference round(const Rotations& cycle);

  const RowMatrix& coefficients() const noexcept { return distinct_; }

  /// At a phase: Q, its velocity omega = 2 vec(Q' Q^-1) and the rate of it, per unit of phase, world frame.
  struct State {
    Eigen::Quaterniond turn;
    Eigen::Vector3d velocity;
    Eigen::Vector3d acceleration;
  };
  State at(double s) const noexcept;

  /// The one of fewest spans that stays within 2 rad of all rotations: tables (T x 4) of unit quaternions of
  /// continuous sign, one a demonstration, at its phases (T). None if 200 spans do not suffice.
  static std::optional<TurningReference> along(const std::vector<Eigen::VectorXd>& phases,
                                               const std::vector<RowMatrix>& quaternions);

 private:
  bool goes_round() const noexcept { return distinct_.rows() == 2; }
  State round_at(double s) const noexcept;
  Eigen::Vector4d value(double s) const noexcept;

  RowMatrix distinct_;
  std::shared_ptr<const Knots> knots_;
  std::array<RowMatrix, 3> coefficients_;  // of c and its first two derivatives
};

}  // namespace dmp::detail
