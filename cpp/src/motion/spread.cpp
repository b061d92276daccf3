#include <dmp/error.hpp>
#include <dmp/so3.hpp>
#include <dmp/spread.hpp>

#include <algorithm>
#include <string>

namespace dmp {
namespace {

using Eigen::Index;

void require(std::size_t demonstrations, Index count) {
  if (demonstrations == 0) throw InvalidArgument("demonstrations: none, expected at least one.");
  if (count < 2) throw InvalidArgument("count: " + std::to_string(count) + ", expected at least 2 phases.");
}

/// The mean of x x^T over the rows, for deviations from their mean.
Eigen::MatrixXd covariance_of(const RowMatrix& deviations) {
  const double freedom = static_cast<double>(std::max<Index>(deviations.rows() - 1, 1));
  return deviations.transpose() * deviations / freedom;
}

}  // namespace

Spread spread(const std::vector<Demonstration>& demonstrations, Index count) {
  require(demonstrations.size(), count);
  Spread result{Eigen::VectorXd::LinSpaced(count, 0.0, 1.0), {}, {}};
  std::vector<RowMatrix> paths;
  for (const Demonstration& demonstration : demonstrations) {
    if (demonstration.dimension() != demonstrations[0].dimension())
      throw InvalidArgument("demonstrations: of different dimensions, expected one for all.");
    paths.push_back(demonstration.at(result.phase * demonstration.duration()).position);
  }
  result.mean = RowMatrix::Zero(count, paths[0].cols());
  for (const RowMatrix& path : paths) result.mean += path / static_cast<double>(paths.size());
  RowMatrix deviations(static_cast<Index>(paths.size()), paths[0].cols());
  for (Index k = 0; k < count; ++k) {
    for (std::size_t j = 0; j < paths.size(); ++j)
      deviations.row(static_cast<Index>(j)) = paths[j].row(k) - result.mean.row(k);
    result.covariance.push_back(covariance_of(deviations));
  }
  return result;
}

PoseSpread spread(const std::vector<PoseDemonstration>& demonstrations, Index count) {
  require(demonstrations.size(), count);
  std::vector<Demonstration> positions;
  std::vector<Rotations> rotations;
  PoseSpread result{Eigen::VectorXd::LinSpaced(count, 0.0, 1.0), {}, {}};
  for (const PoseDemonstration& demonstration : demonstrations) {
    positions.push_back(demonstration.position());
    rotations.push_back(demonstration.orientation().at(result.phase * demonstration.duration()).rotation);
  }
  const RowMatrix mean = spread(positions, count).mean;
  RowMatrix deviations(static_cast<Index>(positions.size()), 6);
  for (Index k = 0; k < count; ++k) {
    Rotations here;
    for (const Rotations& path : rotations) here.push_back(path[static_cast<std::size_t>(k)]);
    const Eigen::Matrix3d middle = so3::mean_rotation(here);
    for (std::size_t j = 0; j < here.size(); ++j) {
      const double time = result.phase[k] * demonstrations[j].duration();
      const RowMatrix position = positions[j].at(Eigen::VectorXd::Constant(1, time)).position;
      deviations.row(static_cast<Index>(j)) << position - mean.row(k),
          so3::log(Eigen::Matrix3d(here[j] * middle.transpose())).transpose();
    }
    result.mean.push_back(pose_of(middle, mean.row(k)));
    result.covariance.push_back(covariance_of(deviations));
  }
  return result;
}

}  // namespace dmp
