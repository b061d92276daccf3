#pragma once

#include <string>

namespace dmp::detail {

/// Looks through the tags of a URDF before urdfdom sees it and throws InvalidArgument for what would hurt
/// there: nesting so deep that its recursive parser overflows the stack, and links that are their own
/// ancestors (urdfdom then leaks, and a walk from the tip to the base never ends) or have two parents.
void scan_urdf(const std::string& text);

}  // namespace dmp::detail
