#pragma once

#include <dmp/forcing.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// The sums that both regressions need, over samples of any number of demonstrations, for axes that share
/// their scales. What depends on the phases alone is summed up once for demonstrations that share them.
class NormalEquations {
 public:
  /// `local`: for locally weighted regression, otherwise for ridge regression.
  NormalEquations(const GaussianBasis& basis, Eigen::Index axes, bool local);

  /// Forgets the demonstrations, not the phases of the last one.
  void clear();
  /// Adds one demonstration; axes first .. first + axes - 1 of the target, all with one scale.
  void add(const ForcingTarget& target, Eigen::Index first, double scale);

  Eigen::Index kernels() const noexcept { return basis_.count(); }
  Eigen::Index axes() const noexcept { return right_.cols(); }
  RowMatrix solve_lwr(int passes) const;
  RowMatrix solve_ridge(double ridge) const;
  /// Largest over smallest eigenvalue of D^-1/2 G D^-1/2 (locally weighted regression, D the norms) or G +
  /// ridge.
  double condition(double ridge) const;

 private:
  /// What depends on phases alone, for a scale of 1.
  struct Phases {
    explicit Phases(const GaussianBasis& basis);
    Eigen::VectorXd s;
    RowMatrix gram;  // (i, k) = G(i, i + k)
    Eigen::VectorXd norm;
  };

  /// Neighbouring samples under the same kernels, summed up four at a time.
  struct Block {
    Block(Eigen::Index kernels, Eigen::Index axes);
    bool takes(const GaussianBasis::Window& next) const noexcept;
    void add(const GaussianBasis::Window& at, double gram_weight, double norm_weight, double value_weight,
             const double* f) noexcept;
    /// Up to a multiple of four, with samples that weigh nothing.
    void fill_up() noexcept;

    static constexpr Eigen::Index kMost = 64;
    Eigen::VectorXd scratch;
    RowMatrix psi;
    Eigen::VectorXd gram;
    Eigen::VectorXd norm;
    RowMatrix value;  // (axes x samples)
    GaussianBasis::Window window{0, 0, 0.0};
    Eigen::Index size = 0;
  };

  void flush(bool new_phases) noexcept;
  void add_phases(Eigen::Index q) noexcept;
  void add_values(Eigen::Index q) noexcept;
  /// The lower triangle of the Gram matrix with the ridge on its diagonal.
  Eigen::MatrixXd with_ridge(double ridge) const;

  GaussianBasis basis_;
  bool local_;
  Block block_;
  Phases grid_;            // of the last demonstration
  Eigen::VectorXd share_;  // of its samples
  Phases all_;
  Eigen::MatrixXd right_;
};

}  // namespace dmp::detail
