#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// The normal equations of a chain of unknowns, of which only near ones meet, and a few that meet all:
///
///     [ A   E ] [ x ]   [ g ]
///     [ E^T D ] [ y ] = [ h ]        A: band matrix, symmetric; E: border; D: corner, symmetric
class BorderedBand {
 public:
  /// `count` unknowns x, each of which meets the `below` next ones; `border` unknowns y.
  BorderedBand(Eigen::Index count, Eigen::Index below, Eigen::Index border);

  void set_zero();
  /// Element (row, column) of A, column <= row <= column + below.
  double& at(Eigen::Index row, Eigen::Index column) { return band(column, row - column); }
  RowMatrix band;             ///< (count x below + 1): element (j, k) is A(j + k, j)
  RowMatrix edge;             ///< (count x border) E
  Eigen::MatrixXd corner;     ///< (border x border) D
  Eigen::VectorXd right;      ///< (count) g
  Eigen::VectorXd right_end;  ///< (border) h

  /// Solves with A_ii and D_ii increased by `damping` times themselves (Marquardt): x into `step`, y into
  /// `step_end`. False if that matrix is not positive definite.
  bool solve(double damping, Eigen::VectorXd& step, Eigen::VectorXd& step_end);

 private:
  bool factorise(double damping);

  RowMatrix factor_;  // of A, as `band`; column 0 holds 1 / L(j, j)
  RowMatrix sides_;   // (count + below x border + 1): E and g, forward substituted
};

}  // namespace dmp::detail
