#pragma once

#include <dmp/dmp.hpp>
#include <dmp/orientation_dmp.hpp>
#include <dmp/pose_dmp.hpp>

#include <vector>

namespace dmp {

/// The model with the mean of all weights, starts, goals, start velocities and durations: the average of
/// several tests, in the kernels of the finest of them. Equal to one fit of all demonstrations where these
/// share kernels and scaling; a joint fit (Primitive::fit of several) is right everywhere. Throws
/// InvalidArgument for none, or for models that differ in dimension or in an option of a run.
template <class Space>
DMP_EXPORT Primitive<Space> average(const std::vector<Primitive<Space>>& models);
// For lists in braces, whose type no template can deduce.
inline Dmp average(const std::vector<Dmp>& models) { return average<VectorSpace>(models); }
inline OrientationDmp average(const std::vector<OrientationDmp>& models) {
  return average<RotationSpace>(models);
}
inline PoseDmp average(const std::vector<PoseDmp>& models) { return average<PoseSpace>(models); }

}  // namespace dmp
