#include "primitive/product_space.hpp"

namespace dmp::detail {

using Eigen::Index;
using PoseGeometry = Geometry<PoseSpace>;

Ends<PoseSpace> PoseGeometry::ends_of(const PoseDmpParameters& p) {
  Eigen::Matrix<double, 6, 1> displacement;
  displacement << P::first(p.goal) - P::first(p.start), p.start_error;
  return {p.start, p.goal, p.duration * p.start_twist, displacement, p.amplitude, p.reference};
}

void PoseGeometry::set_ends(PoseDmpParameters& p, const Ends<PoseSpace>& ends) {
  p.start = ends.start;
  p.goal = ends.goal;
  p.start_twist = ends.z / p.duration;
  p.start_error = ends.displacement.tail<3>();
  p.amplitude = ends.amplitude;
  p.reference = ends.reference;
}

PoseDemonstration PoseGeometry::denoised(const PoseDemonstration& demonstration,
                                         std::vector<NoiseEstimate>& found) {
  NoiseEstimate position, orientation;
  PoseDemonstration result = demonstration.denoised(&position, &orientation);
  found.insert(found.end(), {position, orientation});
  return result;
}

PoseTrajectory PoseGeometry::room_for(const Eigen::VectorXd& times, const Eigen::Matrix4d&) {
  const RowMatrix room(times.size(), 6);
  return {times, Poses(static_cast<std::size_t>(times.size())), room, room};
}

void PoseGeometry::record(PoseTrajectory& trajectory, Index k, const PoseSpace::Output& output) {
  trajectory.pose[static_cast<std::size_t>(k)] = pose_in(output);
  trajectory.twist.row(k) = twist_in(output);
  trajectory.acceleration.row(k) = twist_rate_in(output);
}

}  // namespace dmp::detail
