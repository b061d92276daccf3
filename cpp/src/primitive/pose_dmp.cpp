#include <dmp/pose_dmp.hpp>

#include "primitive/instantiate.hpp"

namespace dmp {

DMP_INSTANTIATE(PoseSpace);

}  // namespace dmp
