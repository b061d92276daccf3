#pragma once

#include <dmp/options.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "primitive/rollout.hpp"
#include "primitive/space.hpp"

namespace dmp::detail {

/// How close a model has to come to one part (positions or orientations) of a demonstration, RMS: what the
/// samples themselves leave open.
struct Closeness {
  Eigen::Index axes;
  double tolerance;
  double extent;
  bool smoothed;
};
std::vector<Closeness> closeness(const std::vector<Extent>& parts, const std::vector<NoiseEstimate>& noise);

/// A demonstration as it is learned, and how closely.
template <class Space>
struct Prepared {
  typename Space::Demonstration motion;
  std::vector<Closeness> parts;
};

template <class Space>
Prepared<Space> prepared(const typename Space::Demonstration& given, Derivatives derivatives) {
  std::vector<NoiseEstimate> noise;
  const auto cleaned = Geometry<Space>::denoised(given, noise);
  const auto& motion = derivatives == Derivatives::automatic ? cleaned : given;
  std::vector<Extent> extents;
  Geometry<Space>::add_extents(motion, extents);
  return {motion, closeness(extents, noise)};
}

/// At most so many of the samples of a demonstration, the first and the last among them, and their times.
std::vector<Eigen::Index> some(Eigen::Index count);
Eigen::VectorXd times_at(const Eigen::VectorXd& time, const std::vector<Eigen::Index>& chosen);

/// By how many times its tolerance the worst part is missed; `squares`: sums over samples, axis by axis.
double worst_of(const Eigen::VectorXd& squares, Eigen::Index samples, const std::vector<Closeness>& parts);

/// By how many times its tolerance a model misses the part of its demonstration that it misses most.
template <class Space>
double miss(const Primitive<Space>& model, const Prepared<Space>& aim) {
  const std::vector<Eigen::Index> chosen = some(aim.motion.size());
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(model.dimension());
  Eigen::VectorXd away = squares;
  follow(model, {times_at(aim.motion.time(), chosen), 0.0}, {}, {},
         [&](Eigen::Index k, const typename Space::Output& output) {
           Geometry<Space>::deviation(output, aim.motion, chosen[static_cast<std::size_t>(k)], away.data());
           squares += away.cwiseAbs2();
         });
  return worst_of(squares, static_cast<Eigen::Index>(chosen.size()), aim.parts);
}

/// Options with a regression and derivatives in place of automatic ones.
DmpOptions with_regression(const DmpOptions& options);

constexpr int kKernelCounts[] = {25, 50, 100, 200, 400, 800};
constexpr double kWorthwhile = 1.5;  // times: twice the kernels have to come so much closer, or are of no use

/// The fewest kernels that reproduce a demonstration as closely as its samples allow; `fit` makes a model
/// with given options.
template <class Space, class Fit>
Primitive<Space> with_fewest_kernels(const Prepared<Space>& aim, DmpOptions options, Fit fit) {
  const int most = std::max<int>(kKernelCounts[1], 2 * static_cast<int>(aim.motion.size()));
  options.basis_count = kKernelCounts[0];
  Primitive<Space> best = fit(aim.motion, options);
  double least = miss(best, aim);
  for (std::size_t i = 1; i < std::size(kKernelCounts) && least > 1.0; ++i) {
    options.basis_count = kKernelCounts[i];
    if (options.basis_count > most) break;
    Primitive<Space> next = fit(aim.motion, options);
    const double now = miss(next, aim);
    if (kKernelCounts[i] > kKernelCounts[2] && now * kWorthwhile > least) break;
    if (now < least) {
      best = std::move(next);
      least = now;
    }
  }
  return best;
}

/// Learns with what DmpOptions leave to the demonstrations. `fit(demonstrations, options)` learns with
/// options that leave nothing open.
template <class Space, class Fit>
Primitive<Space> fit_automatically(const Demonstrations<Space>& demonstrations, const DmpOptions& options,
                                   Fit fit) {
  using Model = Primitive<Space>;
  using Demonstration = typename Space::Demonstration;
  std::vector<Prepared<Space>> aims;
  Demonstrations<Space> motions;
  DmpOptions stated = with_regression(options);
  bool smoothed = false;
  for (const Demonstration* demonstration : demonstrations) {
    aims.push_back(prepared<Space>(*demonstration, options.derivatives));
    for (const Closeness& part : aims.back().parts) smoothed = smoothed || part.smoothed;
  }
  for (const Prepared<Space>& aim : aims) motions.push_back(&aim.motion);
  const bool chosen = options.derivatives == Derivatives::automatic;
  if (chosen) stated.derivatives = Derivatives::interpolate;
  const auto alone = [&](const Demonstration& one, const DmpOptions& with) {
    return fit(Demonstrations<Space>{&one}, with);
  };
  const auto noted = [&](Model model) {
    if (!chosen || !smoothed) return model;
    auto parameters = model.parameters();
    parameters.options.derivatives = Derivatives::smooth;
    return Model(parameters);
  };
  if (options.basis_count == 0) {
    for (const Prepared<Space>& aim : aims) {
      Model model = with_fewest_kernels(aim, stated, alone);
      if (aims.size() == 1) return noted(std::move(model));
      stated.basis_count = std::max(stated.basis_count, model.options().basis_count);
    }
  }
  return noted(fit(motions, stated));
}

}  // namespace dmp::detail
