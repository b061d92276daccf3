#pragma once

#include <dmp/fit_report.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "primitive/primitive_bodies.hpp"

namespace dmp {

namespace detail {

/// Throws InvalidArgument unless both are positive.
void require_tolerance(const Tolerance& tolerance);
/// A motion that ends near its start can hardly be scaled by (goal - start): a new goal multiplies it.
void warn_of_scaling(FitReport& report, const Eigen::VectorXd& displacement,
                     const Eigen::VectorXd& amplitude);
/// Everything else that a user should know; `excess`: how far the rmse goes beyond the tolerance, 1 is just
/// within; `sizes`: samples of each demonstration.
void warn(FitReport& report, const std::vector<Eigen::Index>& sizes, const DmpOptions& options,
          double excess);

/// Accelerations of a run along a demonstration, and what its samples hold, at either end.
template <class Space>
class EndWatch {
 public:
  explicit EndWatch(const typename Space::Demonstration& demonstration)
      : demonstration_(demonstration), peaks_(static_cast<std::size_t>(parts_of<Space>())) {}

  void look(Eigen::Index k, const typename Space::Output& output) {
    constexpr double kShare = 0.03;
    const double s = demonstration_.time()[k] / demonstration_.duration();
    if (s > kShare && s < 1.0 - kShare) return;
    double EndPeaks::* const of_model = s <= kShare ? &EndPeaks::start : &EndPeaks::goal;
    double EndPeaks::* const of_samples = s <= kShare ? &EndPeaks::start_samples : &EndPeaks::goal_samples;
    std::vector<double> sizes;
    Geometry<Space>::add_accelerations(output, sizes);
    raise(of_model, sizes);
    sizes.clear();
    if (k == 0 || k + 1 == demonstration_.size()) return;
    Geometry<Space>::add_second_differences(demonstration_, k, sizes);
    raise(of_samples, sizes);
  }
  const std::vector<EndPeaks>& peaks() const noexcept { return peaks_; }

 private:
  void raise(double EndPeaks::* which, const std::vector<double>& sizes) {
    for (std::size_t i = 0; i < sizes.size(); ++i) peaks_[i].*which = std::max(peaks_[i].*which, sizes[i]);
  }

