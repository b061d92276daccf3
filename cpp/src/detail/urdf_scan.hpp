#pragma once

#include <map>
#include <string>

namespace dmp::detail {

/// What urdfdom does not tell of a URDF: for each joint whose <limit> states one of lower and upper alone,
/// the other, which then counts as 0.
using MissingLimits = std::map<std::string, std::string>;

/// Looks through the tags of a URDF before urdfdom sees it and throws InvalidArgument for what would hurt
/// there: nesting so deep that its recursive parser overflows the stack, and links that are their own
/// ancestors (urdfdom then leaks, and a walk from the tip to the base never ends) or have two parents.
MissingLimits scan_urdf(const std::string& text);

}  // namespace dmp::detail
