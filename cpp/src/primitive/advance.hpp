#pragma once

#include <dmp/trajectory.hpp>

#include <Eigen/Core>

namespace dmp::detail {

/// Of a spring and damper.
struct Gains {
  double alpha;
  double beta;
};

/// The forcing term (K x 1) that takes a spring and damper from 0 to the goal 1 as a motion advances:
///   sigma' ~ w^2 / sqrt(w^2 + eps^2 mean(w^2)),  w^2 = (v . D)^2 / |D|^2 + rho^2 |v|^2,
/// with its velocity v and its way D from start to goal, or the speed alone for w where it ends near its
/// start: at rest where the motion rests, and on a straight reach its own course. It begins at rest within
/// the first samples of a motion that is recorded on the way, as a run does. A motion that stands still
/// advances as one of minimum jerk. s (K): phases, increasing; velocity (K x d) in any unit; way (d), and
/// range (d) that the motion covers, in one unit. docs/formulation.md, "New starts and goals".
RowMatrix advance_along(const Eigen::VectorXd& s, const RowMatrix& velocity, const Eigen::VectorXd& way,
                        const Eigen::VectorXd& range, const Gains& gains);

}  // namespace dmp::detail
