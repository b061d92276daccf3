#include "kinematics/ik_search.hpp"

#include <algorithm>

#include "kinematics/random.hpp"

namespace dmp::detail {
namespace {
constexpr std::size_t carried_on = 24;
}

IkSearch::IkSearch(const ChainModel& model, const IkOptions& options)
    : tolerances_{
          options.position_tolerance, options.angle_tolerance, {options.weight, options.angle_weight}},
      iteration_limit_(options.iteration_limit),
      random_seed_(options.random_seed),
      range_(model),
      lm_(model, tolerances_, options.iteration_limit),
      forward_(model),
      kdl_(options.backend == IkBackend::bounded_lm ? nullptr
                                                    : std::make_unique<KdlBackend>(model, options)) {}

void IkSearch::measure(const Frame& target, Found& found) {
  const Vector6 error = tolerances_.goal.error(target, forward_(found.joints));
  found.position_error = error.head<3>().norm();
  found.angle_error = error.tail<3>().norm();
  found.distance = tolerances_.goal.distance(target, error);
  found.ok = found.position_error <= tolerances_.position && found.angle_error <= tolerances_.angle;
}

IkResult IkSearch::result(const Frame& target, const Joints& joints, int iterations) {
  Found found;
  found.joints = joints;
  measure(target, found);
  IkResult result;
  result.joints = joints;
  result.status = found.ok ? IkStatus::ok : IkStatus::out_of_reach;
  result.position_error = found.position_error;
  result.angle_error = found.angle_error;
  result.iterations = iterations;
  result.limit_margin = range_.margin(joints);
  return result;
}

Found IkSearch::attempt(const Frame& target, const Joints& start, const Joints& lower, const Joints& upper,
                        int iterations, bool by_kdl) {
  Found found;
  if (by_kdl) {
    found.iterations = kdl_->descend(target, start, lower, upper, found.joints);
    found.stalled = 1;
  } else {
    const Descent end = lm_.descend(target, start, lower, upper, iterations);
    found.joints = end.joints;
    found.iterations = end.iterations;
    found.stalled = end.stalled ? 1 : 0;
  }
  measure(target, found);
  return found;
}

// What squares rank second may be first by distance: the best few descents are carried on to the closest
// joints.
Found IkSearch::closest(const Frame& target, const Joints& lower, const Joints& upper,
                        std::vector<Found> ends) {
  const std::size_t kept = std::min(carried_on, ends.size());
  const auto nearer = [](const Found& a, const Found& b) { return a.distance < b.distance; };
  std::partial_sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(kept), ends.end(), nearer);
  for (std::size_t i = 0; i < kept; ++i) {
    ends[i].joints = lm_.closest(target, ends[i].joints, lower, upper);
    measure(target, ends[i]);
  }
  return *std::min_element(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(kept), nearer);
}

Found IkSearch::search(const Frame& target, const Joints& seed, const Joints& lower, const Joints& upper,
                       bool by_kdl) {
  const FiniteRange sampled(lower, upper, seed);
  Random random(random_seed_);
  std::vector<Found> ends;
  Joints start = seed;
  int iterations = 0, stalled = 0;
  do {
    ends.push_back(attempt(target, start, lower, upper, iteration_limit_ - iterations, by_kdl));
    iterations += std::max(ends.back().iterations, 1);
    stalled += ends.back().stalled;
    start = random.between(sampled.lower, sampled.upper);
  } while (!ends.back().ok && iterations < iteration_limit_);
  Found best = ends.back().ok || stalled == 0 ? ends.back() : closest(target, lower, upper, std::move(ends));
  best.joints = range_.nearest_winding(best.joints, seed, lower, upper);
  measure(target, best);
  best.iterations = iterations;
  best.stalled = stalled;
  return best;
}

Found IkSearch::find(const Frame& target, const Joints& seed, const Joints& lower, const Joints& upper) {
  return search(target, seed, lower, upper, kdl_ != nullptr);
}

Found IkSearch::find_beyond_limits(const Frame& target, const Joints& seed) {
  const Joints none = Joints::Constant(seed.size(), std::numeric_limits<double>::infinity());
  return search(target, seed, -none, none, false);
}

}  // namespace dmp::detail
