#include <dmp/orientation_dmp.hpp>

#include "primitive/instantiate.hpp"

namespace dmp {

DMP_INSTANTIATE(RotationSpace);

}  // namespace dmp
