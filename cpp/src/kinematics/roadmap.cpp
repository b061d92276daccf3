#include "kinematics/roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmp::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double longest_edge = 0.7;     // rad or m of any joint
constexpr double rounding = 1e-6;        // rad or m
constexpr double same_joints = 0.03;     // rad or m: closer than that, one of two is enough
constexpr double near_a_limit = 0.1;     // rad or m
constexpr double usual_speed = 2.0;      // rad/s, of a joint without a velocity limit
constexpr double jerk_allowance = 0.02;  // rad, by which a step may exceed three times its share of the edge

Joints weights(const ChainModel& model) {
  Joints weight(model.velocity_limit.size());
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    weight[i] = 1.0 / (std::isfinite(model.velocity_limit[i]) ? model.velocity_limit[i] : usual_speed);
  return weight;
}

std::vector<std::size_t> evenly(std::size_t count, std::size_t layers) {
  const std::size_t used = std::min(count, layers);
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < used; ++i) samples.push_back(used == 1 ? 0 : i * (count - 1) / (used - 1));
  return samples;
}

// The way that the steps of a path allow from one sample to another; longer than `longest_edge` counts for no
// edge.
Joints reach_between(const TargetPath& path, std::size_t first, std::size_t last) {
  Joints reach = Joints::Constant(path.step.front().size(), rounding);
  for (std::size_t k = first; k < last; ++k) reach += path.step[k];
  return reach.cwiseMin(longest_edge);
}

}  // namespace

Roadmap::Roadmap(const ChainModel& model, const PathTracker& tracker, const TargetPath& path,
                 const RoadmapSize& size, std::uint64_t random_seed, const std::optional<Joints>& start)
    : tracker_(tracker),
      path_(path),
      size_(size),
      range_(model),
      weight_(weights(model)),
      sample_(evenly(path.target.size(), size.layers)),
      layers_(sample_.size()) {
  for (std::size_t k = 0; k < sample_.size(); ++k)
    reach_.push_back(reach_between(path, sample_[k > 0 ? k - 1 : 0], sample_[k]));
  Random random(random_seed);
  if (start) add(0, *start);
  for (std::size_t k = start ? 1 : 0; k < layers_.size(); ++k) {
    fill(k, random);
    if (k > 0) spread(k - 1, k);
    if (layers_[k].empty()) return;  // no way leads through
  }
  for (std::size_t k = layers_.size() - 1; k > (start ? 1u : 0u); --k) spread(k, k - 1);
}

void Roadmap::add(std::size_t layer, const Joints& joints) {
  Layer& nodes = layers_[layer];
  const auto is_same = [&](const Node& node) {
    return (node.joints - joints).cwiseAbs().maxCoeff() < same_joints;
  };
  if (nodes.size() >= size_.kept || std::any_of(nodes.begin(), nodes.end(), is_same)) return;
  const double shortfall = std::max(1.0 - range_.margin(joints) / near_a_limit, 0.0);
  nodes.push_back({joints, near_a_limit * near_a_limit * shortfall * shortfall, infinity, 0, {}});
}

void Roadmap::fill(std::size_t layer, Random& random) {
  const FiniteRange sampled(range_.lower, range_.upper, range_.middle());
  for (int i = 0; i < size_.random; ++i) {
    const Joints near = random.between(sampled.lower, sampled.upper);
    const auto joints = tracker_.meet(path_.target[sample_[layer]], near, range_.lower, range_.upper);
    if (joints) add(layer, *joints);
  }
}

// Every node of a layer is carried to the pose of the next one.
void Roadmap::spread(std::size_t from, std::size_t to) {
  for (const Node& node : layers_[from]) {
    const auto joints = tracker_.meet(path_.target[sample_[to]], node.joints, range_.lower, range_.upper);
    if (joints) add(to, *joints);
  }
}

