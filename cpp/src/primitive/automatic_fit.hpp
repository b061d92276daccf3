#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/dmp.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/product.hpp>

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

/// Where one part has noise, no other need be closer to its extent than that one can be.
void share_noise(std::vector<Closeness>& parts);

/// A demonstration as it is learned, and how closely.
template <class Demonstration>
struct Prepared {
  Demonstration motion;
  std::vector<Closeness> parts;
};
Prepared<Demonstration> prepared(const Demonstration& given, Derivatives derivatives);
Prepared<OrientationDemonstration> prepared(const OrientationDemonstration& given, Derivatives derivatives);
Prepared<PoseDemonstration> prepared(const PoseDemonstration& given, Derivatives derivatives);

template <class A, class B>
Prepared<ProductDemonstration<A, B>> prepared(const ProductDemonstration<A, B>& given,
                                              Derivatives derivatives) {
  auto first = prepared(given.first(), derivatives);
  auto second = prepared(given.second(), derivatives);
  std::vector<Closeness> parts = first.parts;
  parts.insert(parts.end(), second.parts.begin(), second.parts.end());
  share_noise(parts);
  return {{std::move(first.motion), std::move(second.motion)}, parts};
}

/// At most so many of the samples of a demonstration, the first and the last among them, and their times.
std::vector<Eigen::Index> some(Eigen::Index count);
Eigen::VectorXd times_at(const Eigen::VectorXd& time, const std::vector<Eigen::Index>& chosen);

/// Appends by how much a trajectory at the chosen samples' times misses each part of a demonstration, RMS.
void add_misses(std::vector<double>& misses, const Demonstration& motion,
                const std::vector<Eigen::Index>& chosen, const Trajectory& again);
void add_misses(std::vector<double>& misses, const OrientationDemonstration& motion,
                const std::vector<Eigen::Index>& chosen, const OrientationTrajectory& again);
void add_misses(std::vector<double>& misses, const PoseDemonstration& motion,
                const std::vector<Eigen::Index>& chosen, const PoseTrajectory& again);
template <class A, class B>
void add_misses(std::vector<double>& misses, const ProductDemonstration<A, B>& motion,
                const std::vector<Eigen::Index>& chosen, const ProductTrajectory<A, B>& again) {
  add_misses(misses, motion.first(), chosen, again.first);
  add_misses(misses, motion.second(), chosen, again.second);
}

/// By how many times its tolerance a model misses the part of its demonstration that it misses most.
template <class Model, class Demonstration>
double miss(const Model& model, const Prepared<Demonstration>& aim) {
  const std::vector<Eigen::Index> chosen = some(aim.motion.size());
  std::vector<double> misses;
  add_misses(misses, aim.motion, chosen, model.rollout_at(times_at(aim.motion.time(), chosen)));
  double worst = 0.0;
  for (std::size_t i = 0; i < misses.size(); ++i) worst = std::max(worst, misses[i] / aim.parts[i].tolerance);
  return worst;
}

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

/// Learns with what DmpOptions leave to the demonstrations. `fit(demonstrations, options)` learns with
/// options that leave nothing open.
template <class Model, class Demonstration, class Fit>
Model fit_automatically(const std::vector<const Demonstration*>& demonstrations, const DmpOptions& options,
                        Fit fit) {
  std::vector<Prepared<Demonstration>> aims;
  std::vector<const Demonstration*> motions;
  DmpOptions stated = with_regression(options);
  bool smoothed = false;
  for (const Demonstration* demonstration : demonstrations) {
    aims.push_back(prepared(*demonstration, options.derivatives));
    for (const Closeness& part : aims.back().parts) smoothed = smoothed || part.smoothed;
  }
  for (const Prepared<Demonstration>& aim : aims) motions.push_back(&aim.motion);
  const bool chosen = options.derivatives == Derivatives::automatic;
  if (chosen) stated.derivatives = Derivatives::interpolate;
  const auto alone = [&](const Demonstration& one, const DmpOptions& with) {
    return fit(std::vector<const Demonstration*>{&one}, with);
  };
  const auto noted = [&](Model model) {
    if (!chosen || !smoothed) return model;
    auto parameters = model.parameters();
    parameters.options.derivatives = Derivatives::smooth;
    return Model(parameters);
  };
  if (options.basis_count == 0) {
    for (const Prepared<Demonstration>& aim : aims) {
      Model model = with_fewest_kernels<Model>(aim, stated, alone);
      if (aims.size() == 1) return noted(std::move(model));
      stated.basis_count = std::max(stated.basis_count, model.options().basis_count);
    }
  }
  return noted(fit(motions, stated));
}

}  // namespace dmp::detail
