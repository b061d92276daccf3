#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/export.hpp>

#include <Eigen/Core>

namespace dmp {

/// How a cycle is looked for.
struct CycleOptions {
  /// s, 0 or more. Half the true period may pass for it where a motion is the same on its way there and back:
  /// state what it cannot be below.
  double minimum_period = 0.0;
  int harmonics = 8;  ///< of the cycle, 1 to 40
};

/// What was found of a rhythmic motion.
struct CycleReport {
  double period = 0.0;      ///< s, the mean of the cycles
  double begins = 0.0;      ///< s from the start of the recording: what lies before differs from what follows
  double ends = 0.0;        ///< s, likewise behind
  Eigen::VectorXd lengths;  ///< s, of each whole cycle
  double unexplained = 0.0;  ///< RMS that the cycle leaves of the motion about its middle, a share of it
};

/// One cycle of a recorded motion.
template <class Demonstrated>
struct Cycle {
  Demonstrated
      demonstration;  ///< 201 samples, the last one the first again: what Motion::rhythmic learns from
  CycleReport report;
};

/// Finds the period of a recording that repeats, the parts at its ends that do not, and the one cycle that
/// all of them are, each at its own tempo: people are not periodic. Autocorrelation, then least squares of
/// harmonics of a phase phi(t) that bends with the cycles (cubic B-spline, Gauss-Newton):
/// docs/formulation.md, "Rhythmic motions". Throws InvalidArgument, naming what is missing, for a recording
/// without a period, of fewer than two cycles, or options out of range.
DMP_EXPORT Cycle<Demonstration> find_cycle(const Demonstration& recording, const CycleOptions& options = {});
DMP_EXPORT Cycle<OrientationDemonstration> find_cycle(const OrientationDemonstration& recording,
                                                      const CycleOptions& options = {});
DMP_EXPORT Cycle<PoseDemonstration> find_cycle(const PoseDemonstration& recording,
                                               const CycleOptions& options = {});

}  // namespace dmp
