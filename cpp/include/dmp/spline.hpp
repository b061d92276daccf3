#pragma once

#include <dmp/export.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <array>
#include <memory>

namespace dmp {

namespace detail {
class Collocation;
class Knots;
}  // namespace detail

class Spline;
namespace detail {
Spline spline_of(std::shared_ptr<const Knots> knots, RowMatrix coefficients);
}  // namespace detail

/// What a smoothing spline took out of its samples.
struct Smoothing {
  Eigen::VectorXd
      noise;  ///< (d) standard deviation found in the data, in their unit; 0 if nothing was smoothed
  Eigen::VectorXd removed;  ///< (d) root of the mean square of sample - spline
};

/// What closes an interpolating spline at either end, where the samples alone leave two conditions open.
enum class EndCondition {
  not_a_knot,        ///< the outermost pieces are one quintic: exact for smooth samples, amplifies noise
  third_difference,  ///< f'''' = 0, and f''' the third divided difference of the last four samples
  natural            ///< f''' = f'''' = 0
};

/// The interpolating quintic B-spline through samples on any increasing time grid (de Boor 1978, "A Practical
/// Guide to Splines", chapters IX and XIII): four times continuously differentiable. With fewer than six
/// samples it is the polynomial through them.
///
/// Each end gets the condition that predicts its samples best. With D_m the RMS of the first three m-th
/// differences of the samples from the end inwards: not_a_knot where D_6 <= min(D_3, D_4), as for samples of
/// a smooth motion; else third_difference where D_4 <= D_3; else natural. With not-a-knot ends white noise
/// would come out five times as large at the ends as inside. Fewer than 12 samples have not-a-knot ends.
class DMP_EXPORT Spline {
 public:
  /// times (T) strictly increasing, values (T x d), T >= 2. Throws InvalidArgument, naming the sample, for
  /// other sizes or times, or for numbers that are not finite; so do `smoothing` and `through`.
  Spline(const Eigen::VectorXd& times, const RowMatrix& values);

  /// The quintic spline that weighs closeness to the samples against the integral of its squared third
  /// derivative, by generalised cross-validation over all columns together (Craven and Wahba 1979): the noise
  /// is found in the data. Samples that repeat the one before count for nothing unless that is usual. With
  /// fewer than ten samples it is the interpolating one.
  static Spline smoothing(const Eigen::VectorXd& times, const RowMatrix& values, Smoothing* report = nullptr);

  /// The spline through other values (T x d) at the same times: what depends on the times alone is shared
  /// where the ends have the same conditions. Throws InvalidArgument for another number of rows, or if this
  /// is a smoothing spline.
  Spline through(const RowMatrix& values) const;

  Eigen::Index dimension() const noexcept { return coefficients_[0].cols(); }
  bool interpolates() const noexcept { return grid_ != nullptr; }  ///< false for a smoothing spline
  /// The conditions at the first and at the last sample; natural for a smoothing spline.
  const std::array<EndCondition, 2>& ends() const noexcept { return ends_; }

  /// Value, first and second derivative at each time (extrapolated by the end polynomial), each (times x d).
  /// Throws InvalidArgument for a time that is not finite, or so far away that the polynomial overflows.
  struct Samples {
    RowMatrix value;
    RowMatrix first;
    RowMatrix second;
  };
  Samples sample(const Eigen::VectorXd& times) const;

 private:
  friend Spline detail::spline_of(std::shared_ptr<const detail::Knots> knots, RowMatrix coefficients);
  Spline(std::shared_ptr<const detail::Knots> knots, RowMatrix coefficients);
  Spline(std::shared_ptr<const detail::Collocation> grid, const std::array<EndCondition, 2>& ends,
         const RowMatrix& values);
  void differentiate();
  template <int Columns>
  void sample(const Eigen::VectorXd& times, const std::array<double*, 3>& out) const;

  std::shared_ptr<const detail::Collocation> grid_;  // of the interpolating ones
  std::shared_ptr<const detail::Knots> knots_;
  std::array<EndCondition, 2> ends_{EndCondition::natural, EndCondition::natural};
  RowMatrix coefficients_[3];  // of the spline and its first two derivatives
};

}  // namespace dmp
