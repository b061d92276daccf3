#pragma once

#include <Eigen/Core>
#include <kdl/chain.hpp>
#include <string>

#include "robot/urdf_graph.hpp"

namespace dmp::detail {

inline constexpr double shortest_axis = 1e-6;  ///< below this a zero was meant, or its direction is rounding

[[noreturn]] void refuse(const urdf::Joint& joint, const std::string& why);

inline bool moves(const urdf::Joint& joint) { return joint.type != urdf::Joint::FIXED; }

/// The way from base to tip with what its links weigh; joints beside the way are held in the middle of their
/// range, as the physics engines hold a finger.
KDL::Chain chain_of(const UrdfPath& path, const urdf::ModelInterface& urdf);

/// z of the root in the frame of a link.
Eigen::Vector3d up_in(const urdf::ModelInterface& urdf, urdf::LinkConstSharedPtr link);

}  // namespace dmp::detail
