#pragma once

#include "robot/flat_chain.hpp"

namespace dmp::detail {

/// How far each joint may move: lower <= 0 <= upper, element by element.
struct Box {
  Joints lower, upper;
};

/// The minimiser of |error - jacobian step|^2 + damping |step|^2 inside the box, by the active-set method.
///
/// Solved in the space of the six errors, step = J^T (J J^T + damping I)^-1 error, so that the linear systems
/// are 6 x 6 whatever the number of joints. Joints that would leave the box are put on its side and the
/// others are solved again for what is left of the error; damping > 0.
Joints box_step(const Jacobian& jacobian, const Vector6& error, double damping, const Box& box);

}  // namespace dmp::detail
