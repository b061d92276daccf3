#pragma once

#include <dmp/dmp.hpp>
#include <dmp/export.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>

#include <vector>

namespace dmp {

/// The model with the mean of all weights, starts, goals, start velocities and durations: the average of
/// several tests. Equal to one fit of all demonstrations where these share their scaling; a joint fit
/// (Dmp::fit of several) is right everywhere. Throws InvalidArgument for none, or for models that differ in
/// options or dimension.
DMP_EXPORT Dmp average(const std::vector<Dmp>& models);
DMP_EXPORT OrientationDmp average(const std::vector<OrientationDmp>& models);
DMP_EXPORT PoseDmp average(const std::vector<PoseDmp>& models);

}  // namespace dmp
