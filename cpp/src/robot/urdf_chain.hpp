#pragma once

#include <string>

#include "robot/chain_model.hpp"

namespace dmp::detail {

/// The chain from base to tip of a URDF; "" means the only candidate. Throws InvalidArgument for everything
/// that urdfdom refuses (with its words) or lets through although no motion can be planned with it.
ChainModel read_urdf(const std::string& text, const std::string& base, const std::string& tip);

}  // namespace dmp::detail
