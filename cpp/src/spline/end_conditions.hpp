#pragma once

#include <dmp/spline.hpp>

#include <Eigen/Core>
#include <array>

#include "spline/knots.hpp"

namespace dmp::detail {

/// Which condition predicts the samples at either end best; see EndCondition.
std::array<EndCondition, 2> end_conditions(const Eigen::VectorXd& times, const RowMatrix& values);

/// The derivative of `order` at an end as a sum of the order + 1 coefficients next to it, scaled to a largest
/// weight of 1: scale times the derivative = weights . coefficients[first ..].
struct EndDerivative {
  EndDerivative(const Knots& knots, int order, bool at_begin);

  Eigen::Index first;
  std::array<double, 6> weights{};
  double scale;
};

/// The samples (T x d) with two rows more at each end that has a condition: what its scaled fourth and third
/// derivatives shall be.
RowMatrix with_end_conditions(const RowMatrix& values, const Eigen::VectorXd& times, const Knots& knots,
                              const std::array<EndCondition, 2>& ends);

}  // namespace dmp::detail
