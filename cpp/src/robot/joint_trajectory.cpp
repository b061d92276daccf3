#include <dmp/error.hpp>
#include <dmp/joint_trajectory.hpp>

#include <cstdio>

#include "robot/checks.hpp"
#include "robot/joint_spline.hpp"

namespace dmp {

std::string PathReport::summary() const {
  char text[200];
  std::snprintf(text, sizeof text, "%td of %zu poses met; largest error %.3g mm, %.3g deg", solved,
                status.size(), 1e3 * position_error.maxCoeff(), 57.29577951308232 * angle_error.maxCoeff());
  std::string line = text;
  for (const auto& run : missed)
    line += (run == missed.front() ? "; missed: " : ", ") + std::to_string(run.first) + "-" +
            std::to_string(run.second) + " (" + name_of(status[static_cast<std::size_t>(run.first)]) + ")";
  return line;
}

JointTrajectory JointTrajectory::through(const Eigen::VectorXd& times, const RowMatrix& positions,
                                         const std::vector<std::string>& joint_names, SplineEnds ends) {
  if (positions.rows() != times.size() || times.size() == 0)
    throw InvalidArgument("positions: " + std::to_string(positions.rows()) + " rows, expected " +
                          std::to_string(times.size()) + ", one for each time, and at least one.");
  detail::check_times(times);
  for (Eigen::Index k = 0; k < positions.rows(); ++k)
    if (!positions.row(k).allFinite())
      throw InvalidArgument("positions[" + std::to_string(k) + "]: not finite.");
  JointTrajectory joints;
  joints.time = times;
  joints.position = positions;
  joints.joint_names = joint_names;
  detail::differentiate(joints, ends);
  if (!joints.velocity.allFinite() || !joints.acceleration.allFinite())
    throw InvalidArgument("positions: so large, or times so close, that the velocities overflow.");
  return joints;
}

}  // namespace dmp
