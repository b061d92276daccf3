#pragma once

#include <dmp/export.hpp>

namespace dmp {

/// Why joints do or do not meet a pose.
enum class IkStatus {
  ok,             ///< Both errors are within the tolerances and the joints within their limits.
  out_of_reach,   ///< No joints meet the pose, limits or not: it lies outside what the links can reach.
  limit_blocked,  ///< Joints that meet the pose exist, but beyond the joint limits.
  step_limited,   ///< Joints that meet the pose exist, but further from the seed than the step allows.
  singular,      ///< The arm is so close to a singularity that the step allowed does not move it to the pose.
  budget,        ///< The iterations ran out while the error was still falling; more may meet the pose.
  invalid_input  ///< The pose or the seed is not finite, not rigid, or of the wrong size; nothing was
                 ///< computed.
};

/// "ok", "out_of_reach", ...
DMP_EXPORT const char* name_of(IkStatus status);

}  // namespace dmp
