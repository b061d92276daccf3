#include <dmp/error.hpp>
#include <dmp/fit_report.hpp>
#include <dmp/so3.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "primitive/learning.hpp"

namespace dmp {
namespace {

using detail::number;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::VectorXd;

constexpr int kFewestKernels = 10;
constexpr int kMostKernels = 1280;

/// Row by row the rotation vector from b to a, world frame.
RowMatrix turns(const Rotations& a, const Rotations& b) {
  RowMatrix result(static_cast<Index>(a.size()), 3);
  for (std::size_t k = 0; k < a.size(); ++k)
    result.row(static_cast<Index>(k)) = so3::log(Matrix3d(a[k] * b[k].transpose())).transpose();
  return result;
}

// What the three kinds differ in: the deviation of a rollout from a demonstration, its noise, how far it
// turns.

/// A run of the unchanged model, stepped to each of the times; `look` takes what it needs there.
template <class Run, class Look>
void step_through(Run& run, const VectorXd& times, Look look) {
  for (Index k = 0; k < times.size(); ++k) {
    run.step(k > 0 ? times[k] - times[k - 1] : times[0]);
    look(k);
  }
}

RowMatrix deviation(const Dmp& dmp, const Demonstration& demonstration) {
  const detail::PositionLesson lesson = detail::lesson_of(demonstration, dmp.options());
  Run run(dmp);
  run.set_duration(demonstration.duration());
  run.start_from(lesson.start, lesson.start_z / demonstration.duration());
  run.set_goal(lesson.goal);
  RowMatrix away(demonstration.size(), demonstration.dimension());
  step_through(run, demonstration.time(),
               [&](Index k) { away.row(k) = run.position().transpose() - demonstration.position().row(k); });
  return away;
}

RowMatrix deviation(const OrientationDmp& dmp, const OrientationDemonstration& demonstration) {
  const detail::OrientationLesson lesson = detail::lesson_of(demonstration, dmp.options());
  OrientationRun run(dmp);
  run.set_duration(demonstration.duration());
  run.start_from(lesson.start, lesson.start_eta / demonstration.duration());
  run.set_goal(lesson.goal);
  Rotations again;
  step_through(run, demonstration.time(), [&](Index) { again.push_back(run.rotation()); });
  return turns(again, demonstration.rotation());
}

RowMatrix deviation(const PoseDmp& dmp, const PoseDemonstration& demonstration) {
  const detail::PositionLesson position = detail::lesson_of(demonstration.position(), dmp.options());
  const detail::OrientationLesson orientation = detail::lesson_of(demonstration.orientation(), dmp.options());
  Eigen::Matrix<double, 6, 1> twist;
  twist << position.start_z, orientation.start_eta;
  PoseRun run(dmp);
  run.set_duration(demonstration.duration());
  run.start_from(pose_of(orientation.start, position.start), twist / demonstration.duration());
  run.set_goal(pose_of(orientation.goal, position.goal));
  RowMatrix away(demonstration.size(), 6);
  Rotations again;
  step_through(run, demonstration.time(), [&](Index k) {
    away.row(k).head(3) = run.position().transpose() - demonstration.position().position().row(k);
    again.push_back(run.rotation());
  });
  away.rightCols(3) = turns(again, demonstration.orientation().rotation());
  return away;
}

/// The noise of each part of a demonstration, and how many columns it stands for.
using Found = std::vector<std::pair<NoiseEstimate, Index>>;

template <class One>
Found noise_of(const One& demonstration, Index columns) {
  NoiseEstimate found;
  demonstration.denoised(&found);
  return {{found, columns}};
}
Found noise_of(const Demonstration& demonstration) {
  return noise_of(demonstration, demonstration.dimension());
}
Found noise_of(const OrientationDemonstration& demonstration) { return noise_of(demonstration, 3); }
Found noise_of(const PoseDemonstration& demonstration) {
  NoiseEstimate position, orientation;
  demonstration.denoised(&position, &orientation);
  return {{position, 3}, {orientation, 3}};
}

/// A number of each part, once for each of its columns.
template <class Value>
VectorXd by_column(const Found& found, Value value) {
  std::vector<double> numbers;
  for (const auto& [noise, columns] : found)
    numbers.insert(numbers.end(), static_cast<std::size_t>(columns), value(noise, columns));
  return Eigen::Map<const VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
}

double largest_log_of(const Demonstration&, const DmpOptions&) { return 0.0; }
double largest_log_of(const OrientationDemonstration& demonstration, const DmpOptions& options) {
  return detail::largest_log(demonstration, options.log_branch);
}
double largest_log_of(const PoseDemonstration& demonstration, const DmpOptions& options) {
  return detail::largest_log(demonstration.orientation(), options.log_branch);
}

/// How far the rmse goes beyond the tolerance: 1 is just within.
double excess(const Dmp&, const VectorXd& rmse, const Tolerance& tolerance) {
  return rmse.norm() / tolerance.position;
}
double excess(const OrientationDmp&, const VectorXd& rmse, const Tolerance& tolerance) {
  return rmse.norm() / tolerance.angle;
}
double excess(const PoseDmp&, const VectorXd& rmse, const Tolerance& tolerance) {
  return std::max(rmse.head(3).norm() / tolerance.position, rmse.tail(3).norm() / tolerance.angle);
}

/// goal - start and the range covered, axis by axis.
struct Way {
  VectorXd displacement;
  VectorXd amplitude;
};
Way way_of(const Dmp& dmp) { return {dmp.goal() - dmp.start(), dmp.parameters().amplitude}; }
Way way_of(const OrientationDmp& dmp) { return {dmp.parameters().start_error, dmp.parameters().amplitude}; }
Way way_of(const PoseDmp& dmp) {
  Way way{VectorXd(6), dmp.parameters().amplitude};
  way.displacement << (dmp.goal() - dmp.start()).topRightCorner<3, 1>(), dmp.parameters().start_error;
  return way;
}

// What they share.

template <class Model, class Demonstrations>
VectorXd rmse_of(const Model& model, const Demonstrations& demonstrations, VectorXd* largest = nullptr) {
  VectorXd squares;
  double count = 0.0;
  for (const auto& demonstration : demonstrations) {
    const RowMatrix away = deviation(model, demonstration);
    const VectorXd most = away.cwiseAbs().colwise().maxCoeff();
    if (squares.size() == 0) squares = VectorXd::Zero(away.cols());
    squares += away.colwise().squaredNorm().transpose();
    count += static_cast<double>(away.rows());
    if (largest) *largest = largest->size() == 0 ? most : VectorXd(largest->cwiseMax(most));
  }
  return (squares / count).cwiseSqrt();
}

template <class Model, class Demonstrations>
int suggested(const Model& model, const Demonstrations& demonstrations, const Tolerance& tolerance) {
  DmpOptions options = model.options();
  options.derivatives =
      options.derivatives == Derivatives::smooth ? Derivatives::automatic : options.derivatives;
  for (int count = kFewestKernels; count <= kMostKernels; count *= 2) {
    options.basis_count = count;
    const Model tried = Model::fit(demonstrations, options);
    if (excess(tried, rmse_of(tried, demonstrations), tolerance) <= 1.0) return count;
  }
  return 0;
}

/// A motion that ends near its start can hardly be scaled by (goal - start): a new goal multiplies it.
template <class Model>
void warn_of_scaling(FitReport& report, const Model& model) {
  if (model.options().scaling != Scaling::per_axis) return;
  const Way way = way_of(model);
  for (Index d = 0; d < way.amplitude.size(); ++d)
    if (std::abs(way.displacement[d]) < 1e-3 * way.amplitude[d])
      report.warnings.push_back(
          "scaling: axis " + std::to_string(d) + " ends " + number(way.displacement[d]) +
          " from its start and covers " + number(way.amplitude[d]) +
          ": a new goal multiplies it by the ratio. Use Scaling::none or Scaling::per_axis_relative.");
}

template <class Demonstrations>
void warn(FitReport& report, const Demonstrations& demonstrations, const DmpOptions& options, double excess) {
  if (excess > 1.0)
    report.warnings.push_back("rmse: " + number(excess) + " times the tolerance. " +
                              (report.suggested_basis_count > 0
                                   ? std::to_string(report.suggested_basis_count) + " kernels reach it."
                                   : "More kernels do not help; Derivatives::smooth may."));
  for (std::size_t j = 0; j < demonstrations.size(); ++j)
    if (demonstrations[j].size() < 3)
      report.warnings.push_back(
          detail::indexed("demonstrations", static_cast<long>(j)) +
          ": two samples tell a start and a goal only; the spring and damper alone move there.");
  if (report.largest_log > 1.9 * M_PI && options.orientation_form != OrientationForm::turning)
    report.warnings.push_back(
        "largest_log: " + number(report.largest_log) +
        " rad comes near 2 pi, where the logarithm is singular across the axis. Split the demonstration.");
  if (report.condition > 5e13)
    report.warnings.push_back("condition: " + number(report.condition) +
                              " leaves few digits. Use fewer kernels, a larger overlap or a larger ridge.");
  if (options.derivatives != Derivatives::smooth && report.noise.maxCoeff() > 0.0)
    report.warnings.push_back("noise: " + number(report.noise.maxCoeff()) +
                              " was found and learned with the motion. Derivatives::smooth takes it out.");
}

void require_tolerance(const Tolerance& tolerance) {
  for (const auto& [name, value] :
       {std::pair("position", tolerance.position), std::pair("angle", tolerance.angle)})
    if (!(value > 0.0))
      throw InvalidArgument(std::string("tolerance.") + name + ": " + number(value) + ", expected > 0.");
}

template <class Model, class Demonstrations>
FitReport assessed(const Model& model, const Demonstrations& demonstrations, const Tolerance& tolerance) {
  if (demonstrations.empty()) throw InvalidArgument("demonstrations: none, expected at least one.");
  require_tolerance(tolerance);
  FitReport report;
  report.rmse = rmse_of(model, demonstrations, &report.largest);
  report.noise = VectorXd::Zero(report.rmse.size());
  report.removed = report.noise;
  for (const auto& demonstration : demonstrations) {
    const Found found = noise_of(demonstration);
    const double share = 1.0 / static_cast<double>(demonstrations.size());
    report.noise += share * by_column(found, [](const NoiseEstimate& n, Index) { return n.sigma; });
    if (model.options().derivatives == Derivatives::smooth)
      report.removed += share * by_column(found, [](const NoiseEstimate& n, Index columns) {
                          return n.removed / std::sqrt(static_cast<double>(columns));
                        });
    report.evidence.emplace_back();
    for (const auto& part : found) report.evidence.back().push_back(part.first);
    report.largest_log = std::max(report.largest_log, largest_log_of(demonstration, model.options()));
  }
  report.condition = regression_condition(model.options());
  report.suggested_basis_count = suggested(model, demonstrations, tolerance);
  warn_of_scaling(report, model);
  warn(report, demonstrations, model.options(), excess(model, report.rmse, tolerance));
  return report;
}

}  // namespace

FitReport assess(const Dmp& dmp, const std::vector<Demonstration>& demonstrations,
                 const Tolerance& tolerance) {
  for (const Demonstration& demonstration : demonstrations)
    if (demonstration.dimension() != dmp.dimension())
      throw InvalidArgument("demonstrations: " + std::to_string(demonstration.dimension()) +
                            " dimensions, expected " + std::to_string(dmp.dimension()) + " as in the model.");
  return assessed(dmp, demonstrations, tolerance);
}

FitReport assess(const OrientationDmp& dmp, const std::vector<OrientationDemonstration>& demonstrations,
                 const Tolerance& tolerance) {
  return assessed(dmp, demonstrations, tolerance);
}

FitReport assess(const PoseDmp& dmp, const std::vector<PoseDemonstration>& demonstrations,
                 const Tolerance& tolerance) {
  return assessed(dmp, demonstrations, tolerance);
}

}  // namespace dmp
