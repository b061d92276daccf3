#pragma once

#include <dmp/spread.hpp>

#include <algorithm>
#include <string>

#include "primitive/fitting.hpp"

namespace dmp::detail {

template <class Space>
SpreadOf<Space> spread_of(const std::vector<typename Space::Demonstration>& demonstrations,
                          Eigen::Index count) {
  using G = Geometry<Space>;
  using Point = typename Space::Point;
  require_alike<Space>(pointers_to(demonstrations));
  if (count < 2) throw InvalidArgument("count: " + std::to_string(count) + ", expected at least 2 phases.");
  SpreadOf<Space> result{Eigen::VectorXd::LinSpaced(count, 0.0, 1.0), {}, {}};
  std::vector<std::vector<Point>> paths;
  for (const auto& demonstration : demonstrations)
    paths.push_back(G::points_at(demonstration, result.phase * demonstration.duration()));
  const double freedom = static_cast<double>(std::max<std::size_t>(paths.size() - 1, 1));
  RowMatrix away(static_cast<Eigen::Index>(paths.size()), dimension_of<Space>(demonstrations.front()));
  std::vector<Point> means;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    std::vector<Point> here;
    for (const std::vector<Point>& path : paths) here.push_back(path[k]);
    means.push_back(G::mean(here));
    for (std::size_t j = 0; j < here.size(); ++j)
      away.row(static_cast<Eigen::Index>(j)) = G::minus(here[j], means.back()).transpose();
    result.covariance.push_back(away.transpose() * away / freedom);
  }
  result.mean = G::path_of(means);
  return result;
}

}  // namespace dmp::detail
