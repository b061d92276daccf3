#pragma once

#include <optional>

#include "kinematics/path_tracker.hpp"

namespace dmp::detail {

/// The same path with less motion of the null space: joints at some of its poses are drawn towards the middle
/// of their neighbours, like an elastic band (Quinlan and Khatib, ICRA 1993), and put back onto their pose;
/// then the C2 spline through them is put back onto every pose. None if the result misses a pose. For arms
/// with a null space; others have nothing to calm.
std::optional<Route> calmed(const ChainModel& model, const PathTracker& tracker, const TargetPath& path,
                            const Route& route);

}  // namespace dmp::detail
