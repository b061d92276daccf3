#pragma once

#include <dmp/cycle.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// A recording as its cycle is looked for: values (n x d) at even times, s.
struct Signal {
  Eigen::VectorXd time;
  RowMatrix value;
};

/// The phase of each sample of the part that repeats, in cycles from 0.
struct PhaseTrack {
  Signal signal;  ///< of that part
  Eigen::VectorXd phase;
  CycleReport report;
};

/// Throws InvalidArgument where there is no period.
PhaseTrack track_phase(const Signal& signal, const CycleOptions& options);

/// 1 and `harmonics` pairs of cosine and sine of phases (n), (n x 1 + 2 harmonics).
Eigen::MatrixXd harmonics_of(const Eigen::VectorXd& phase, int harmonics);

/// Coefficients of least squares, (columns of `basis` x d).
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& basis, const RowMatrix& value);

/// When a phase that grows with the times has come to `wanted` (between two samples: a straight line).
double time_at(const Eigen::VectorXd& time, const Eigen::VectorXd& phase, double wanted);

}  // namespace dmp::detail
