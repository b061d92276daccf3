#pragma once

#include <optional>
#include <vector>

#include "kinematics/path_tracker.hpp"
#include "kinematics/random.hpp"

namespace dmp::detail {

/// How large a Roadmap grows.
struct RoadmapSize {
  std::size_t layers = 60;
  int random = 60;         ///< joints tried at random in each layer
  std::size_t kept = 200;  ///< joints kept in each layer
  int ways = 100;          ///< ways through that are examined
};

/// Joints for a path by way of a layered graph: each layer holds many joints that meet one pose, an edge
/// joins two of neighbouring layers that are close, and the shortest way through is walked. (Descartes,
/// ROS-Industrial; edges are examined only when the shortest way uses them, as in the lazy PRM of Bohlin and
/// Kavraki, ICRA 2000.) It finds what tracking cannot: a null space that must be moved in time, so that a
/// later pose is met within the limits.
class Roadmap {
 public:
  /// `start`: the only joints of the first layer, if given. All arguments must outlive the roadmap.
  Roadmap(const ChainModel& model, const PathTracker& tracker, const TargetPath& path,
          const RoadmapSize& size, std::uint64_t random_seed, const std::optional<Joints>& start);

  /// Joints at every pose of the path; none if no way leads through.
  std::optional<Route> shortest();

 private:
  struct Node {
    Joints joints;
    double toll;                    ///< for standing near a limit
    double cost;                    ///< of the cheapest way here from the first layer
    std::size_t from;               ///< the node before it on that way
    std::vector<std::size_t> shut;  ///< nodes of the layer before from which no joints lead here
  };
  using Layer = std::vector<Node>;

  void add(std::size_t layer, const Joints& joints);
  void fill(std::size_t layer, Random& random);
  void spread(std::size_t from, std::size_t to);
  void relax(std::size_t first_layer);
  double length(const Node& a, const Node& b, const Joints& reach, double longest) const;
  std::vector<std::size_t> cheapest_way() const;
  std::size_t walk(const std::vector<std::size_t>& way, std::vector<Joints>& joints) const;
  bool lead(std::size_t layer, const Joints& a, const Joints& b, std::vector<Joints>& joints) const;

  const PathTracker& tracker_;
  const TargetPath& path_;
  RoadmapSize size_;
  JointRange range_;
  Joints weight_;                    ///< one over the speed of each joint
  std::vector<std::size_t> sample_;  ///< of each layer
  std::vector<Joints> reach_;        ///< of each layer: how far each joint can come from the layer before
  std::vector<Layer> layers_;
};

}  // namespace dmp::detail
