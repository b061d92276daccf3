#pragma once

#include <dmp/export.hpp>
#include <dmp/realtime.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <vector>

namespace dmp {

/// Gaussian kernels over the phase. Kernel i stands at s_i = i / (N - 1), c_i = exp(-alpha_x s_i).
///
/// * Equal in time: psi_i = exp(-overlap ((s - s_i)(N - 1))^2), Gaussians in s = -ln(x) / alpha_x. They all
/// have
///   one width in time, so only the kernels around s are not zero (below 1e-17 they count as zero), and they
///   are all found with one exponential: psi_{k+1} / psi_k is a table times a power.
/// * Periodic: the same round a cycle of N spacings, s_i = i / N, nearest on the circle, and no gate (x = 1).
/// * Source: psi_i = exp(-h_i (x - c_i)^2), h_i = N^1.5 / (alpha_x c_i), Gaussians in x (DeWolf's rule).
class DMP_EXPORT GaussianBasis {
 public:
  /// Kernels first .. first + count - 1 (of periodic ones modulo N); the others are zero. They are
  /// exp(exponent) times what is given.
  struct Window {
    int first;
    int count;
    double exponent;
    double factor() const noexcept;  ///< exp(exponent), itself never denormal
  };

  /// Throws InvalidArgument unless count is 1 to 100000, 0 < alpha_x <= 50 and 0 < overlap <= 300. Neighbours
  /// cross at exp(-overlap / 4).
  static GaussianBasis equal_in_time(int count, double alpha_x, double overlap);
  static GaussianBasis source(int count, double alpha_x);
  /// Throws InvalidArgument unless count is 4 to 100000.
  static GaussianBasis periodic(int count, double overlap);

  int count() const noexcept { return count_; }
  bool is_periodic() const noexcept { return round_ > 0.0; }
  double alpha_x() const noexcept { return alpha_x_; }
  /// (N) centers c_i in x.
  Eigen::VectorXd centers() const;
  /// The most kernels that a window can hold.
  int window_capacity() const noexcept { return capacity_; }

  /// psi up to a common factor, one of them about 1: what a normalised sum needs. `psi` has window_capacity()
  /// places.
  Window proportional(double s, double* psi) const noexcept DMP_REALTIME;
  /// psi itself: the weights of locally weighted regression.
  Window activations(double s, double* psi) const noexcept DMP_REALTIME;
  /// (T x N) psi at each phase s; each row divided by its sum if `normalised`.
  /// Throws InvalidArgument for a phase that is not finite or below 0.
  RowMatrix activations(const Eigen::VectorXd& s, bool normalised = false) const;
  /// (T x N) what the forcing term is linear in, x psi / sum psi: features(s) * weights = f(s).
  RowMatrix features(const Eigen::VectorXd& s) const;
  /// x = exp(-alpha_x s), by which the forcing term is multiplied so that it fades out; 0 beyond exp(-400).
  double gate(double s) const noexcept DMP_REALTIME;
  static void require_phases(const Eigen::VectorXd& s);

 private:
  friend class ForcingTerm;
  struct Place;
  struct PhasePair;

  GaussianBasis(int count, double alpha_x);
  Place place(double s) const noexcept;
  PhasePair pair(double s, double next, int middle) const noexcept;
  Window equal_in_time_window(double s, double* psi) const noexcept;
  Window round_window(double s, double* psi) const noexcept;
  Window source_window(double s, double* psi) const noexcept;

  int count_;
  double alpha_x_;
  double overlap_ = 0.0;  // 0: the source's kernels, or periodic ones
  int reach_ = 0;         // kernels to either side that count
  double round_ = 0.0;    // overlap of periodic kernels; else 0
  int capacity_ = 0;
  std::vector<double> table_;   // exp(-overlap k^2), k = 0 .. reach
  std::vector<double> center_;  // the source's c_i
  std::vector<double> width_;   // the source's h_i
};

}  // namespace dmp
