#include "kinematics/joint_range.hpp"

#include <algorithm>
#include <cmath>

namespace dmp::detail {
namespace {
constexpr double pi = 3.14159265358979323846;
constexpr double widest =
    1e3;  // rad or m, from where on a range is none: exporters write 1e16 for "no limit"

bool is_bounded(double lower, double upper) { return upper - lower < widest; }
}  // namespace

JointRange::JointRange(const ChainModel& model)
    : lower(model.lower), upper(model.upper), turns(static_cast<std::size_t>(model.lower.size()), true) {
  std::size_t link = 0;
  for (const KDL::Segment& segment : model.chain.segments) {
    if (segment.getJoint().getType() == KDL::Joint::Fixed) continue;
    const Coupling& coupling = model.couplings[link++];
    const bool whole = coupling.multiplier == std::round(coupling.multiplier);
    if (segment.getJoint().getType() == KDL::Joint::TransZ || !whole)
      turns[static_cast<std::size_t>(coupling.joint)] = false;
  }
}

Joints JointRange::middle() const {
  Joints q(lower.size());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = is_bounded(lower[i], upper[i]) ? 0.5 * (lower[i] + upper[i]) : std::clamp(0.0, lower[i], upper[i]);
  return q;
}

double JointRange::margin(const Joints& q) const {
  return std::min((q - lower).minCoeff(), (upper - q).minCoeff());
}

Joints JointRange::nearest_winding(Joints q, const Joints& seed, const Joints& lowest,
                                   const Joints& highest) const {
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    if (!turns[static_cast<std::size_t>(i)]) continue;
    double winding = std::round((seed[i] - q[i]) / (2.0 * pi));
    winding = std::max(winding, std::ceil((lowest[i] - q[i]) / (2.0 * pi)));
    winding = std::min(winding, std::floor((highest[i] - q[i]) / (2.0 * pi)));
    if (q[i] + 2.0 * pi * winding >= lowest[i]) q[i] += 2.0 * pi * winding;
  }
  return q;
}

void JointRange::wind_to_middle(std::vector<Joints>& path) const {
  if (path.empty()) return;
  Joints least = path.front(), most = path.front();
  for (const Joints& q : path) {
    least = least.cwiseMin(q);
    most = most.cwiseMax(q);
  }
  const Joints centre = 0.5 * (least + most);
  const Joints shift = nearest_winding(centre, middle(), lower + (centre - least), upper - (most - centre));
  if (shift == centre) return;
  for (Joints& q : path) q += shift - centre;
}

FiniteRange::FiniteRange(const Joints& lowest, const Joints& highest, const Joints& center)
    : lower(lowest), upper(highest) {
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (is_bounded(lower[i], upper[i])) continue;
    const double middle = std::clamp(center[i], lower[i], upper[i]);
    lower[i] = std::max(lower[i], middle - pi);
    upper[i] = std::min(upper[i], middle + pi);
  }
}

}  // namespace dmp::detail
