#include "robot/tool_frame.hpp"

#include <dmp/error.hpp>
#include <dmp/so3.hpp>
#include <locale>
#include <sstream>

#include "geometry/pose.hpp"

namespace dmp::detail {
namespace {

/// A name that no link or joint of the URDF has.
std::string unused(const std::string& urdf, const std::string& wish) {
  std::string name = wish;
  for (int k = 2; urdf.find("\"" + name + "\"") != std::string::npos; ++k) name = wish + std::to_string(k);
  return name;
}

std::string words(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << v.x() << ' ' << v.y() << ' ' << v.z();
  return text.str();
}

std::string element(const std::string& tip, const std::string& tool, const Eigen::Vector3d& position,
                    const Eigen::Matrix3d& rotation) {
  return "<link name=\"" + tool + "\"/>\n<joint name=\"" + tool + "_joint\" type=\"fixed\"><parent link=\"" +
         tip + "\"/><child link=\"" + tool + "\"/><origin xyz=\"" + words(position) + "\" rpy=\"" +
         words(so3::to_euler(rotation, "xyz")) + "\"/></joint>\n";
}

KDL::Frame to_kdl(const Eigen::Vector3d& p, const Eigen::Matrix3d& r) {
  return {KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
          KDL::Vector(p.x(), p.y(), p.z())};
}

/// The chain with the tip moved by `tool`; what weighs stays where it is.
KDL::Chain prolonged(const KDL::Chain& chain, const KDL::Frame& tool) {
  KDL::Chain longer;
  const unsigned last = chain.getNrOfSegments() - 1;
  for (unsigned i = 0; i < last; ++i) longer.addSegment(chain.getSegment(i));
  const KDL::Segment& end = chain.getSegment(last);
  longer.addSegment(
      KDL::Segment(end.getJoint(), end.getFrameToTip() * tool, tool.Inverse() * end.getInertia()));
  return longer;
}

}  // namespace

void add_tool(ChainModel& model, const Eigen::Matrix4d& frame) {
  require_pose(frame, "tool");
  const Eigen::Matrix3d rotation = so3::nearest_rotation(frame.topLeftCorner<3, 3>());
  const Eigen::Vector3d position = frame.topRightCorner<3, 1>();
  const std::size_t end = model.urdf.rfind("</robot");
  if (end == std::string::npos) throw InvalidArgument("tool: the URDF does not end with </robot>.");
  const std::string name = unused(model.urdf, model.tip + "_tool");
  model.urdf.insert(end, element(model.tip, name, position, rotation));
  model.chain = prolonged(model.chain, to_kdl(position, rotation));
  model.tip = name;
}

}  // namespace dmp::detail
