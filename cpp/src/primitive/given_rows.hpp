#pragma once
// What is given of a motion, as observations of the weights.

#include <dmp/distribution.hpp>
#include <dmp/error.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "primitive/deviations.hpp"
#include "primitive/distribution_checks.hpp"
#include "primitive/parameters.hpp"
#include "primitive/reference_motion.hpp"

namespace dmp::detail {

template <class Space>
RowMatrix table_of(const std::vector<typename Space::Point>& points) {
  RowMatrix table(static_cast<Eigen::Index>(points.size()), numbers_of<Space>(points.front()).size());
  for (std::size_t k = 0; k < points.size(); ++k)
    table.row(static_cast<Eigen::Index>(k)) = numbers_of<Space>(points[k]);
  return table;
}

/// The motion at even phases of a table, over 1 s.
template <class Space>
typename Space::Demonstration reference_from(const RowMatrix& table) {
  constexpr Eigen::Index columns = fixed_columns<Space>();
  if (table.rows() < 2 || table.cols() < 1 || (columns > 0 && table.cols() != columns) || !table.allFinite())
    throw InvalidArgument("reference: " + std::to_string(table.rows()) + " x " +
                          std::to_string(table.cols()) + ", expected rows of " +
                          (columns > 0 ? std::to_string(columns) : "d") + " finite numbers, 2 or more.");
  std::vector<typename Space::Point> points;
  for (Eigen::Index k = 0; k < table.rows(); ++k) points.push_back(point_from<Space>(table.row(k)));
  return {Eigen::VectorXd::LinSpaced(table.rows(), 0.0, 1.0), Geometry<Space>::path_of(points)};
}

/// How far each part moves (RMS about its mean), or else how far the demonstrations lie apart; 1 for
/// rotations, and for what does neither.
template <class Space>
Eigen::VectorXd extents_of(const std::vector<typename Space::Point>& means,
                           const std::vector<Deviation>& deviations) {
  RowMatrix way(static_cast<Eigen::Index>(means.size()), deviations.front().value.cols());
  for (std::size_t k = 0; k < means.size(); ++k)
    way.row(static_cast<Eigen::Index>(k)) = Geometry<Space>::minus(means[k], means.front()).transpose();
  const RowMatrix moved = way.rowwise() - way.colwise().mean();
  std::vector<double> extents;
  for_parts<Space>(means.front(), [&](auto first, auto size, bool turns) {
    double extent = moved.middleCols(first, size).norm() / std::sqrt(static_cast<double>(moved.rows()));
    for (const Deviation& deviation : deviations)
      extent = std::max(extent, deviation.value.middleCols(first, size).cwiseAbs().maxCoeff());
    extents.push_back(turns || !(extent > 0.0) ? 1.0 : extent);
  });
  return Eigen::Map<Eigen::VectorXd>(extents.data(), static_cast<Eigen::Index>(extents.size()));
}

/// (d x d) J: a change of the deviation by e moves the point by J e, in the axes of the world.
template <class Space>
Eigen::MatrixXd tangents_of(const Eigen::VectorXd& value, const typename Space::Point& point) {
  Eigen::MatrixXd tangents = Eigen::MatrixXd::Identity(value.size(), value.size());
  for_parts<Space>(point, [&](auto first, auto size, bool turns) {
    if (turns) tangents.block(first, first, size, size) = so3::left_jacobian(value.segment<3>(first));
  });
  return tangents;
}

template <class Space>
Eigen::MatrixXd tangents_of(const Moment<Space>& at, const Eigen::VectorXd& value) {
  typename Space::Point point;
  OffsetIn<Space>::point(at.view(), point);
  return tangents_of<Space>(value, point);
}

template <class Space>
std::vector<Eigen::Index> axes_of(const Given<Space>& given, Eigen::Index all) {
  return axes_from(given.axes, all, "axes");
}

/// Rows of the weights for some axes, of a derivative at a phase.
inline Eigen::MatrixXd rows_for(const SplineRow& row, const std::vector<Eigen::Index>& axes, Eigen::Index all,
                                Eigen::Index weights) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(axes.size()), weights);
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      rows(static_cast<Eigen::Index>(i), (row.first + static_cast<Eigen::Index>(k)) * all + axes[i]) =
          row.value[k];
  return rows;
}

/// Some axes of a vector.
inline Eigen::VectorXd chosen(const Eigen::VectorXd& all, const std::vector<Eigen::Index>& axes) {
  Eigen::VectorXd some(static_cast<Eigen::Index>(axes.size()));
  for (std::size_t i = 0; i < axes.size(); ++i) some[static_cast<Eigen::Index>(i)] = all[axes[i]];
  return some;
}

