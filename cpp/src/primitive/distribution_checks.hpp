#pragma once
// What a distribution refuses, and what it is made of, as far as it is the same in every space.

#include <dmp/distribution.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "primitive/control_points.hpp"
#include "primitive/weight_gaussian.hpp"

namespace dmp::detail {

/// Share of the variance at a phase by which an observed motion may lie beside what the weights can say.
constexpr double kMisfit = 0.3;

// Each throws InvalidArgument, naming the argument.
void require_options(const DistributionOptions& options);
void require_phase(double phase, const std::string& name);
void require_positive(const Eigen::VectorXd& values, Eigen::Index size, const std::string& name);
const Eigen::VectorXd& require_noise(const Eigen::VectorXd& noise, const std::vector<Eigen::Index>& parts);
/// The lower Cholesky factor of a covariance of these axes; zero unless given.
Eigen::MatrixXd deviation_from(const std::optional<Eigen::MatrixXd>& covariance,
                               const std::vector<Eigen::Index>& axes, Eigen::Index all,
                               const std::string& name);
std::vector<Eigen::Index> axes_from(const std::vector<Eigen::Index>& given, Eigen::Index all,
                                    const std::string& name);
/// Phases of the samples of a part that begins at `phase`, of a motion that takes `whole`.
Eigen::VectorXd phases_of(const Eigen::VectorXd& time, double whole, double phase);
void require_weights(const Eigen::VectorXd& weights, std::size_t count);
void require_fields(const DistributionOptions& options, Eigen::Index demonstrations, double duration,
                    const Eigen::VectorXd& mean, const RowMatrix& factor, const Eigen::VectorXd& noise,
                    Eigen::Index axes, Eigen::Index parts);

/// Samples that lie close together say the same of what the weights cannot follow: what to multiply the
/// share of the variance with that each of them may be off.
double share_of_samples(const Eigen::VectorXd& phases, const ControlPoints& points);

/// By what the standard deviation that M demonstrations show is widened: the mean is off by 1 / M, the
/// covariance was taken about it, and both make what is next a Student t of M - 1 degrees of freedom, of
/// which two standard deviations shall hold as much as of a Gaussian (quantile after Cornish and Fisher,
/// Abramowitz and Stegun 26.7.5).
double widening(std::size_t demonstrations);

Information no_information(Eigen::Index weights);
/// Adds one sample (d) with these variances (d).
void add(Information& seen, const SplineRow& row, const Eigen::VectorXd& value,
         const Eigen::VectorXd& variance);

/// The inverse of F F^T. Throws, naming distributions[j], where there is none.
Eigen::MatrixXd precision_of(const Eigen::MatrixXd& factor, std::size_t j);

}  // namespace dmp::detail
