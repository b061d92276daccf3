#include "robot/arm_tree.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

namespace dmp::detail {
namespace {

using Joints = std::vector<const urdf::Joint*>;

constexpr double longest_finger_stroke = 0.12;  // m; an arm's slide is longer
constexpr double longest_finger_share = 0.35;   // of the way before the hand

bool named(const std::string& name, const char* pattern) {
  return std::regex_search(name, std::regex(pattern, std::regex::icase));
}

// The words of grippers in the names of joints, and those that a link has only if it belongs to one.
constexpr const char* gripper_joint = "finger|jaw|gripper|knuckle|thumb|claw|hand_|pinky|index|middle|ring_";
constexpr const char* gripper_link = "finger|jaw|gripper|knuckle|thumb|claw";

double length(const urdf::Vector3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

bool is_short_slide(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::PRISMATIC && joint.limits &&
         joint.limits->upper - joint.limits->lower <= longest_finger_stroke;
}

// A joint from one part of a gripper to another: "gripper-static" to "gripper-moving", "gripper" to "jaw".
bool is_named_gripper(const urdf::Joint& joint) {
  return named(joint.name, gripper_joint) ||
         (named(joint.parent_link_name, gripper_link) && named(joint.child_link_name, gripper_link));
}

class Tree {
 public:
  explicit Tree(const urdf::ModelInterface& model) : model_(model) {
    for (const auto& entry : model.joints_)
      if (entry.second->mimic) masters_.insert(entry.second->mimic->joint_name);
  }

  std::vector<Twig> below(const urdf::Link& base) {
    visit(base, {}, 0.0, 0);
    return std::move(twigs_);
  }

 private:
  // `chain`: the joints of one coordinate from the base to here; `way`: the distance along them.
  void visit(const urdf::Link& link, const Joints& chain, double way, int fixed_behind) {
    const std::size_t kept = without_gripper(chain);
    const Joints arm(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(kept));
    if (kept == chain.size()) twigs_.push_back({&link, arm, fixed_behind});
    if (kept == chain.size() && fixed_behind == 0 && is_hand(link, kept, way)) {
      enter_rigid(link, chain, fixed_behind);
      return;
    }
    for (std::size_t i = 0; i < link.child_joints.size(); ++i)
      descend(*link.child_joints[i], *link.child_links[i], chain, way, fixed_behind);
  }

  void descend(const urdf::Joint& joint, const urdf::Link& child, Joints chain, double way,
               int fixed_behind) {
    way += length(joint.parent_to_joint_origin_transform.position);
    if (joint.type == urdf::Joint::FIXED) return visit(child, chain, way, fixed_behind + 1);
    if (!has_one_coordinate(joint)) return;
    chain.push_back(&joint);
    visit(child, chain, way, 0);
  }

  // The links of a hand that are rigid with it; its fingers are not entered.
  void enter_rigid(const urdf::Link& link, const Joints& chain, int fixed_behind) {
    for (std::size_t i = 0; i < link.child_joints.size(); ++i)
      if (link.child_joints[i]->type == urdf::Joint::FIXED) {
        const urdf::Link& child = *link.child_links[i];
        twigs_.push_back({&child, chain, fixed_behind + 1});
        enter_rigid(child, chain, fixed_behind + 1);
      }
  }

  /// How many joints of a chain remain when a gripper's are taken off its end.
  std::size_t without_gripper(const Joints& chain) const {
    const auto unnamed =
        std::count_if(chain.begin(), chain.end(), [](auto* j) { return !is_named_gripper(*j); });
    std::size_t kept = chain.size();
    while (kept > 0 && is_gripper(*chain[kept - 1], kept - 1, unnamed >= 3)) --kept;
    return kept;
  }

  // A mimic joint whose master is missing stays: whoever reads the joints says so.
  bool follows(const urdf::Joint& joint) const {
    return joint.mimic && model_.getJoint(joint.mimic->joint_name);
  }

  bool is_gripper(const urdf::Joint& joint, std::size_t before, bool names_tell) const {
    if (follows(joint) || masters_.count(joint.name)) return before >= 2;
    const bool by_name = names_tell && is_named_gripper(joint);
    return is_short_slide(joint) ? (by_name || before >= 4) : (by_name && before >= 3);
  }

  // Several chains go on, each with fewer joints than lie before it and short against the way here.
  static bool is_hand(const urdf::Link& link, std::size_t joints_before, double way) {
    if (joints_before < 3) return false;
    std::vector<std::size_t> counts;
    double longest = 0.0;
    measure(link, counts, longest);
    return counts.size() >= 2 && *std::max_element(counts.begin(), counts.end()) < joints_before &&
           longest < longest_finger_share * way;
  }

  // The joints of each chain that begins at a link or rigidly behind it, and the length of the longest.
  static void measure(const urdf::Link& link, std::vector<std::size_t>& counts, double& longest) {
    for (std::size_t i = 0; i < link.child_joints.size(); ++i) {
      const urdf::Link& child = *link.child_links[i];
      if (link.child_joints[i]->type == urdf::Joint::FIXED)
        measure(child, counts, longest);
      else if (!link.child_joints[i]->mimic) {
        counts.push_back(1 + most_joints(child));
        longest = std::max(longest, longest_way(child));
      }
    }
  }

  static std::size_t most_joints(const urdf::Link& link) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < link.child_joints.size(); ++i)
      most = std::max(most, most_joints(*link.child_links[i]) + has_one_coordinate(*link.child_joints[i]));
    return most;
  }

  static double longest_way(const urdf::Link& link) {
    double longest = 0.0;
    for (std::size_t i = 0; i < link.child_joints.size(); ++i)
      longest = std::max(longest, length(link.child_joints[i]->parent_to_joint_origin_transform.position) +
                                      longest_way(*link.child_links[i]));
    return longest;
  }

  const urdf::ModelInterface& model_;
  std::set<std::string> masters_;
  std::vector<Twig> twigs_;
};

}  // namespace

bool has_one_coordinate(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
         joint.type == urdf::Joint::PRISMATIC;
}

std::vector<Twig> twigs_below(const urdf::ModelInterface& model, const urdf::Link& base) {
  return Tree(model).below(base);
}

}  // namespace dmp::detail
