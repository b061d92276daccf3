#pragma once

#include <map>
#include <string>

namespace dmp::detail {

/// What urdfdom does not tell of a URDF: for each joint whose <limit> states one of lower and upper alone,
/// the other, which then counts as 0.
using MissingLimits = std::map<std::string, std::string>;

struct Parent {
  std::string joint, link;
};
using Parents = std::map<std::string, Parent>;  ///< child link -> the joint above it

/// Throws InvalidArgument for a link that has one already.
void add_parent(Parents& parents, const std::string& child, const Parent& above);

/// Throws InvalidArgument for links that are their own ancestors.
void refuse_cycles(const Parents& parents);

/// Looks through the tags of a URDF before urdfdom sees it and throws InvalidArgument for what would hurt
/// there: nesting so deep that its recursive parser overflows the stack, and links that are their own
/// ancestors (urdfdom then leaks, and a walk from the tip to the base never ends) or have two parents.
MissingLimits scan_urdf(const std::string& text);

}  // namespace dmp::detail
