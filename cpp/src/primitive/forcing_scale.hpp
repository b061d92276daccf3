#pragma once

#include <dmp/options.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// What the forcing term is multiplied by, from where a run starts and goes compared with the demonstration.
class ForcingScale {
 public:
  /// demonstrated (d): goal - start of the demonstration; amplitude (d): the range it covered, axis by axis.
  ForcingScale(Scaling scaling, const Eigen::VectorXd& demonstrated, const Eigen::VectorXd& amplitude);

  /// displacement (d): goal - start of the run. No allocation.
  void set(const Eigen::Ref<const Eigen::VectorXd>& displacement) noexcept;
  /// Whether apply leaves every f as it is.
  bool is_one() const noexcept { return scaling_ == Scaling::none; }
  /// f (d) in place.
  void apply(double* f) const noexcept;

 private:
  void set_rotation(const Eigen::Ref<const Eigen::VectorXd>& displacement) noexcept;

  Scaling scaling_;
  Eigen::VectorXd demonstrated_;
  Eigen::VectorXd amplitude_;
  Eigen::VectorXd factor_;  // per axis
  bool rotates_ = false;
  double dilation_ = 1.0;
  Eigen::VectorXd from_;  // unit vectors of the minimal rotation
  Eigen::VectorXd to_;
  Eigen::VectorXd aside_;  // for opposite vectors: the half turn in the plane of from_ and aside_
  bool opposite_ = false;
};

}  // namespace dmp::detail
