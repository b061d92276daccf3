#pragma once

#include <dmp/error.hpp>
#include <dmp/options.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>

#include "base/text.hpp"
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

inline void require_weights(const RowMatrix& weights, Eigen::Index rows, Eigen::Index columns,
                            const std::string& name = "weights") {
  if (weights.rows() != rows || weights.cols() != columns)
    throw InvalidArgument(name + ": " + std::to_string(weights.rows()) + " x " +
                          std::to_string(weights.cols()) + ", expected " + std::to_string(rows) + " x " +
                          std::to_string(columns) + " (kernels x axes).");
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

/// Checks the fields of a model's parameters one by one; throws InvalidArgument, naming the field.
template <class Geometry>
class FieldCheck {
  using Point = typename Geometry::Point;

 public:
  /// `kernels` of the forcing term, and the model's start, which all points are like.
  FieldCheck(Eigen::Index kernels, const Point& start, Eigen::Index dimension)
      : kernels_(kernels), start_(start), dimension_(dimension) {}

  void operator()(const char*, double duration) const { require_duration(duration); }
  void operator()(const char* name, const Point& point) const { Geometry::require(point, start_, name); }
  void operator()(const char* name, const RowMatrix& weights) const {
    require_weights(weights, kernels_, dimension_, name);
  }
  /// A number for each axis, or for a known number of them.
  template <int N, std::enable_if_t<!std::is_same_v<Eigen::Matrix<double, N, 1>, Point>, int> = 0>
  void operator()(const char* name, const Eigen::Matrix<double, N, 1>& values) const {
    require_finite(values, N == Eigen::Dynamic ? dimension_ : N, name);
  }

 private:
  Eigen::Index kernels_;
  const Point& start_;
  Eigen::Index dimension_;
};

/// Calls visit(name, field) for every field of parameters beside the options and those that may be empty.
template <class Parameters, class Visit>
void visit_fields(Parameters& parameters, const Visit& visit) {
  std::apply([&](const auto&... field) { (visit(field.first, parameters.*field.second), ...); },
             std::remove_const_t<Parameters>::fields());
}

/// The same for those that may be empty.
template <class Parameters, class Visit>
void visit_optional_fields(Parameters& parameters, const Visit& visit) {
  std::apply([&](const auto&... field) { (visit(field.first, parameters.*field.second), ...); },
             std::remove_const_t<Parameters>::optional_fields());
}

}  // namespace dmp::detail
