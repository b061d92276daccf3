#pragma once

#include <dmp/options.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// What becomes of the forcing term, from where a run starts and goes compared with the demonstration.
class ForcingScale {
 public:
  /// demonstrated (d): goal - start of the demonstration; amplitude (d): the range it covered, axis by axis.
  ForcingScale(Scaling scaling, const Eigen::VectorXd& demonstrated, const Eigen::VectorXd& amplitude);

  /// displacement (d): goal - start of the run. No allocation.
  void set(const Eigen::Ref<const Eigen::VectorXd>& displacement) noexcept;
  /// Whether apply leaves every f as it is.
  bool is_one() const noexcept { return is_fixed() || (scaling_ == Scaling::advance && !is_offset_); }
  /// The same for every displacement.
  bool is_fixed() const noexcept { return scaling_ == Scaling::none; }
  /// f (d) in place; `advance`, for Scaling::advance: the forcing term of what goes from 0 to 1.
  void apply(double* f, const double* advance = nullptr) const noexcept;

 private:
  void set_rotation(const Eigen::Ref<const Eigen::VectorXd>& displacement) noexcept;

  Scaling scaling_;
  Eigen::VectorXd demonstrated_;
  Eigen::VectorXd amplitude_;
  Eigen::VectorXd factor_;  // per axis: what f is multiplied by, or the offset that advances
  bool is_offset_ = false;
  bool rotates_ = false;
  double dilation_ = 1.0;
  Eigen::VectorXd from_;  // unit vectors of the minimal rotation
  Eigen::VectorXd to_;
  Eigen::VectorXd aside_;  // for opposite vectors: the half turn in the plane of from_ and aside_
  bool opposite_ = false;
};

}  // namespace dmp::detail
