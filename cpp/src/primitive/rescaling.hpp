#pragma once

#include <dmp/primitive.hpp>

#include <string>
#include <utility>
#include <vector>

#include "primitive/fitting.hpp"
#include "primitive/rollout.hpp"

// A model under another scaling, and what its guard does.

namespace dmp::detail {

/// "scaling: axis 1 ends 0.002 from the start and covers 0.3, ..", for a guard that steps in.
std::string guard_text(const DmpOptions& options, ForcingScale::Guard guard, Eigen::Index axis, double way,
                       double demonstrated, double range);

/// The weights of the advance along a model's own motion (N x parts).
template <class Space>
RowMatrix own_advance(const Primitive<Space>& model) {
  using G = Geometry<Space>;
  const Eigen::Index samples = 10 * static_cast<Eigen::Index>(model.options().basis_count) + 1;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(samples, 0.0, model.duration());
  std::vector<typename Space::Point> points;
  Runner<Space> runner = runner_of(model);
  step_through(runner, {times, 0.0},
               [&](Eigen::Index) { points.push_back(typename Space::Point(runner.system().point())); });
  DmpOptions options = model.options();
  options.derivatives = Derivatives::interpolate;
  options.regression = Regression::ridge;
  const typename Space::Demonstration motion(times, G::path_of(points));
  const Example<Space> example = G::example_of(motion, options, G::ends_of(model.parameters()).reference);
  const ForcingTarget target{example.target.s, example.advance, Eigen::VectorXd::Ones(parts_of<Space>())};
  return ForcingFit(basis_of(options), options, parts_of<Space>()).weights({target});
}

/// By what f of one scaling is multiplied at the model's own ends (d).
template <class Space>
Eigen::VectorXd own_factors(const Ends<Space>& ends, const DmpOptions& options) {
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(ends.displacement.size());
  if (options.scaling != Scaling::per_axis) return factors;
  for_scales<Space>(ends, options, [&](auto, auto first, auto size, ForcingScale scale) {
    scale.set(ends.displacement.segment(first, size));
    scale.apply(factors.data() + first);
  });
  return factors;
}

template <class Space>
Primitive<Space> rescaled(const Primitive<Space>& model, Scaling scaling) {
  auto parameters = model.parameters();
  DmpOptions& options = parameters.options;
  options.scaling = scaling == Scaling::automatic ? Scaling::advance : scaling;
  options.scaling_guard = true;
  options.scaling = options.resolved().scaling;  // none of a rhythmic motion, whatever is asked for
  const Ends<Space> ends = Geometry<Space>::ends_of(parameters);
  const Eigen::VectorXd factors = own_factors<Space>(ends, model.options());
  parameters.weights = (parameters.weights * factors.asDiagonal()) *
                       own_factors<Space>(ends, options).cwiseInverse().asDiagonal();
  if (!advances(options)) {
    parameters.advance = {};
  } else if (parameters.advance.size() == 0) {
    parameters.advance = own_advance(model);
  }
  return Primitive<Space>(parameters);
}

template <class Space>
std::vector<std::string> scaling_notes(const Primitive<Space>& model, const typename Space::Point& goal) {
  using G = Geometry<Space>;
  const DmpOptions& options = model.options();
  std::vector<std::string> notes;
  if (!multiplies(options.scaling) || !options.scaling_guard) return notes;
  const Ends<Space> ends = G::ends_of(model.parameters());
  const Eigen::VectorXd way = G::displacement(model.start(), goal, ends.displacement, options);
  const bool together = options.scaling == Scaling::rotation_dilation;
  for_scales<Space>(ends, options, [&](auto, auto first, auto size, const ForcingScale& scale) {
    const auto length = [&](const Eigen::VectorXd& of, Eigen::Index d) {
      return together ? of.segment(first, size).norm() : of[first + d];
    };
    for (Eigen::Index d = 0; d < (together ? 1 : size); ++d) {
      const ForcingScale::Guard guard = scale.guard(d, way.segment(first, size));
      if (guard == ForcingScale::Guard::none) continue;
      notes.push_back(guard_text(options, guard, first + d, length(way, d), length(ends.displacement, d),
                                 length(ends.amplitude, d)));
    }
  });
  return notes;
}

}  // namespace dmp::detail
