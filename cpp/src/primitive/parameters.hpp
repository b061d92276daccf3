#pragma once

#include <dmp/error.hpp>
#include <dmp/options.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <string>

#include "geometry/pose.hpp"
#include "primitive/rollout.hpp"

namespace dmp::detail {

inline void require_finite(const Eigen::Ref<const Eigen::VectorXd>& value, Eigen::Index size,
                           const std::string& name) {
  if (value.size() != size)
    throw InvalidArgument(name + ": " + std::to_string(value.size()) + " numbers, expected " +
                          std::to_string(size) + ".");
  for (Eigen::Index d = 0; d < size; ++d)
    if (!std::isfinite(value[d]))
      throw InvalidArgument(indexed(name, d) + ": " + number(value[d]) + ", expected a finite number.");
}

inline void require_weights(const RowMatrix& weights, Eigen::Index rows, Eigen::Index columns) {
  if (weights.rows() != rows || weights.cols() != columns)
    throw InvalidArgument("weights: " + std::to_string(weights.rows()) + " x " +
                          std::to_string(weights.cols()) + ", expected " + std::to_string(rows) + " x " +
                          std::to_string(columns) + ".");
}

/// The options of a model: nothing is left open once there are weights.
inline DmpOptions settled(const DmpOptions& given, const RowMatrix& weights) {
  DmpOptions options = given;
  if (options.basis_count == 0)
    options.basis_count = static_cast<int>(std::max<Eigen::Index>(weights.rows(), 1));
  if (options.regression == Regression::automatic) options.regression = Regression::ridge;
  if (options.derivatives == Derivatives::automatic) options.derivatives = Derivatives::interpolate;
  return options.resolved();
}

}  // namespace dmp::detail