/// A covariance in the axes of the world as one of the deviation: J^-1 C J^-T.
inline std::optional<Eigen::MatrixXd> about_reference(const std::optional<Eigen::MatrixXd>& covariance,
                                                      const Eigen::MatrixXd& tangents) {
  if (!covariance || covariance->rows() != tangents.rows() || covariance->cols() != tangents.cols())
    return covariance;
  const Eigen::MatrixXd inverse = tangents.inverse();
  return inverse * *covariance * inverse.transpose();
}

/// `data` is that of a distribution. Throws InvalidArgument, naming `name`.
template <class Space, class Data>
LinearObservation observation_of(const Given<Space>& given, const std::string& name, const Data& data) {
  using Offset = OffsetIn<Space>;
  require_phase(given.phase, name + ".phase");
  if (!given.point && !given.velocity)
    throw InvalidArgument(name + ": neither point nor velocity, expected one of them, or both.");
  const Eigen::Index all = data.axes;
  const std::vector<Eigen::Index> axes = axes_from(given.axes, all, name + ".axes");
  const Moment<Space> at = data.moment(given.phase);
  const SplineRow row = data.points.at(given.phase);
  Eigen::VectorXd value = value_of(row, data.parameters.mean, all);
  if (given.point) {
    typename Space::Point like;
    Offset::point(at.view(), like);
    Geometry<Space>::require(*given.point, like, name + ".point");
    const Eigen::VectorXd near = value;
    Eigen::VectorXd known(all);
    Offset::between(at.view(), Geometry<Space>::projected(*given.point), near.data(), known.data());
    for (const Eigen::Index axis : axes) value[axis] = known[axis];
  }
  const Eigen::MatrixXd tangents = tangents_of<Space>(at, value);
  const auto weights = data.parameters.mean.size();
  const auto count = static_cast<Eigen::Index>(axes.size());
  const Eigen::Index both = given.point && given.velocity ? 2 * count : count;
  LinearObservation seen{Eigen::MatrixXd(both, weights), Eigen::VectorXd(both),
                         Eigen::MatrixXd::Zero(both, both)};
  if (given.point) {
    seen.rows.topRows(count) = rows_for(row, axes, all, weights);
    seen.value.head(count) = chosen(value, axes);
    seen.deviation.topLeftCorner(count, count) =
        deviation_from(about_reference(given.covariance, tangents), axes, all, name + ".covariance");
  }
  if (given.velocity) {
    require_finite(*given.velocity, all, name + ".velocity");
    const double whole = data.parameters.duration;
    const Eigen::VectorXd velocity = whole * *given.velocity;
    Eigen::VectorXd rate(all);
    Offset::rate(at.view(), value.data(), velocity.data(), rate.data());
    seen.rows.bottomRows(count) = rows_for(data.points.at(given.phase, 1), axes, all, weights);
    seen.value.tail(count) = chosen(rate, axes);
    seen.deviation.bottomRightCorner(count, count) =
        whole * deviation_from(about_reference(given.velocity_covariance, tangents), axes, all,
                               name + ".velocity_covariance");
  }
  return seen;
}

/// The mean weights of a distribution, of deviations from another reference.
template <class Space>
Eigen::VectorXd mean_about(const Distribution<Space>& distribution,
                           const typename Space::Demonstration& reference) {
  const auto& parameters = distribution.parameters();
  const ControlPoints points(parameters.options.control_points);
  const Eigen::Index count = 8 * points.count();
  const Eigen::VectorXd phases = Eigen::VectorXd::LinSpaced(count, 0.0, 1.0);
  const typename Space::Demonstration motion(phases, distribution.spread(count).mean);
  const SplineSums sums = sums_of(points, deviation_of<Space>(motion, phases, reference));
  const RowMatrix weights = sums.gram.ldlt().solve(sums.moment);
  return Eigen::Map<const Eigen::VectorXd>(weights.data(), weights.size());
}

template <class Space>
void require_blendable(const std::vector<Distribution<Space>>& distributions,
                       const Eigen::VectorXd& weights) {
  require_weights(weights, distributions.size());
  const auto& first = distributions.front();
  for (std::size_t j = 1; j < distributions.size(); ++j)
    if (distributions[j].parameters().options.control_points != first.parameters().options.control_points ||
        distributions[j].dimension() != first.dimension())
      throw InvalidArgument(indexed("distributions", static_cast<long>(j)) + ": " +
                            std::to_string(distributions[j].parameters().options.control_points) +
                            " control points of " + std::to_string(distributions[j].dimension()) +
                            " axes, expected " + std::to_string(first.parameters().options.control_points) +
                            " of " + std::to_string(first.dimension()) + " as the first.");
}

}  // namespace dmp::detail
