#include "primitive/distribution_bodies.hpp"

namespace dmp {

#define DMP_INSTANTIATE_DISTRIBUTION(SPACE) \
  template class Distribution<SPACE>;       \
  template Distribution<SPACE> blend(const std::vector<Distribution<SPACE>>&, const Eigen::VectorXd&)

DMP_INSTANTIATE_DISTRIBUTION(VectorSpace);
DMP_INSTANTIATE_DISTRIBUTION(RotationSpace);
DMP_INSTANTIATE_DISTRIBUTION(PoseSpace);
DMP_INSTANTIATE_DISTRIBUTION(PoseGripperSpace);

}  // namespace dmp
