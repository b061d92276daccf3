#include "robot/kdl_chain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <dmp/error.hpp>
#include <vector>

namespace dmp::detail {
namespace {

// Turns z onto the axis; exact for axes along x, y or z.
Eigen::Isometry3d z_to(const urdf::Vector3& axis) {
  const Eigen::Vector3d z = Eigen::Vector3d(axis.x, axis.y, axis.z).stableNormalized();
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  if (z == Eigen::Vector3d::UnitZ()) return turn;
  Eigen::Index least;
  z.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d x = Eigen::Vector3d::Unit(least).cross(z).normalized();
  turn.linear() << x, z.cross(x), z;
  return turn;
}

Eigen::Isometry3d to_eigen(const urdf::Pose& pose) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translation() << pose.position.x, pose.position.y, pose.position.z;
  frame.linear() = Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
                       .normalized()
                       .toRotationMatrix();
  return frame;
}

Eigen::Isometry3d origin_of(const urdf::Joint& joint) {
  const Eigen::Isometry3d frame = to_eigen(joint.parent_to_joint_origin_transform);
  if (!frame.matrix().allFinite()) refuse(joint, "its <origin> is not finite.");
  return frame;
}

KDL::Frame to_kdl(const Eigen::Isometry3d& frame) {
  const Eigen::Matrix3d r = frame.linear();
  const Eigen::Vector3d p = frame.translation();
  return {KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
          KDL::Vector(p.x(), p.y(), p.z())};
}

// Where a joint beside the way is held: in the middle of its range, as the physics engines hold a finger.
double held_at(const urdf::Joint& joint) {
  const bool has_range = joint.limits && joint.limits->lower < joint.limits->upper;
  return has_range && moves(joint) ? 0.5 * (joint.limits->lower + joint.limits->upper) : 0.0;
}

// The child's frame in the parent's, with the joint where it is held.
Eigen::Isometry3d held(const urdf::Joint& joint) {
  Eigen::Isometry3d frame = to_eigen(joint.parent_to_joint_origin_transform);
  const double value = held_at(joint);
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  if (value == 0.0 || !(axis.norm() > shortest_axis)) return frame;
  if (joint.type == urdf::Joint::PRISMATIC)
    frame.translate(value * axis.normalized());
  else
    frame.rotate(Eigen::AngleAxisd(value, axis.normalized()));
  return frame;
}

// What a link weighs, in its frame, and all that hangs from it but the way on.
KDL::RigidBodyInertia bodies_of(const urdf::Link& link, const urdf::Joint* way_on) {
  KDL::RigidBodyInertia sum = KDL::RigidBodyInertia::Zero();
  if (link.inertial) {
    const urdf::Inertial& body = *link.inertial;
    const KDL::RotationalInertia about_centre(body.ixx, body.iyy, body.izz, body.ixy, body.ixz, body.iyz);
    sum = to_kdl(to_eigen(body.origin)) * KDL::RigidBodyInertia(body.mass, KDL::Vector::Zero(), about_centre);
  }
  for (std::size_t i = 0; i < link.child_joints.size(); ++i)
    if (link.child_joints[i].get() != way_on)
      sum = sum + to_kdl(held(*link.child_joints[i])) * bodies_of(*link.child_links[i], nullptr);
  return sum;
}

}  // namespace

void refuse(const urdf::Joint& joint, const std::string& why) {
  throw InvalidArgument("urdf: joint '" + joint.name + "': " + why);
}

Eigen::Vector3d up_in(const urdf::ModelInterface& urdf, urdf::LinkConstSharedPtr link) {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Matrix3d> turns;
  for (; link->parent_joint; link = urdf.getLink(link->parent_joint->parent_link_name))
    turns.push_back(held(*link->parent_joint).linear());
  for (auto turn = turns.rbegin(); turn != turns.rend(); ++turn) up = turn->transpose() * up;
  return up;
}

KDL::Chain chain_of(const UrdfPath& path, const urdf::ModelInterface& urdf) {
  KDL::Chain chain;
  KDL::Joint moving(KDL::Joint::Fixed);
  Eigen::Isometry3d since = Eigen::Isometry3d::Identity();       // from the last moving joint to here
  KDL::RigidBodyInertia bodies = KDL::RigidBodyInertia::Zero();  // of that way, seen from the joint
  for (std::size_t i = 0; i < path.size(); ++i) {
    const urdf::Joint& joint = *path[i];
    since = since * origin_of(joint);
    if (moves(joint)) {
      const Eigen::Isometry3d turn = z_to(joint.axis);
      const KDL::Frame tip = to_kdl(since * turn);
      chain.addSegment(KDL::Segment(moving, tip, tip.Inverse() * bodies));
      moving = KDL::Joint(joint.name,
                          joint.type == urdf::Joint::PRISMATIC ? KDL::Joint::TransZ : KDL::Joint::RotZ);
      since = turn.inverse();
      bodies = KDL::RigidBodyInertia::Zero();
    }
    const urdf::Joint* const way_on = i + 1 < path.size() ? path[i + 1].get() : nullptr;
    bodies = bodies + to_kdl(since) * bodies_of(*urdf.getLink(joint.child_link_name), way_on);
  }
  chain.addSegment(KDL::Segment(moving, to_kdl(since), to_kdl(since).Inverse() * bodies));
  return chain;
}

}  // namespace dmp::detail