// Squared, so that many small steps are shorter than few large ones; infinity if a joint would have to go
// further than its reach, or the edge is beyond `longest` anyway.
double Roadmap::length(const Node& a, const Node& b, const Joints& reach, double longest) const {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < a.joints.size() && sum < longest; ++i) {
    const double step = std::abs(b.joints[i] - a.joints[i]);
    if (step > reach[i]) return infinity;
    sum += step * step * weight_[i] * weight_[i];
  }
  return sum;
}

void Roadmap::relax(std::size_t first_layer) {
  for (std::size_t k = first_layer; k < layers_.size(); ++k)
    for (Node& node : layers_[k]) {
      node.cost = k == 0 ? node.toll : infinity;
      for (std::size_t i = 0; k > 0 && i < layers_[k - 1].size(); ++i) {
        const Node& before = layers_[k - 1][i];
        const double known = before.cost + node.toll;
        if (known >= node.cost) continue;
        const double cost = known + length(before, node, reach_[k], node.cost - known);
        if (cost >= node.cost || std::find(node.shut.begin(), node.shut.end(), i) != node.shut.end())
          continue;
        node.cost = cost;
        node.from = i;
      }
    }
}

// The node of each layer; empty if no way leads through.
std::vector<std::size_t> Roadmap::cheapest_way() const {
  const Layer& last = layers_.back();
  const auto end = std::min_element(last.begin(), last.end(),
                                    [](const Node& a, const Node& b) { return a.cost < b.cost; });
  if (end == last.end() || end->cost == infinity) return {};
  std::vector<std::size_t> way(layers_.size());
  way.back() = static_cast<std::size_t>(end - last.begin());
  for (std::size_t k = layers_.size() - 1; k > 0; --k) way[k - 1] = layers_[k][way[k]].from;
  return way;
}

// Joints at the samples between two layers, close to the straight line from a to b; false if they tear.
bool Roadmap::lead(std::size_t layer, const Joints& a, const Joints& b, std::vector<Joints>& joints) const {
  const std::size_t first = sample_[layer - 1], last = sample_[layer];
  const double parts = static_cast<double>(last - first);
  const double stride = 3.0 * (b - a).cwiseAbs().maxCoeff() / parts + jerk_allowance;
  joints[first] = a;
  for (std::size_t k = first + 1; k <= last; ++k) {
    const Joints& before = joints[k - 1];
    const Joints step = path_.step[k - 1].cwiseMin(stride);
    const Joints lower = range_.lower.cwiseMax(before - step), upper = range_.upper.cwiseMin(before + step);
    const Joints line = a + (b - a) * (static_cast<double>(k - first) / parts);
    const auto met = tracker_.meet(path_.target[k], line.cwiseMax(lower).cwiseMin(upper), lower, upper);
    if (!met) return false;
    joints[k] = *met;
  }
  return (joints[last] - b).cwiseAbs().maxCoeff() < rounding;
}

// Fills in the joints along the way; the layer at which it is barred, or the number of layers.
std::size_t Roadmap::walk(const std::vector<std::size_t>& way, std::vector<Joints>& joints) const {
  joints[0] = layers_[0][way[0]].joints;
  for (std::size_t k = 1; k < layers_.size(); ++k)
    if (!lead(k, layers_[k - 1][way[k - 1]].joints, layers_[k][way[k]].joints, joints)) return k;
  return layers_.size();
}

std::optional<Route> Roadmap::shortest() {
  Route route;
  route.joints.resize(path_.target.size());
  std::size_t changed = 0;
  for (int i = 0; i < size_.ways; ++i) {
    relax(changed);
    const std::vector<std::size_t> way = cheapest_way();
    if (way.empty()) return std::nullopt;
    changed = walk(way, route.joints);
    if (changed == layers_.size()) {
      tracker_.rate(path_, route);
      return route;
    }
    layers_[changed][way[changed]].shut.push_back(way[changed - 1]);
  }
  return std::nullopt;
}

}  // namespace dmp::detail
