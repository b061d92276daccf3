#pragma once

#include <dmp/options.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "primitive/ends.hpp"
#include "primitive/turning_reference.hpp"
#include "primitive/vector_system.hpp"

namespace dmp::detail {

/// The turning form of rotations: R = Exp(p) Q(s), where p moves as a vector does and Q turns along with the
/// demonstrations.
class TurningSystem {
 public:
  /// Options of the rotations, resolved; `reference` are the coefficients of Q.
  TurningSystem(const DmpOptions& options, const RowMatrix& reference);

  /// eta = tau omega.
  void begin(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& eta) noexcept;
  /// On the branch of the present goal of p; back to the principal one where that leads far around.
  /// Another state at the present phase, on the branch of p.
  void reseat(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& eta) noexcept;
  void set_goal(const Eigen::Quaterniond& goal) noexcept;
  void start_with_goal(const Eigen::Quaterniond& goal) noexcept;
  bool unscaled() const noexcept { return p_.unscaled(); }
  bool advances() const noexcept { return p_.advances(); }
  void scale(double* forcing, const double* advance) const noexcept { p_.scale(forcing, advance); }
  void set_phase(double s) noexcept { phase_ = s; }
  void advance(double step, const Nodes& drive) noexcept { p_.advance(step, drive); }

  struct State {
    Eigen::Quaterniond rotation;
    Eigen::Vector3d eta;
    Eigen::Vector3d eta_rate;
  };
  /// Where it is while `drive` acts on p.
  State state(const double* drive) noexcept;
  Eigen::Vector3d p() const noexcept { return p_.point(); }
  Eigen::Quaterniond rotation() const noexcept;
  Eigen::Vector3d eta() const noexcept;

 private:
  TurningReference reference_;
  VectorSystem p_;
  Eigen::Quaterniond first_;  // Q^-1 at the start
  Eigen::Quaterniond last_;   // and at the end
  double phase_ = 0.0;
};

}  // namespace dmp::detail
