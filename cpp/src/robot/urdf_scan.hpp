#pragma once

#include <map>
#include <string>

namespace dmp::detail {

/// For each joint whose <limit> states one of lower and upper alone, the other, which then counts as 0.
using MissingLimits = std::map<std::string, std::string>;

/// Limits of a URDF 1.1 or 1.2 [rad/s^2, rad/s^3; m for a sliding joint]; 0 where none is stated.
struct HigherLimits {
  double acceleration = 0.0;  ///< the smaller one of acceleration and deceleration
  double jerk = 0.0;
};

/// What urdfdom does not tell of a URDF.
struct UrdfScan {
  MissingLimits missing;
  std::map<std::string, HigherLimits> higher;  ///< by joint; only where some are stated
};

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
UrdfScan scan_urdf(const std::string& text);

/// The text with the version of its <robot> as urdfdom 4 takes it: 1.1 and 1.2 add to 1.0 only what scan_urdf
/// reads (urdfdom pull request 212).
std::string as_version_1_0(std::string text);

}  // namespace dmp::detail
