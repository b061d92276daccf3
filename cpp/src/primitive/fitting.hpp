#pragma once

#include <dmp/error.hpp>
#include <dmp/forcing.hpp>
#include <dmp/options.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "primitive/forcing_fit.hpp"
#include "primitive/learning.hpp"
#include "primitive/product_space.hpp"

namespace dmp::detail {

/// Durations and ends of several motions.
template <class Space>
struct Motions {
  std::vector<double> durations;
  std::vector<Ends<Space>> ends;
};

/// A model without weights from the means of several motions: durations, starts, goals, velocities over phase
/// and ranges. Of rotations the displacement lies on the branch of the first; all turn along with one
/// reference.
template <class Space>
typename Space::Parameters mean_of(const Motions<Space>& motions, const DmpOptions& options) {
  using G = Geometry<Space>;
  const double share = 1.0 / static_cast<double>(motions.ends.size());
  typename Space::Parameters parameters;
  parameters.options = options;
  parameters.duration = 0.0;
  for (const double duration : motions.durations) parameters.duration += share * duration;
  std::vector<typename Space::Point> starts;
  std::vector<typename Space::Point> goals;
  const Eigen::VectorXd& branch = motions.ends.front().displacement;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(branch.size());
  Ends<Space> mean = motions.ends.front();
  mean.z = zero;
  mean.amplitude = zero;
  for (const Ends<Space>& ends : motions.ends) {
    starts.push_back(ends.start);
    goals.push_back(ends.goal);
    mean.z += share * ends.z;
    mean.amplitude += share * ends.amplitude;
  }
  mean.start = G::mean(starts);
  mean.goal = G::mean(goals);
  mean.displacement = G::displacement(mean.start, mean.goal, branch, options);
  G::set_ends(parameters, mean);
  return parameters;
}

/// What a fit learns from: a model without weights, and a target for each demonstration; of Scaling::advance
/// also one for the advance of each part.
template <class Space>
struct LearningTask {
  typename Space::Parameters parameters;
  std::vector<ForcingTarget> targets;
  std::vector<ForcingTarget> advance;
};

template <class Demonstration>
std::vector<const Demonstration*> pointers_to(const std::vector<Demonstration>& demonstrations) {
  std::vector<const Demonstration*> pointers;
  for (const Demonstration& demonstration : demonstrations) pointers.push_back(&demonstration);
  return pointers;
}

template <class Space>
void require_alike(const Demonstrations<Space>& demonstrations) {
  if (demonstrations.empty()) throw InvalidArgument("demonstrations: none, expected at least one.");
  const Eigen::Index dimension = dimension_of<Space>(*demonstrations.front());
  for (std::size_t j = 1; j < demonstrations.size(); ++j)
    if (dimension_of<Space>(*demonstrations[j]) != dimension)
      throw InvalidArgument(indexed("demonstrations", static_cast<long>(j)) + ": " +
                            std::to_string(dimension_of<Space>(*demonstrations[j])) +
                            " dimensions, expected " + std::to_string(dimension) + " as in the first.");
}

/// Where the velocity at the start counts for nothing it is 0. Two samples show where from and where to, but
/// no way and no velocity: spring and damper alone move there.
template <class Space>
Example<Space> example_of(const typename Space::Demonstration& demonstration, const DmpOptions& options,
                          const RowMatrix& reference = {}) {
  Example<Space> example = Geometry<Space>::example_of(demonstration, options, reference);
  const bool shows_way = demonstration.size() >= 3;
  if (!shows_way || options.start == Start::rest) example.ends.z.setZero();
  if (!shows_way) example.target.value.setZero();
  if (!shows_way) example.advance.setZero();
  return example;
}

/// Takes out of `values` (K x d) what an advance (K x parts, or empty), `share` of it, adds to a motion whose
/// way differs from `way` (d).
template <class Space>
void take_out_advance(RowMatrix& values, double share, const RowMatrix& advance, const Ends<Space>& ends,
                      const Eigen::VectorXd& way) {
  if (advance.size() == 0 || ends.reference.rows() > 0) return;
  std::vector<Eigen::Index> sizes;
  Geometry<Space>::add_groups(ends.start, sizes);
  Eigen::Index first = 0;
  for (std::size_t part = 0; part < sizes.size(); first += sizes[part++])
    values.middleCols(first, sizes[part]) -=
        share * advance.col(static_cast<Eigen::Index>(part)) *
        (ends.displacement - way).segment(first, sizes[part]).transpose();
}

/// Sets the scales of a target, group of axes by group, for a model that goes from other ends. What advances
/// with the difference of their ways is no part of what is learned for the model's own.
template <class Space>
void apply_scaling(Example<Space>& example, const Ends<Space>& model, const DmpOptions& options) {
  std::vector<Eigen::Index> sizes;
  Geometry<Space>::add_groups(model.start, sizes);
  if (options.scaling == Scaling::advance)
    take_out_advance<Space>(example.target.value, 1.0, example.advance, example.ends, model.displacement);
  Eigen::Index first = 0;
  for (const Eigen::Index size : sizes) {
    apply_scaling(example.target, first, example.ends.displacement.segment(first, size),
                  model.displacement.segment(first, size), model.amplitude.segment(first, size), options);
    first += size;
  }
}

/// Scaling::automatic decided.
inline DmpOptions with_scaling(DmpOptions options) {
  if (options.scaling == Scaling::automatic) options.scaling = Scaling::advance;
  return options;
}

template <class Space>
LearningTask<Space> task_of(const Demonstrations<Space>& demonstrations, const DmpOptions& options) {
  require_alike<Space>(demonstrations);
  const auto [decided, reference] =
      Geometry<Space>::decide(with_scaling(options.resolved()), demonstrations, rotations_in<Space>() == 1);
  std::vector<Example<Space>> examples;
  Motions<Space> motions;
  for (const typename Space::Demonstration* demonstration : demonstrations) {
    examples.push_back(example_of<Space>(*demonstration, decided, reference));
    motions.durations.push_back(demonstration->duration());
    motions.ends.push_back(examples.back().ends);
  }
  LearningTask<Space> task{mean_of<Space>(motions, decided), {}, {}};
  const Ends<Space> model = Geometry<Space>::ends_of(task.parameters);
  for (Example<Space>& example : examples) {
    apply_scaling<Space>(example, model, decided);
    if (decided.scaling == Scaling::advance)
      task.advance.push_back({example.target.s, example.advance, Eigen::VectorXd::Ones(parts_of<Space>())});
    task.targets.push_back(std::move(example.target));
  }
  return task;
}

/// Columns that are learned together, from the same samples.
inline std::vector<ForcingTarget> side_by_side(const std::vector<ForcingTarget>& first,
                                               const std::vector<ForcingTarget>& second) {
  if (second.empty()) return first;
  std::vector<ForcingTarget> both = first;
  for (std::size_t j = 0; j < both.size(); ++j) {
    both[j].value.resize(first[j].value.rows(), first[j].value.cols() + second[j].value.cols());
    both[j].value << first[j].value, second[j].value;
    both[j].scale.resize(both[j].value.cols());
    both[j].scale << first[j].scale, second[j].scale;
  }
  return both;
}

/// How many columns a task asks for.
template <class Space>
Eigen::Index columns_of(const LearningTask<Space>& task) {
  return task.targets.front().value.cols() + (task.advance.empty() ? 0 : parts_of<Space>());
}

/// The model's parameters with the weights of a task.
template <class Space>
typename Space::Parameters learned(LearningTask<Space>&& task, ForcingFit& fit) {
  const Eigen::Index axes = task.targets.front().value.cols();
  const RowMatrix weights = fit.weights(side_by_side(task.targets, task.advance));
  task.parameters.weights = weights.leftCols(axes);
  if (weights.cols() > axes) task.parameters.advance = weights.rightCols(weights.cols() - axes);
  return std::move(task.parameters);
}

}  // namespace dmp::detail
