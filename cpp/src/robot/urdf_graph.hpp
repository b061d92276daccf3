#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string>
#include <vector>

#include "robot/urdf_scan.hpp"

namespace dmp::detail {

using UrdfPath = std::vector<urdf::JointConstSharedPtr>;

/// A URDF that urdfdom has read, and what it said of it or did not.
struct ParsedUrdf {
  urdf::ModelInterfaceSharedPtr model;
  std::string complaints;  ///< of urdfdom, about parts that it left out
  UrdfScan scan;
};

/// The links and joints of a URDF. Throws InvalidArgument with the words of urdfdom, which prints nothing.
ParsedUrdf parse_urdf(const std::string& text);

/// The link of that name; else InvalidArgument, naming the argument and listing the links that exist.
urdf::LinkConstSharedPtr find_link(const urdf::ModelInterface& model, const std::string& name,
                                   const std::string& argument);

/// The joints on the way from base to tip, or InvalidArgument if tip does not hang below base.
UrdfPath path_between(const urdf::ModelInterface& model, const std::string& base, const std::string& tip);

}  // namespace dmp::detail
