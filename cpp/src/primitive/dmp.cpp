#include <dmp/dmp.hpp>

#include "primitive/instantiate.hpp"

namespace dmp {

DMP_INSTANTIATE(VectorSpace);

}  // namespace dmp
