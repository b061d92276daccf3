#pragma once
// Demonstrations as deviations from one reference motion, and whether they belong together.

#include <dmp/error.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "primitive/distribution_fit.hpp"
#include "primitive/fitting.hpp"
#include "primitive/reference_motion.hpp"

namespace dmp::detail {

constexpr double kFarthestTurn = 150.0 * 3.14159265358979323846 / 180.0;  // rad, from the reference
constexpr double kLongestTurn = 0.5;        // rad, between two points of the reference
constexpr Eigen::Index kMostPoints = 2000;  // of the reference
constexpr Eigen::Index kCompared = 51;      // phases at which ways are compared
constexpr double kLeastLikeness = 0.5;

template <class Space>
std::vector<Eigen::Index> parts_in(const typename Space::Point& point) {
  std::vector<Eigen::Index> parts;
  for (const AxisGroup& group : groups_of<Space>(point)) parts.push_back(group.size);
  return parts;
}

/// Axes and turns of what a list of tangents (K x d) says, part by part: calls work(first, size, turns).
template <class Space, class Work>
void for_parts(const typename Space::Point& point, Work work) {
  Eigen::Index first = 0;
  for (const AxisGroup& group : groups_of<Space>(point)) {
    work(first, group.size, group.turns);
    first += group.size;
  }
}

/// The mean of the demonstrations at even phases: as many as there are control points, or more where they
/// turn far.
template <class Space>
std::vector<typename Space::Point> mean_points(
    const std::vector<typename Space::Demonstration>& demonstrations, Eigen::Index count) {
  using G = Geometry<Space>;
  const Eigen::VectorXd phases = Eigen::VectorXd::LinSpaced(count, 0.0, 1.0);
  std::vector<std::vector<typename Space::Point>> paths;
  for (const auto& demonstration : demonstrations)
    paths.push_back(G::points_at(demonstration, phases * demonstration.duration()));
  std::vector<typename Space::Point> means;
  double turn = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    std::vector<typename Space::Point> here;
    for (const auto& path : paths) here.push_back(path[k]);
    means.push_back(G::mean(here));
    if (k == 0) continue;
    const Eigen::VectorXd way = G::minus(means[k], means[k - 1]);
    for_parts<Space>(means[k], [&](auto first, auto size, bool turns) {
      if (turns) turn = std::max(turn, way.segment(first, size).norm());
    });
  }
  return turn > kLongestTurn && count < kMostPoints ? mean_points<Space>(demonstrations, 2 * count) : means;
}

/// A demonstration's samples, of which `times` (T) are phases, as deviations from the reference.
template <class Space>
Deviation deviation_of(const typename Space::Demonstration& demonstration, const Eigen::VectorXd& phase,
                       const typename Space::Demonstration& reference) {
  const auto moments = moments_of(reference, phase, static_cast<Space*>(nullptr));
  const auto points = Geometry<Space>::points_at(demonstration, demonstration.time());
  Deviation deviation{phase, RowMatrix(phase.size(), dimension_of<Space>(points.front()))};
  Eigen::VectorXd last = Eigen::VectorXd::Zero(deviation.value.cols());
  for (std::size_t k = 0; k < moments.size(); ++k) {
    Eigen::VectorXd here(last.size());
    OffsetIn<Space>::between(moments[k].view(), points[k], last.data(), here.data());
    deviation.value.row(static_cast<Eigen::Index>(k)) = here;
    last = here;
  }
  return deviation;
}

/// Throws unless every rotation stays on one side of the globe about the reference.
template <class Space>
void require_near(const Deviation& deviation, const typename Space::Point& point, const std::string& name) {
  for_parts<Space>(point, [&](auto first, auto size, bool turns) {
    if (!turns) return;
    Eigen::Index k = 0;
    const double far = deviation.value.middleCols(first, size).rowwise().norm().maxCoeff(&k);
    if (far > kFarthestTurn)
      throw InvalidArgument(name + ": at " + number(deviation.phase[k]) +
                            " of its duration it is turned by " +
                            number(far * 180.0 / 3.14159265358979323846) +
                            " deg from the others' mean, expected 150 deg at most. It does not belong to "
                            "them: leave it out.");
  });
}

/// A demonstration's way at even phases (K x d), about its mean.
template <class Space>
RowMatrix way_about_mean(const typename Space::Demonstration& demonstration) {
  using G = Geometry<Space>;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(kCompared, 0.0, demonstration.duration());
  const auto points = G::points_at(demonstration, times);
  RowMatrix way = RowMatrix::Zero(kCompared, dimension_of<Space>(points.front()));
  for (Eigen::Index k = 1; k < kCompared; ++k) {
    const auto here = static_cast<std::size_t>(k);
    way.row(k) = way.row(k - 1) + G::minus(points[here], points[here - 1]).transpose();
  }
  return way.rowwise() - way.colwise().mean();
}

/// How alike two ways are, -1 to 1: the mean of their parts' correlations, of the parts that move.
template <class Space>
double likeness(const RowMatrix& a, const RowMatrix& b, const typename Space::Point& point) {
  double sum = 0.0;
  double moving = 0.0;
  for_parts<Space>(point, [&](auto first, auto size, bool) {
    const auto one = a.middleCols(first, size);
    const auto other = b.middleCols(first, size);
    const double lengths = one.norm() * other.norm();
    if (!(lengths > 0.0)) return;
    sum += one.cwiseProduct(other).sum() / lengths;
    moving += 1.0;
  });
  return moving > 0.0 ? sum / moving : 1.0;
}

/// Throws where a demonstration goes another way than the others' mean: nothing could be said of such a
/// distribution.
template <class Space>
void require_one_motion(const std::vector<typename Space::Demonstration>& demonstrations,
                        const typename Space::Point& point) {
  std::vector<RowMatrix> ways;
  for (const auto& demonstration : demonstrations) ways.push_back(way_about_mean<Space>(demonstration));
  RowMatrix sum = RowMatrix::Zero(ways.front().rows(), ways.front().cols());
  for (const RowMatrix& way : ways) sum += way;
  for (std::size_t j = 0; j < ways.size(); ++j) {
    const double found = likeness<Space>(ways[j], sum - ways[j], point);
    if (found < kLeastLikeness)
      throw InvalidArgument(indexed("demonstrations", static_cast<long>(j)) +
                            ": goes another way than the others (correlation " + number(found) +
                            ", expected " + number(kLeastLikeness) +
                            " or more). They do not belong together: leave it out, or cut and turn it as the "
                            "others.");
  }
}

}  // namespace dmp::detail
