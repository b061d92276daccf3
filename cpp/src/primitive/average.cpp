#include <dmp/average.hpp>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <string>

#include "model_file/model_json.hpp"
#include "primitive/learning.hpp"

namespace dmp {
namespace {

using Eigen::Matrix3d;

/// Throws unless all have the options of the first. Compared as they stand in a file: every field, none
/// forgotten.
template <class Model>
void require_alike(const std::vector<Model>& models) {
  if (models.empty()) throw InvalidArgument("models: none, expected at least one.");
  const detail::Json first = detail::model_to_json(models[0])["options"];
  for (std::size_t j = 1; j < models.size(); ++j) {
    const detail::Json other = detail::model_to_json(models[j])["options"];
    for (const auto& [key, value] : first.items())
      if (other[key] != value)
        throw InvalidArgument("models[" + std::to_string(j) + "]: options." + key + " is " +
                              other[key].dump() + ", expected " + value.dump() +
                              " as in the first. Fit the demonstrations together.");
  }
}

/// What models in the turning form turn with, which must be the same for all.
template <class Model>
RowMatrix common_reference(const std::vector<Model>& models) {
  const RowMatrix& first = models[0].parameters().reference;
  for (std::size_t j = 1; j < models.size(); ++j) {
    const RowMatrix& other = models[j].parameters().reference;
    if (other.rows() != first.rows() || other != first)
      throw InvalidArgument("models[" + std::to_string(j) +
                            "]: turns along with another rotation than the first. Fit the demonstrations "
                            "together.");
  }
  return first;
}

template <class Model>
double share_of(const std::vector<Model>& models) {
  return 1.0 / static_cast<double>(models.size());
}

/// Log(Rg R0^T) of the mean start and goal, on the branch of the first model.
Eigen::Vector3d error_between(const Matrix3d& start, const Matrix3d& goal, const Eigen::Vector3d& branch) {
  return so3::lifted_log(Eigen::Quaterniond(Matrix3d(goal * start.transpose())), branch);
}

}  // namespace

Dmp average(const std::vector<Dmp>& models) {
  require_alike(models);
  const double share = share_of(models);
  DmpParameters mean = models[0].parameters();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(mean.start.size());
  mean = {
      mean.options, 0.0, zero, zero, zero, zero, RowMatrix::Zero(mean.weights.rows(), mean.weights.cols())};
  for (const Dmp& model : models) {
    const DmpParameters& p = model.parameters();
    if (p.start.size() != zero.size())
      throw InvalidArgument("models: of different dimensions, expected one for all.");
    mean.duration += share * p.duration;
    mean.start += share * p.start;
    mean.goal += share * p.goal;
    mean.start_velocity += share * p.duration * p.start_velocity;
    mean.amplitude += share * p.amplitude;
    mean.weights += share * p.weights;
  }
  mean.start_velocity /= mean.duration;
  return Dmp(mean);
}

OrientationDmp average(const std::vector<OrientationDmp>& models) {
  require_alike(models);
  const double share = share_of(models);
  OrientationDmpParameters mean;
  mean.options = models[0].options();
  mean.duration = 0.0;
  mean.weights = RowMatrix::Zero(models[0].parameters().weights.rows(), 3);
  mean.reference = common_reference(models);
  Rotations starts;
  Rotations goals;
  for (const OrientationDmp& model : models) {
    const OrientationDmpParameters& p = model.parameters();
    mean.duration += share * p.duration;
    mean.start_velocity += share * p.duration * p.start_velocity;
    mean.amplitude += share * p.amplitude;
    mean.weights += share * p.weights;
    starts.push_back(p.start);
    goals.push_back(p.goal);
  }
  mean.start_velocity /= mean.duration;
  mean.start = so3::mean_rotation(starts);
  mean.goal = so3::mean_rotation(goals);
  mean.start_error = error_between(mean.start, mean.goal, models[0].parameters().start_error);
  return OrientationDmp(mean);
}

PoseDmp average(const std::vector<PoseDmp>& models) {
  require_alike(models);
  const double share = share_of(models);
  PoseDmpParameters mean;
  mean.options = models[0].options();
  mean.duration = 0.0;
  mean.weights = RowMatrix::Zero(models[0].parameters().weights.rows(), 6);
  mean.reference = common_reference(models);
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  Rotations starts;
  Rotations goals;
  for (const PoseDmp& model : models) {
    const PoseDmpParameters& p = model.parameters();
    mean.duration += share * p.duration;
    mean.start_twist += share * p.duration * p.start_twist;
    mean.amplitude += share * p.amplitude;
    mean.weights += share * p.weights;
    start += share * p.start.topRightCorner<3, 1>();
    goal += share * p.goal.topRightCorner<3, 1>();
    starts.push_back(p.start.topLeftCorner<3, 3>());
    goals.push_back(p.goal.topLeftCorner<3, 3>());
  }
  mean.start_twist /= mean.duration;
  mean.start = pose_of(so3::mean_rotation(starts), start);
  mean.goal = pose_of(so3::mean_rotation(goals), goal);
  mean.start_error = error_between(mean.start.topLeftCorner<3, 3>(), mean.goal.topLeftCorner<3, 3>(),
                                   models[0].parameters().start_error);
  return PoseDmp(mean);
}

}  // namespace dmp
