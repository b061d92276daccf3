#include <dmp/error.hpp>

#include <algorithm>
#include <optional>
#include <vector>

#include "motion/continuous_quaternions.hpp"
#include "primitive/cycle.hpp"
#include "primitive/forcing_scale.hpp"
#include "primitive/learning.hpp"
#include "primitive/space.hpp"
#include "primitive/turning_reference.hpp"

// Which equation of motion rotations are learned in, where the options leave it open, and what the turning
// form turns along with.

namespace dmp::detail {

using Eigen::VectorXd;
using RotationGeometry = Geometry<RotationSpace>;

namespace {

// Beyond this the spring of the UDE form grows weak and then pushes away across the axis, and the logarithm
// about the goal turns quickly near 2 pi.
constexpr double kNear = 2.0;
constexpr double kNearIfScaled = 3.0;

OrientationForm without_reference(double largest_log, const DmpOptions& options) {
  const bool far = options.log_branch == LogBranch::lifted && largest_log > kNearIfScaled;
  return far ? OrientationForm::log_linear : OrientationForm::ude;
}

std::optional<TurningReference> reference_along(const Demonstrations<RotationSpace>& together) {
  std::vector<VectorXd> phases;
  std::vector<RowMatrix> tables;
  for (const OrientationDemonstration* one : together) {
    phases.push_back(one->time() / one->duration());
    tables.push_back(continuous_quaternions(one->rotation()));
    if (tables.back().row(0).dot(tables.front().row(0)) < 0.0) tables.back() *= -1.0;
  }
  return TurningReference::along(phases, tables);
}

double largest_log_of(const Demonstrations<RotationSpace>& together, const DmpOptions& options) {
  double largest = 0.0;
  for (const OrientationDemonstration* one : together)
    largest = std::max(largest, RotationGeometry::largest_log(*one, options));
  return largest;
}

Decision decide_automatically(const DmpOptions& options, const Demonstrations<RotationSpace>& together,
                              bool may_turn) {
  Decision decision{options, {}};
  const double largest = largest_log_of(together, options);
  const bool can_turn = may_turn && options.log_branch == LogBranch::lifted && !multiplies(options.scaling);
  std::optional<TurningReference> reference;
  if (can_turn && largest > kNear) reference = reference_along(together);
  if (reference) decision.reference = reference->coefficients();
  decision.options.orientation_form =
      reference ? OrientationForm::turning : without_reference(largest, options);
  return decision;
}

/// About the rotation that a rhythmic motion goes round: of its first demonstration.
Decision decide_round(DmpOptions options, const Demonstrations<RotationSpace>& together, bool may_turn) {
  if (!may_turn)
    throw InvalidArgument(
        "options.motion: rhythmic, expected discrete for motions of more than one rotation.");
  const OrientationDemonstration& cycle = *together.front();
  require_closed(cycle);
  options.orientation_form = OrientationForm::turning;
  const OrientationTrajectory round = round_of(cycle, cycle_samples(cycle.size(), options));
  return {options, TurningReference::round(round.rotation).coefficients()};
}

}  // namespace

Decision RotationGeometry::decide(const DmpOptions& options, const Demonstrations<RotationSpace>& together,
                                  bool may_turn) {
  if (options.motion == Motion::rhythmic) return decide_round(options, together, may_turn);
  if (options.orientation_form == OrientationForm::automatic)
    return decide_automatically(options, together, may_turn);
  if (options.orientation_form != OrientationForm::turning) return {options, {}};
  if (!may_turn)
    throw InvalidArgument(
        "options.orientation_form: turning, expected automatic, ude or log_linear for motions of more than "
        "one "
        "rotation.");
  const std::optional<TurningReference> reference = reference_along(together);
  if (!reference)
    throw InvalidArgument(
        "demonstrations: turn too fast, or too differently, for one rotation to turn along with them. Use "
        "OrientationForm::log_linear, or learn them apart.");
  return {options, reference->coefficients()};
}

DmpOptions RotationGeometry::settle(const DmpOptions& given, const Ends<RotationSpace>& ends) {
  DmpOptions options = given;
  const bool turns = ends.reference.rows() > 0;
  if (options.orientation_form == OrientationForm::automatic)
    options.orientation_form =
        turns ? OrientationForm::turning : without_reference(ends.displacement.norm(), options);
  if (turns != (options.orientation_form == OrientationForm::turning))
    throw InvalidArgument(turns
                              ? "reference: given, expected none unless options.orientation_form is turning."
                              : "reference: none, expected one for options.orientation_form turning.");
  if (turns) TurningReference{ends.reference};
  options.validate();  // turning, where it was just chosen, cannot be scaled by (goal - start)
  return options;
}

}  // namespace dmp::detail
