#include "robot/flat_chain.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "robot/kdl_forward.hpp"

namespace dmp::detail {
namespace {

// frame * (motion of a joint about or along z) * to_next
void advance(Frame& frame, bool prismatic, double q, const Frame& to_next) {
  if (prismatic) {
    frame.position += q * frame.rotation.col(2);
  } else {
    const double c = std::cos(q), s = std::sin(q);
    const Eigen::Vector3d x = frame.rotation.col(0), y = frame.rotation.col(1);
    frame.rotation.col(0) = c * x + s * y;
    frame.rotation.col(1) = c * y - s * x;
  }
  frame.position += frame.rotation * to_next.position;
  frame.rotation = (frame.rotation * to_next.rotation).eval();
}

}  // namespace

FlatChain::FlatChain(const ChainModel& model)
    : joint_count_(static_cast<Eigen::Index>(model.joint_names.size())) {
  for (const KDL::Segment& segment : model.chain.segments) {
    const KDL::Joint::JointType type = segment.getJoint().getType();
    if (type == KDL::Joint::Fixed)
      base_ = from_kdl(segment.getFrameToTip());
    else
      links_.push_back(
          {model.couplings[links_.size()], type == KDL::Joint::TransZ, from_kdl(segment.getFrameToTip())});
  }
}

Frame FlatChain::forward(const Joints& q) const {
  Frame frame = base_;
  for (const Link& link : links_)
    advance(frame, link.prismatic, link.coupling.multiplier * q[link.coupling.joint] + link.coupling.offset,
            link.to_next);
  return frame;
}

Frame FlatChain::forward(const Joints& q, Jacobian& jacobian) const {
  Frame frame = base_;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 2 * joint_capacity> axes(3, links_.size()),
      origins(3, links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    axes.col(static_cast<Eigen::Index>(i)) = frame.rotation.col(2);
    origins.col(static_cast<Eigen::Index>(i)) = frame.position;
    advance(frame, link.prismatic, link.coupling.multiplier * q[link.coupling.joint] + link.coupling.offset,
            link.to_next);
  }
  jacobian.setZero(6, joint_count_);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const Eigen::Vector3d axis = link.coupling.multiplier * axes.col(static_cast<Eigen::Index>(i));
    auto column = jacobian.col(link.coupling.joint);
    if (link.prismatic) {
      column.head<3>() += axis;
    } else {
      column.head<3>() += axis.cross(frame.position - origins.col(static_cast<Eigen::Index>(i)));
      column.tail<3>() += axis;
    }
  }
  return frame;
}

}  // namespace dmp::detail
