#pragma once

#include <Eigen/Core>

#include "robot/chain_model.hpp"

namespace dmp::detail {

/// Fixes a massless link `tip`_tool to the tip and makes it the tip: in the chain, and in the URDF's text,
/// which the physics engines and the drawings read. `frame` is the tool in the tip, m; throws InvalidArgument
/// unless it is a pose.
void add_tool(ChainModel& model, const Eigen::Matrix4d& frame);

}  // namespace dmp::detail
