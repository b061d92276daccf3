#pragma once

#include <dmp/noise.hpp>
#include <dmp/spline.hpp>

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "spline/smoothing_fit.hpp"

namespace dmp::detail {

/// 1 for samples that were measured, 0 for those that were not (`measured`, all if empty) or that repeat the
/// one before, unless that is usual: a recording system that had nothing new.
Eigen::VectorXd measured_weights(const Eigen::VectorXd& measured, Eigen::Index count,
                                 const std::function<bool(Eigen::Index)>& repeats);

/// The smoothing grid of a demonstration, made when it is needed.
class LazyGrid {
 public:
  LazyGrid(const Eigen::VectorXd& times, Eigen::VectorXd weights)
      : times_(times), weights_(std::move(weights)) {}
  const Eigen::VectorXd& times() const noexcept { return times_; }
  const Eigen::VectorXd& weights() const noexcept { return weights_; }
  SmoothingGrid& get();

 private:
  Eigen::VectorXd times_;
  Eigen::VectorXd weights_;
  std::optional<SmoothingGrid> grid_;
};

struct Denoised {
  NoiseEstimate estimate;
  std::optional<SmoothingFit::Curve> curve;  // where there is noise
};

/// Whether values (T x d) carry noise; `axes` of their columns are free (3 of a quaternion's 4), `through` is
/// the spline through them.
Denoised denoise(LazyGrid& grid, const RowMatrix& values, int axes, const Spline& through);

}  // namespace dmp::detail
