#include "kinematics/route_search.hpp"

#include <algorithm>
#include <array>

#include "kinematics/calming.hpp"
#include "kinematics/random.hpp"
#include "kinematics/roadmap.hpp"

namespace dmp::detail {
namespace {

constexpr std::size_t thinned_size = 100;
constexpr std::size_t refined = 4;  // routes of the thinned path that are tracked through every pose
constexpr int iterations_for_a_start = 60;
constexpr double same_posture = 1e-3;  // rad or m

// Every stride-th sample and the last one.
std::vector<std::size_t> thinned_samples(std::size_t count) {
  const std::size_t stride = std::max<std::size_t>(1, count / thinned_size);
  std::vector<std::size_t> samples;
  for (std::size_t k = 0; k + 1 < count; k += stride) samples.push_back(k);
  samples.push_back(count - 1);
  return samples;
}

TargetPath pick(const TargetPath& path, const std::vector<std::size_t>& samples) {
  TargetPath result;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    Joints step = Joints::Zero(path.step.front().size());
    for (std::size_t k = samples[i]; i + 1 < samples.size() && k < samples[i + 1]; ++k) step += path.step[k];
    result.time.push_back(path.time[samples[i]]);
    result.target.push_back(path.target[samples[i]]);
    result.step.push_back(step);
  }
  return result;
}

bool contains(const std::vector<Joints>& postures, const Joints& q) {
  return std::any_of(postures.begin(), postures.end(),
                     [&](const Joints& other) { return (other - q).cwiseAbs().maxCoeff() < same_posture; });
}

}  // namespace

RouteSearch::RouteSearch(const ChainModel& model, const Tolerances& tolerances, const FollowOptions& options,
                         std::uint64_t random_seed)
    : options_(options),
      random_seed_(random_seed),
      model_(model),
      range_(model),
      lm_(model, tolerances, iterations_for_a_start),
      tracker_(model, tolerances) {}

// Only a redundant arm has a null space to move in.
std::vector<double> RouteSearch::pulls() const {
  if (tracker_.has_null_space()) return {0.0, 1.0, 4.0};
  return {0.0};
}

// Different joints that meet the target; the closest ones if none do.
std::vector<Joints> RouteSearch::starts(const Frame& target) {
  const FiniteRange sampled(range_.lower, range_.upper, range_.middle());
  Random random(random_seed_);
  std::vector<Joints> found;
  Descent closest;
  Joints start = range_.middle();
  for (int i = 0; i < options_.starts; ++i) {
    const Descent end = lm_.descend(target, start, range_.lower, range_.upper, iterations_for_a_start);
    if (end.converged && !contains(found, end.joints)) found.push_back(end.joints);
    if (i == 0 || end.error.squaredNorm() < closest.error.squaredNorm()) closest = end;
    start = random.between(sampled.lower, sampled.upper);
  }
  if (found.empty()) found.push_back(closest.joints);
  return found;
}

std::vector<RouteSearch::Candidate> RouteSearch::candidates(const TargetPath& path) {
  std::vector<Candidate> all;
  const auto anchors = static_cast<std::size_t>(options_.anchors);
  const std::size_t last = path.target.size() - 1;
  for (std::size_t a = 0; a < anchors && a <= last; ++a) {
    const std::size_t anchor = anchors == 1 ? last / 2 : a * last / (anchors - 1);
    for (const Joints& start : starts(path.target[anchor]))
      for (const double pull : pulls())
        all.push_back({tracker_.track(path, anchor, start, pull), anchor, pull});
  }
  routes_tried_ += static_cast<int>(all.size());
  return all;
}

// The pulls, the one that does best on the thinned path first.
std::vector<double> RouteSearch::ranked_pulls(const TargetPath& path, const Joints& start) const {
  const std::vector<double> all = pulls();
  if (all.size() < 2) return all;
  const TargetPath thinned = pick(path, thinned_samples(path.target.size()));
  std::vector<std::pair<Route, double>> ranking;
  for (const double pull : all) ranking.emplace_back(tracker_.track_from(thinned, start, pull), pull);
  std::stable_sort(ranking.begin(), ranking.end(),
                   [](const auto& a, const auto& b) { return a.first.better_than(b.first); });
  std::vector<double> order;
  for (const auto& [route, pull] : ranking) order.push_back(pull);
  return order;
}

Route RouteSearch::from_start(const TargetPath& path, const Joints& start) {
  Route best;
  for (const double pull : ranked_pulls(path, start)) {
    Route route = tracker_.track_from(path, start, pull);
    if (routes_tried_++ == 0 || route.better_than(best)) best = std::move(route);
    if (best.complete()) break;
  }
  return best;
}

// The best routes of the thinned path, tracked through every pose.
Route RouteSearch::from_anchors(const TargetPath& path) {
  const std::vector<std::size_t> samples = thinned_samples(path.target.size());
  std::vector<Candidate> all = candidates(pick(path, samples));
  const bool is_whole = samples.size() == path.target.size();
  const std::size_t kept = is_whole ? 1 : std::min(refined, all.size());
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end(),
                    [](const Candidate& a, const Candidate& b) { return a.route.better_than(b.route); });
  if (is_whole) return std::move(all.front().route);
  Route best;
  for (std::size_t i = 0; i < kept; ++i) {
    Route route =
        tracker_.track(path, samples[all[i].anchor], all[i].route.joints[all[i].anchor], all[i].pull);
    if (i == 0 || route.better_than(best)) best = std::move(route);
  }
  return best;
}

// Small roadmaps find most ways; some ways are narrow. A given start stays as close to the first pose as it
// came.
void RouteSearch::by_roadmap(const TargetPath& path, Route& best) const {
  constexpr std::array<RoadmapSize, 3> sizes = {
      {{60, 60, 200, 100}, {60, 200, 500, 300}, {200, 100, 200, 300}}};
  std::optional<Joints> start;
  if (options_.start) start = best.joints.front();
  if (start && !tracker_.meets(path.target.front(), *start)) return;
  for (const RoadmapSize& size : sizes) {
    const auto route = Roadmap(model_, tracker_, path, size, random_seed_, start).shortest();
    if (!route) continue;
    if (route->better_than(best)) best = *route;
    return;
  }
}

void RouteSearch::calm(const TargetPath& path, Route& best) const {
  const auto route = calmed(model_, tracker_, path, best);
  if (route && route->better_than(best)) best = *route;
}

Route RouteSearch::best(const TargetPath& path) {
  Route best = options_.start ? from_start(path, Joints(*options_.start)) : from_anchors(path);
  if (!options_.thorough) return best;
  if (!best.complete()) by_roadmap(path, best);
  if (!options_.start && best.complete()) calm(path, best);
  return best;
}

}  // namespace dmp::detail