  const typename Space::Demonstration& demonstration_;
  std::vector<EndPeaks> peaks_;
};

/// Row by row how far a run of the unchanged model is from a demonstration, with the same ends, at its
/// samples.
template <class Space>
RowMatrix deviation(const Primitive<Space>& model, const typename Space::Demonstration& demonstration,
                    EndWatch<Space>& watch) {
  const Ends<Space> ends = example_of<Space>(demonstration, model.options()).ends;
  Stepper<Space> run(model);
  run.set_duration(demonstration.duration());
  run.start_from(ends.start, Eigen::VectorXd(ends.z / demonstration.duration()));
  run.set_goal(ends.goal);
  RowMatrix away(demonstration.size(), model.dimension());
  for (Eigen::Index k = 0; k < demonstration.size(); ++k) {
    run.step(k > 0 ? demonstration.time()[k] - demonstration.time()[k - 1] : demonstration.time()[0]);
    Geometry<Space>::deviation(run.output(), demonstration, k, away.row(k).data());
    watch.look(k, run.output());
  }
  return away;
}

template <class Space>
Eigen::VectorXd rmse_of(const Primitive<Space>& model,
                        const std::vector<typename Space::Demonstration>& demonstrations,
                        FitReport* report = nullptr) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(model.dimension());
  Eigen::VectorXd most = squares;
  double count = 0.0;
  for (const auto& demonstration : demonstrations) {
    EndWatch<Space> watch(demonstration);
    const RowMatrix away = deviation(model, demonstration, watch);
    if (report) report->ends.push_back(watch.peaks());
    most = most.cwiseMax(away.cwiseAbs().colwise().maxCoeff().transpose());
    squares += away.colwise().squaredNorm().transpose();
    count += static_cast<double>(away.rows());
  }
  if (report) report->largest = most;
  return (squares / count).cwiseSqrt();
}

template <class Space>
double excess_of(const Primitive<Space>& model, const Eigen::VectorXd& rmse, const Tolerance& tolerance) {
  return Geometry<Space>::excess(model.start(), rmse, tolerance);
}

/// The fewest of kFewestKernels, doubled up to kMostKernels, that reach the tolerance; 0: none does.
template <class Space>
int suggested(const DmpOptions& options, const std::vector<typename Space::Demonstration>& demonstrations,
              const Tolerance& tolerance) {
  constexpr int kFewestKernels = 10;
  constexpr int kMostKernels = 1280;
  DmpOptions changed = options;
  if (options.derivatives == Derivatives::smooth) changed.derivatives = Derivatives::automatic;
  for (int count = kFewestKernels; count <= kMostKernels; count *= 2) {
    changed.basis_count = count;
    const auto tried = Primitive<Space>::fit(demonstrations, changed);
    if (excess_of(tried, rmse_of(tried, demonstrations), tolerance) <= 1.0) return count;
  }
  return 0;
}

/// Throws InvalidArgument unless there are demonstrations, all of the model's dimension.
template <class Space>
void require_fitting(const Primitive<Space>& model,
                     const std::vector<typename Space::Demonstration>& demonstrations) {
  if (demonstrations.empty()) throw InvalidArgument("demonstrations: none, expected at least one.");
  for (const auto& demonstration : demonstrations)
    if (dimension_of<Space>(demonstration) != model.dimension())
      throw InvalidArgument("demonstrations: " + std::to_string(dimension_of<Space>(demonstration)) +
                            " dimensions, expected " + std::to_string(model.dimension()) +
                            " as in the model.");
}

/// What was found in the demonstrations themselves.
template <class Space>
void inspect_demonstrations(FitReport& report,
                            const std::vector<typename Space::Demonstration>& demonstrations,
                            const DmpOptions& options) {
  const double share = 1.0 / static_cast<double>(demonstrations.size());
  report.noise = Eigen::VectorXd::Zero(report.rmse.size());
  report.removed = report.noise;
  for (const auto& demonstration : demonstrations) {
    std::vector<Extent> extents;
    Geometry<Space>::add_extents(demonstration, extents);
    std::vector<NoiseEstimate>& evidence = report.evidence.emplace_back();
    Geometry<Space>::denoised(demonstration, evidence);
    Eigen::Index first = 0;
    for (std::size_t i = 0; i < evidence.size(); first += extents[i++].axes) {
      const Eigen::Index axes = extents[i].axes;
      report.noise.segment(first, axes).array() += share * evidence[i].sigma;
      if (options.derivatives == Derivatives::smooth)
        report.removed.segment(first, axes).array() +=
            share * evidence[i].removed / std::sqrt(static_cast<double>(axes));
    }
    report.largest_log = std::max(report.largest_log, Geometry<Space>::largest_log(demonstration, options));
  }
}

}  // namespace detail

template <class Space>
FitReport assess(const Primitive<Space>& model,
                 const std::vector<typename Space::Demonstration>& demonstrations,
                 const Tolerance& tolerance) {
  detail::require_fitting(model, demonstrations);
  detail::require_tolerance(tolerance);
  const DmpOptions& options = model.options();
  FitReport report;
  report.rmse = detail::rmse_of(model, demonstrations, &report);
  detail::inspect_demonstrations<Space>(report, demonstrations, options);
  report.condition = regression_condition(options);
  report.suggested_basis_count = detail::suggested<Space>(options, demonstrations, tolerance);
  const auto ends = detail::Geometry<Space>::ends_of(model.parameters());
  if (options.scaling == Scaling::per_axis && !options.scaling_guard)
    detail::warn_of_scaling(report, ends.displacement, ends.amplitude);
  for (std::string& note : model.scaling_notes(model.goal())) report.warnings.push_back(std::move(note));
  std::vector<Eigen::Index> sizes;
  for (const auto& demonstration : demonstrations) sizes.push_back(demonstration.size());
  detail::warn(report, sizes, options, detail::excess_of(model, report.rmse, tolerance));
  return report;
}

}  // namespace dmp
