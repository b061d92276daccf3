#pragma once

#include <dmp/options.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// Whether a scaling multiplies the forcing term by what start and goal say.
inline bool multiplies(Scaling scaling) noexcept {
  return scaling == Scaling::per_axis || scaling == Scaling::per_axis_relative ||
         scaling == Scaling::rotation_dilation;
}

/// Whether a model has an advance: alone, or for what its scaling leaves.
inline bool advances(const DmpOptions& options) noexcept {
  return options.scaling == Scaling::advance || (multiplies(options.scaling) && options.scaling_guard);
}

/// What becomes of the forcing term f, from where a run starts and goes compared with the demonstration:
/// S f + f_sigma (D* - S D), with the factor S of the scaling, the ways D demonstrated and D* of the run, and
/// f_sigma the forcing term of what advances from 0 to 1. Without a guard the second term is left out.
class ForcingScale {
 public:
  /// Why an axis is not multiplied as its scaling says.
  enum class Guard { none, short_way, far_goal };

  /// demonstrated (d): goal - start of the demonstration; amplitude (d): the range it covered, axis by axis.
  ForcingScale(const DmpOptions& options, const Eigen::VectorXd& demonstrated,
               const Eigen::VectorXd& amplitude);

  /// displacement (d): goal - start of the run. No allocation.
  void set(const Eigen::Ref<const Eigen::VectorXd>& displacement) noexcept;
  /// Whether apply leaves every f as it is.
  bool is_one() const noexcept { return is_fixed() || (scaling_ == Scaling::advance && !advances_); }
  /// The same for every displacement.
  bool is_fixed() const noexcept { return scaling_ == Scaling::none; }
  /// Whether something advances.
  bool advances() const noexcept { return advances_; }
  /// Of rotation_dilation: whether S is a dilated rotation, and by how much it dilates.
  bool rotates() const noexcept { return rotates_; }
  double dilation() const noexcept { return dilation_; }
  /// (d) D* - S D.
  const Eigen::VectorXd& offset() const noexcept { return offset_; }
  Guard guard(Eigen::Index axis, const Eigen::VectorXd& displacement) const noexcept;
  /// f (d) in place; `advance`: f_sigma, where something advances.
  void apply(double* f, const double* advance = nullptr) const noexcept;

 private:
  void set_axes(const Eigen::Ref<const Eigen::VectorXd>& displacement) noexcept;
  void set_rotation(const Eigen::Ref<const Eigen::VectorXd>& displacement) noexcept;
  bool is_scaled(Eigen::Index axis) const noexcept;
  double within_reach(double way, double demonstrated) const noexcept;
  void multiply(Eigen::Map<Eigen::VectorXd> force) const noexcept;

  Scaling scaling_;
  bool guarded_;
  Eigen::VectorXd demonstrated_;
  Eigen::VectorXd amplitude_;
  Eigen::VectorXd factor_;  // per axis
  Eigen::VectorXd offset_;
  bool advances_ = false;
  bool rotates_ = false;
  double dilation_ = 1.0;
  Eigen::VectorXd from_;  // unit vectors of the minimal rotation
  Eigen::VectorXd to_;
  Eigen::VectorXd aside_;  // for opposite vectors: the half turn in the plane of from_ and aside_
  bool opposite_ = false;
};

}  // namespace dmp::detail
