#pragma once

#include <urdf_model/model.h>

#include <string>

namespace dmp::detail {

/// Between which links the arm stands, and how that was chosen.
struct ArmChoice {
  std::string base, tip;
  std::string reason;  ///< one sentence without a full stop; "" where both were stated
};

/// Chooses what is not stated ("") as a person would: `base` is the root, or the link below the last floating
/// or planar joint; `tip` is the tool of the longest chain of arm joints, never a finger or a jaw.
///
/// Which joints are the arm's: those that move, without the grippers' at the end of a chain (a mimic and its
/// master, a short slide, a name such as finger or jaw, a branching into several short chains). The tip is
/// the link rigidly behind the last of them that is named like a tool (tcp, tool0, grasp, end_effector, tool,
/// hand), else the last one. Throws InvalidArgument, with one line for each chain, where several arms or legs
/// could be meant or the last joint could be a gripper's; and for links that do not exist.
ArmChoice choose_arm(const urdf::ModelInterface& model, const std::string& base, const std::string& tip);

}  // namespace dmp::detail
