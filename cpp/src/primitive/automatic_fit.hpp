#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/dmp.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dmp::detail {

/// How close a model has to come to one part (positions or orientations) of a demonstration, RMS: what the
/// samples themselves leave open.
struct Closeness {
  double tolerance;
  double extent;
  bool smoothed;
};

/// A demonstration as it is learned, and how closely.
template <class Demonstration>
struct Prepared {
  Demonstration motion;
  std::vector<Closeness> parts;
};
Prepared<Demonstration> prepared(const Demonstration& given, Derivatives derivatives);
Prepared<OrientationDemonstration> prepared(const OrientationDemonstration& given, Derivatives derivatives);
Prepared<PoseDemonstration> prepared(const PoseDemonstration& given, Derivatives derivatives);

/// By how many times its tolerance a model misses the part of its demonstration that it misses most.
double miss(const Dmp& model, const Prepared<Demonstration>& aim);
double miss(const OrientationDmp& model, const Prepared<OrientationDemonstration>& aim);
double miss(const PoseDmp& model, const Prepared<PoseDemonstration>& aim);

/// Options with a regression and derivatives in place of automatic ones.
DmpOptions with_regression(const DmpOptions& options);

constexpr int kKernelCounts[] = {25, 50, 100, 200, 400, 800};
constexpr double kWorthwhile = 1.5;  // times: twice the kernels have to come so much closer, or are of no use

/// The fewest kernels that reproduce a demonstration as closely as its samples allow; `fit` makes a model
/// with given options.
template <class Model, class Demonstration, class Fit>
Model with_fewest_kernels(const Prepared<Demonstration>& aim, DmpOptions options, Fit fit) {
  const int most = std::max<int>(kKernelCounts[1], 2 * static_cast<int>(aim.motion.size()));
  options.basis_count = kKernelCounts[0];
  Model best = fit(aim.motion, options);
  double least = miss(best, aim);
  for (std::size_t i = 1; i < std::size(kKernelCounts) && least > 1.0; ++i) {
    options.basis_count = kKernelCounts[i];
    if (options.basis_count > most) break;
    Model next = fit(aim.motion, options);
    const double now = miss(next, aim);
    if (kKernelCounts[i] > kKernelCounts[2] && now * kWorthwhile > least) break;
    if (now < least) {
      best = std::move(next);
      least = now;
    }
  }
  return best;
}

/// Learns with what DmpOptions leave to the demonstrations. `fit(first, count, options)` learns with options
/// that leave nothing open.
template <class Model, class Demonstration, class Fit>
Model fit_automatically(const Demonstration* demonstrations, std::size_t count, const DmpOptions& options,
                        Fit fit) {
  std::vector<Prepared<Demonstration>> aims;
  std::vector<Demonstration> motions;
  DmpOptions stated = with_regression(options);
  bool smoothed = false;
  for (std::size_t j = 0; j < count; ++j) {
    aims.push_back(prepared(demonstrations[j], options.derivatives));
    motions.push_back(aims.back().motion);
    for (const Closeness& part : aims.back().parts) smoothed = smoothed || part.smoothed;
  }
  const bool chosen = options.derivatives == Derivatives::automatic;
  if (chosen) stated.derivatives = Derivatives::interpolate;
  const auto alone = [&](const Demonstration& one, const DmpOptions& with) { return fit(&one, 1, with); };
  const auto noted = [&](Model model) {
    if (!chosen || !smoothed) return model;
    auto parameters = model.parameters();
    parameters.options.derivatives = Derivatives::smooth;
    return Model(parameters);
  };
  if (options.basis_count == 0) {
    for (const Prepared<Demonstration>& aim : aims) {
      Model model = with_fewest_kernels<Model>(aim, stated, alone);
      if (count == 1) return noted(std::move(model));
      stated.basis_count = std::max(stated.basis_count, model.options().basis_count);
    }
  }
  return noted(fit(motions.data(), count, stated));
}

}  // namespace dmp::detail
