#pragma once

#include <urdf_model/model.h>

#include <string>
#include <vector>

namespace dmp::detail {

/// Whether a joint moves by one coordinate: revolute, continuous or prismatic.
bool has_one_coordinate(const urdf::Joint& joint);

/// One link below a base, seen from there.
struct Twig {
  const urdf::Link* link;
  std::vector<const urdf::Joint*> arm;  ///< the joints up to here, none of a gripper's at the end
  int fixed_behind = 0;                 ///< fixed joints between the last arm joint and the link
};

/// The links below a base to which only fixed joints lead from their last arm joint: the ends of arms, and
/// all that is rigid with a joint of one. The hand of an arm is not entered.
std::vector<Twig> twigs_below(const urdf::ModelInterface& model, const urdf::Link& base);

}  // namespace dmp::detail
