#pragma once

#include <dmp/export.hpp>

#include <string>

namespace dmp {

/// none: the samples are learned as they are. white: each sample has an error of its own. coloured: the error
/// wanders, as that of a tracker; it can be told from the motion only where the recording holds a rest.
enum class NoiseKind { none, white, coloured };

/// Whether samples carry noise that can be taken out without taking part of the motion, and the evidence.
///
/// The evidence comes from quintic smoothing splines (penalty on the third derivative) of the samples that
/// were measured; lambda by generalised cross-validation (Craven and Wahba 1979). White noise is taken out if
/// all four hold: freedom <= 0.5; flatness <= 1.55; evenness >= 0.5, or correlation <= 0.1 at a freedom of at
/// most 0.35; sharpness >= 1.25.
struct DMP_EXPORT NoiseEstimate {
  NoiseKind kind = NoiseKind::none;
  double sigma = 0.0;  ///< standard deviation along one axis, unit of the samples or rad; 0 if there is none
  double removed = 0.0;  ///< root of the mean square that smoothing takes out, all axes together
  double cutoff = 0.0;   ///< Hz, where the smoothing leaves half the power; 0 if there is none
  /// RMS by which a sample differs from what its six neighbours predict, all axes together: what even the
  /// best model cannot know between the samples.
  double unpredicted = 0.0;
  double freedom = 1.0;  ///< degrees of freedom of the smoothed motion over the samples that were measured
  double flatness =
      0.0;  ///< sqrt(V(.6) / V(.8)), V(e) the variance left by a fit of freedom e; 1.2 for noise
  double evenness = 0.0;     ///< residual where the motion is calm over that where it is busy; 1 for noise
  double correlation = 0.0;  ///< of neighbouring residuals where it is busy; below 0 for noise
  double sharpness =
      1.0;               ///< largest acceleration of the samples as they are over that of the smoothed motion
  double resting = 0.0;  ///< speed where the motion is busy over that where it is calm; a rest makes it large
  int measured = 0;      ///< samples that were measured: neither filled in nor held by the recording system

  bool found() const noexcept { return kind != NoiseKind::none; }
};

}  // namespace dmp
