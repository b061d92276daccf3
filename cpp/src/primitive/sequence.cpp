#include "primitive/sequence_bodies.hpp"

namespace dmp {

template class Sequence<VectorSpace>;
template class Sequence<RotationSpace>;
template class Sequence<PoseSpace>;
template class Sequence<PoseGripperSpace>;
template class SequenceRun<VectorSpace>;
template class SequenceRun<RotationSpace>;
template class SequenceRun<PoseSpace>;
template class SequenceRun<PoseGripperSpace>;

}  // namespace dmp
