#pragma once
// Arms that the tests of dmp::kinematics share.

#include <dmp/arm.hpp>

#include <random>
#include <sstream>
#include <string>

namespace arms {

struct JointText {
  std::string origin = R"(<origin xyz="0 0 0"/>)";
  std::string axis = R"(<axis xyz="0 0 1"/>)";
  std::string type = "revolute";
  std::string more = R"(<limit lower="-2" upper="2" velocity="3" effort="50"/>)";
};

/// link0 - joint1 - link1 - joint2 ... - link<n>
inline std::string urdf(const std::vector<JointText>& joints) {
  std::ostringstream text;
  text << "<robot name=\"arm\"><link name=\"link0\"/>";
  for (std::size_t i = 1; i <= joints.size(); ++i) {
    const JointText& joint = joints[i - 1];
    text << "<link name=\"link" << i << "\"/><joint name=\"joint" << i << "\" type=\"" << joint.type << "\">"
         << "<parent link=\"link" << i - 1 << "\"/><child link=\"link" << i << "\"/>" << joint.origin
         << joint.axis << joint.more << "</joint>";
  }
  text << "</robot>";
  return text.str();
}

/// Two links of 1 m in the plane, joints about z; the closed form of every textbook.
inline std::string two_link() {
  const std::string one = R"(<origin xyz="1 0 0"/>)";
  return urdf({{}, {one}, {one, "", "fixed", ""}});
}

/// Seven revolute joints with offsets at the elbow and the wrist and oblique axes, as real arms have them.
inline std::string seven_joints() {
  const auto at = [](const char* xyz, const char* rpy) {
    return std::string("<origin xyz=\"") + xyz + "\" rpy=\"" + rpy + "\"/>";
  };
  const auto limit = [](double lower, double upper) {
    return "<limit lower=\"" + std::to_string(lower) + "\" upper=\"" + std::to_string(upper) +
           "\" velocity=\"2.2\" effort=\"80\"/>";
  };
  const std::string z = R"(<axis xyz="0 0 1"/>)", y = R"(<axis xyz="0 1 0"/>)",
                    minus = R"(<axis xyz="0 0 -1"/>)";
  const std::string oblique = R"(<axis xyz="0.6 0 0.8"/>)", turning = "revolute";
  return urdf({{at("0 0 0.33", "0 0 0"), z, turning, limit(-2.9, 2.9)},
               {at("0 0 0", "0.1 0 0"), y, turning, limit(-1.8, 1.8)},
               {at("0 0 0.31", "0 0 0.3"), oblique, turning, limit(-2.9, 2.9)},
               {at("0.08 0 0", "0 0 0"), y, turning, limit(-3.0, 0.2)},
               {at("-0.08 0 0.38", "0 0.2 0"), z, turning, limit(-2.9, 2.9)},
               {at("0 0 0", "0 0 0"), y, turning, limit(-1.9, 3.7)},
               {at("0.09 0 0.1", "3.14159 0 0"), minus, turning, limit(-2.9, 2.9)},
               {at("0 0 -0.1", "0 0 -0.785"), "", "fixed", ""}});
}

/// Uniform in the limits.
inline Eigen::VectorXd random_joints(const dmp::Arm& arm, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Eigen::VectorXd q(arm.joint_count());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = arm.lower()[i] + (arm.upper()[i] - arm.lower()[i]) * unit(random);
  return q;
}

inline bool within_limits(const dmp::Arm& arm, const Eigen::VectorXd& q) {
  return (q - arm.lower()).minCoeff() >= 0.0 && (arm.upper() - q).minCoeff() >= 0.0;
}

}  // namespace arms
