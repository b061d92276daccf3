#pragma once

#include <dmp/basis.hpp>
#include <dmp/export.hpp>
#include <dmp/options.hpp>
#include <dmp/realtime.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace dmp {

/// The forcing term f(s) = x (sum psi_i w_i) / (sum psi_i), x = exp(-alpha_x s), one row of weights per
/// kernel (Ijspeert et al. 2013).
class DMP_EXPORT ForcingTerm {
 public:
  /// weights (N x dims). Throws InvalidArgument unless the rows match the basis and all are finite.
  ForcingTerm(const GaussianBasis& basis, const RowMatrix& weights);

  const GaussianBasis& basis() const noexcept { return basis_; }
  Eigen::Index dimension() const noexcept { return weights_.cols(); }
  const RowMatrix& weights() const noexcept { return weights_; }

  /// f (dims) at phase s; `psi` is scratch memory for basis().window_capacity() numbers.
  void evaluate(double s, double* psi, double* f) const noexcept DMP_REALTIME;
  /// The same at two phases, for little more than the cost of one where they are near each other.
  void evaluate(double s, double next, double* psi, double* f, double* f_next) const noexcept DMP_REALTIME;
  /// (T x dims) at each phase s.
  RowMatrix evaluate(const Eigen::VectorXd& s) const;

 private:
  template <int Axes>
  void evaluate_equal_in_time(double s, double next, double* f, double* f_next) const noexcept;
  template <int Axes>
  void evaluate_side_by_side(const GaussianBasis::Place& at, double s, double next, double* f,
                             double* f_next) const noexcept;
  void evaluate_window(double s, double* psi, double* f) const noexcept;

  /// The row of a kernel, of periodic ones with their neighbours round the cycle on both sides.
  const double* row(int kernel) const noexcept {
    return basis_.is_periodic() ? round_.data() + (kernel + basis_.reach_) * round_.cols()
                                : weights_.data() + kernel * weights_.cols();
  }

  GaussianBasis basis_;
  RowMatrix weights_;
  RowMatrix round_;  // (N + 1 + 2 reach x dims) of periodic kernels: the last and the first ones again
};

/// What a forcing term should be along one demonstration.
struct ForcingTarget {
  Eigen::VectorXd s;      ///< (K) phases, increasing
  RowMatrix value;        ///< (K x dims)
  Eigen::VectorXd scale;  ///< (dims): value = scale f
};

/// The weights (N x dims) of one forcing term for all targets together. Throws InvalidArgument for an axis
/// whose scale is zero while its target is not.
///
/// Locally weighted regression solves, kernel by kernel, w_i = sum psi_i x r / sum psi_i x^2 and goes again
/// over what is left, r = f - f(w): `passes` times, 1 being the textbook's; the passes converge to the
/// least-squares fit. The data are read once: the passes run on the band matrix G_ij = sum x^2 psi_i psi_j /
/// sum_k psi_k.
DMP_EXPORT RowMatrix fit_forcing(const GaussianBasis& basis, const std::vector<ForcingTarget>& targets,
                                 const DmpOptions& options);

/// How weights (N x dims) are found for the forcing terms along demonstrations: fit_forcing, or a function of
/// the user's own. A target's value is its scale times basis.features(target.s) * weights, axis by axis.
using Learner =
    std::function<RowMatrix(const GaussianBasis& basis, const std::vector<ForcingTarget>& targets)>;

/// The condition number of the matrix that fit_forcing solves with (ridge) or descends on (locally weighted
/// regression), for samples spread evenly over the phase.
/// Beyond 300 kernels that of 300. Throws InvalidArgument for options that no fit takes.
DMP_EXPORT double regression_condition(const DmpOptions& options);

}  // namespace dmp
