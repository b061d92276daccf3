#include "robot/arm_choice.hpp"

#include <algorithm>
#include <cmath>
#include <dmp/error.hpp>
#include <regex>
#include <vector>

#include "robot/arm_tree.hpp"
#include "robot/urdf_graph.hpp"

namespace dmp::detail {
namespace {

using Joints = std::vector<const urdf::Joint*>;
using Ends = std::vector<const Twig*>;  // twigs of one chain

constexpr std::ptrdiff_t fewest_of_an_arm = 4;  // joints of its own, for another chain to be one
constexpr double jaw_closed = 0.26;             // rad; a jaw's range begins about there,
constexpr double jaw_range = 2.2;               // rad, and is no longer than this

bool matches(const std::string& name, const char* pattern) {
  return std::regex_search(name, std::regex(pattern, std::regex::icase));
}

// What a tool's frame is called, the most telling first.
constexpr const char* tool_names[] = {
    "tcp",  "tool0$|tool_frame$",  "grasp|gripper_frame", "ee_link|ee_gripper|eef|end_?effector|_ee$",
    "tool", "hand$|flange|gripper"};
constexpr const char* no_tool = "camera|sensor|(^|[^a-z])ft_|optical|imu";

std::ptrdiff_t free_joints(const Joints& joints) {
  return std::count_if(joints.begin(), joints.end(), [](const urdf::Joint* j) { return !j->mimic; });
}

std::size_t common_joints(const Joints& a, const Joints& b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

using Chain = std::pair<Joints, Ends>;

/// The chains of a robot, each with the links rigidly behind its last joint, the longest first.
std::vector<Chain> chains_of(const std::vector<Twig>& twigs) {
  std::vector<Chain> chains;
  for (const Twig& twig : twigs) {
    if (free_joints(twig.arm) == 0) continue;
    const auto same = [&](const Chain& chain) { return chain.first == twig.arm; };
    const auto at = std::find_if(chains.begin(), chains.end(), same);
    (at == chains.end() ? chains.emplace_back(twig.arm, Ends()) : *at).second.push_back(&twig);
  }
  std::stable_sort(chains.begin(), chains.end(), [](const Chain& a, const Chain& b) {
    return std::pair(free_joints(a.first), a.first.size()) > std::pair(free_joints(b.first), b.first.size());
  });
  return chains;
}

/// Of the links rigidly behind a chain's last joint the one that a hand is led by, and whether its name says
/// so.
std::pair<const Twig*, bool> tool_of(const Ends& ends) {
  for (const char* pattern : tool_names) {
    const Twig* best = nullptr;
    for (const Twig* twig : ends) {
      const std::string& name = twig->link->name;
      if (!matches(name, pattern) || matches(name, no_tool)) continue;
      if (!best || name.size() < best->link->name.size()) best = twig;
    }
    if (best) return {best, true};
  }
  const auto deeper = [](const Twig* a, const Twig* b) { return a->fixed_behind < b->fixed_behind; };
  Ends plain;
  for (const Twig* twig : ends)
    if (twig->fixed_behind == 0 || !matches(twig->link->name, no_tool)) plain.push_back(twig);
  return {*std::max_element(plain.begin(), plain.end(), deeper), false};
}

// A range that begins where a jaw is closed.
bool could_be_jaw(const urdf::Joint& joint) {
  if (joint.type != urdf::Joint::REVOLUTE || !joint.limits) return false;
  const double lower = joint.limits->lower, upper = joint.limits->upper;
  return std::min(std::abs(lower), std::abs(upper)) <= jaw_closed && upper - lower <= jaw_range;
}

std::string joints_text(const Joints& joints, std::size_t from) {
  Joints own;
  for (std::size_t i = from; i < joints.size(); ++i)
    if (!joints[i]->mimic) own.push_back(joints[i]);
  if (own.empty()) return "0 joints";
  if (own.size() == 1) return "1 joint, " + own.front()->name;
  return std::to_string(own.size()) + " joints, " + own.front()->name + " to " + own.back()->name;
}

class Choice {
 public:
  Choice(const urdf::ModelInterface& model, const urdf::Link& base)
      : twigs_(twigs_below(model, base)), chains_(chains_of(twigs_)), base_(base.name) {}

  bool has_arm() const { return !chains_.empty(); }

  ArmChoice made() const {
    const auto& [joints, ends] = chains_.front();
    if (const auto arms = in_question(); arms.size() > 1) ask(arms);
    const auto [tool, is_named] = tool_of(ends);
    if (!is_named && joints.size() > fewest_of_an_arm && could_be_jaw(*joints.back())) ask_about_jaw();
    return {base_, tool->link->name, joints_text(joints, 0) + held_text(*joints.back())};
  }

 private:
  /// The longest chain, and every other that is as long or has an arm's number of joints of its own.
  std::vector<const Chain*> in_question() const {
    const Joints& longest = chains_.front().first;
    std::vector<const Chain*> found;
    for (const Chain& chain : chains_) {
      const std::size_t common = common_joints(longest, chain.first);
      const bool is_part = common == chain.first.size();
      const auto own =
          free_joints({chain.first.begin() + static_cast<std::ptrdiff_t>(common), chain.first.end()});
      const bool as_long = free_joints(chain.first) == free_joints(longest);
      const bool goes_on = std::any_of(found.begin(), found.end(), [&](const Chain* other) {
        return common_joints(other->first, chain.first) == chain.first.size();
      });
      if (&chain == &chains_.front() || (!is_part && !goes_on && (as_long || own >= fewest_of_an_arm)))
        found.push_back(&chain);
    }
    return found;
  }

  [[noreturn]] void ask(const std::vector<const Chain*>& arms) const {
    std::string text = "tip: not given, and " + std::to_string(arms.size()) +
                       " arms or legs could be meant; state one line of:";
    for (const Chain* arm : arms) {
      std::size_t shared = 0;
      for (const Chain* other : arms)
        if (other != arm) shared = std::max(shared, common_joints(arm->first, other->first));
      shared = std::min(shared, arm->first.size() - 1);
      text += line(*arm, shared);
    }
    throw InvalidArgument(text);
  }

  std::string line(const Chain& arm, std::size_t shared) const {
    const std::string base = shared == 0 ? base_ : arm.first[shared - 1]->child_link_name;
    return "\n  base='" + base + "' tip='" + tool_of(arm.second).first->link->name + "' (" +
           joints_text(arm.first, shared) + ")";
  }

  [[noreturn]] void ask_about_jaw() const {
    const Joints& joints = chains_.front().first;
    const Joints without(joints.begin(), joints.end() - 1);
    std::string text = "tip: not given, and the last joint '" + joints.back()->name +
                       "' could be a gripper's; state one line of:";
    for (const Chain& chain : chains_)
      if (chain.first == without) text += line(chain, 0);
    throw InvalidArgument(text + line(chains_.front(), 0));
  }

  /// Which moving joints hang rigidly behind the last arm joint.
  std::string held_text(const urdf::Joint& last) const {
    std::string text;
    for (const Twig& twig : twigs_)
      if (!twig.arm.empty() && twig.arm.back() == &last)
        for (const auto& joint : twig.link->child_joints)
          if (joint->type != urdf::Joint::FIXED) text += (text.empty() ? "" : ", ") + joint->name;
    return text.empty() ? "" : "; held still: " + text;
  }

  std::vector<Twig> twigs_;
  std::vector<Chain> chains_;  // the longest first
  std::string base_;
};

/// The link below the last joint on the way that is not an arm's (floating, planar); else the root.
std::string root_of(const urdf::ModelInterface& model, const std::string& tip) {
  for (urdf::LinkConstSharedPtr link = model.getLink(tip); link && link->parent_joint;
       link = model.getLink(link->parent_joint->parent_link_name))
    if (link->parent_joint->type != urdf::Joint::FIXED && !has_one_coordinate(*link->parent_joint))
      return link->name;
  return model.getRoot()->name;
}

/// Where the search begins: the root, or the link that alone hangs below it by a floating or planar joint.
std::string start_of(const urdf::ModelInterface& model) {
  urdf::LinkConstSharedPtr link = model.getRoot();
  while (link->child_joints.size() == 1) {
    const urdf::Joint& joint = *link->child_joints.front();
    if (has_one_coordinate(joint)) break;
    link = link->child_links.front();
    if (joint.type != urdf::Joint::FIXED) return link->name;
  }
  return model.getRoot()->name;
}

/// A robot without an arm's joint, from end to end: whoever reads its joints says what is wrong with them.
ArmChoice whole(const urdf::ModelInterface& model, const std::string& base) {
  std::vector<std::string> ends;
  for (const auto& [name, link] : model.links_)
    if (link->child_links.empty()) ends.push_back(name);
  const std::string from = base.empty() ? model.getRoot()->name : base;
  if (ends.size() != 1) throw InvalidArgument("urdf: no moving joint of an arm below '" + from + "'.");
  return {from, ends.front(), ""};
}

}  // namespace

ArmChoice choose_arm(const urdf::ModelInterface& model, const std::string& base, const std::string& tip) {
  if (!tip.empty()) {
    find_link(model, tip, "tip");
    ArmChoice choice{base.empty() ? root_of(model, tip) : base, tip, ""};
    find_link(model, choice.base, "base");
    return choice;
  }
  const std::string start = base.empty() ? start_of(model) : base;
  const Choice choice(model, *find_link(model, start, "base"));
  return choice.has_arm() ? choice.made() : whole(model, base);
}

}  // namespace dmp::detail
