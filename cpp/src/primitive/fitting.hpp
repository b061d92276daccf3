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
#include "primitive/forcing_scale.hpp"
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

template <class Space>
std::vector<AxisGroup> groups_of(const typename Space::Point& point) {
  std::vector<AxisGroup> groups;
  Geometry<Space>::add_groups(point, groups);
  return groups;
}

/// What a model's scaling goes by (d): its displacement; in the turning form p goes from 0 to 0.
template <class Space>
Eigen::VectorXd way_of(const Ends<Space>& model) {
  Eigen::VectorXd way = model.displacement;
  Eigen::Index first = 0;
  for (const AxisGroup& group : groups_of<Space>(model.start)) {
    if (group.turns && model.reference.rows() > 0) way.segment(first, group.size).setZero();
    first += group.size;
  }
  return way;
}

/// Calls work(part, first, size, scale) for each group of axes, with the scale of a model.
template <class Space, class Work>
void for_scales(const Ends<Space>& model, const DmpOptions& options, Work work) {
  const Eigen::VectorXd way = way_of<Space>(model);
  Eigen::Index first = 0;
  Eigen::Index part = 0;
  for (const AxisGroup& group : groups_of<Space>(model.start)) {
    work(part++, first, group.size,
         ForcingScale(options, way.segment(first, group.size), model.amplitude.segment(first, group.size)));
    first += group.size;
  }
}

/// Takes out of `values` (K x d) what the advance (K x parts, or empty) of a motion of this way (d), `share`
/// of it, adds to them in a run of the model: it is no part of the model's own.
template <class Space>
void take_out_advance(RowMatrix& values, double share, const RowMatrix& advance, const Eigen::VectorXd& way,
                      const Ends<Space>& model, const DmpOptions& options) {
  if (advance.size() == 0) return;
  for_scales<Space>(model, options, [&](auto part, auto first, auto size, ForcingScale scale) {
    scale.set(way.segment(first, size));
    values.middleCols(first, size) -= share * advance.col(part) * scale.offset().transpose();
  });
}

/// Sets the scales of a target, group of axes by group, for a model that goes from other ends.
template <class Space>
void apply_scaling(Example<Space>& example, const Ends<Space>& model, const DmpOptions& options) {
  if (advances(options))
    take_out_advance<Space>(example.target.value, 1.0, example.advance, example.way, model, options);
  Eigen::Index first = 0;
  for (const AxisGroup& group : groups_of<Space>(model.start)) {
    apply_scaling(example.target, first, example.ends.displacement.segment(first, group.size),
                  model.displacement.segment(first, group.size), model.amplitude.segment(first, group.size),
                  options);
    first += group.size;
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
    if (advances(decided))
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
