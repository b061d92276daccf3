#pragma once

#include <dmp/export.hpp>
#include <dmp/obstacle.hpp>
#include <dmp/realtime.hpp>
#include <dmp/status.hpp>

#include <Eigen/Core>
#include <limits>
#include <memory>

namespace dmp {

namespace detail {
class SafetyStep;
struct SafetyAccess;
}  // namespace detail

/// What a motion must not exceed. Of a pose the axes are those of its position; of several parts, all their
/// vectors one after another. An empty vector is no limit, an infinite number no limit of that axis.
struct DMP_EXPORT SafetyLimits {
  Eigen::VectorXd lower;         ///< (axes) position
  Eigen::VectorXd upper;         ///< (axes) position
  Eigen::VectorXd velocity;      ///< (axes) per s, above 0: of both directions
  Eigen::VectorXd acceleration;  ///< (axes) per s^2, above 0
  /// Of the norm of the angular velocity (rad/s) and acceleration (rad/s^2) of every rotation.
  double angular_velocity = std::numeric_limits<double>::infinity();
  double angular_acceleration = std::numeric_limits<double>::infinity();
};

struct DMP_EXPORT SafetyOptions {
  /// What is kept from every obstacle, m, above 0: for how far the robot is behind, and the filter's own
  /// step.
  double margin = 0.01;
  /// Of the tool: a sphere around the point that moves, m.
  double radius = 0.0;
  /// How late the motion gives way: an obstacle is approached at most as exp(-gain t / duration), 1 to 100.
  double gain = 30.0;
  /// Steps are divided so that none is longer (s), or goes further than 0.005 of the duration.
  double largest_step = 0.01;
  /// Pushes along the surface of an obstacle that lies straight ahead, so that the motion goes around it.
  bool slide = true;
};

/// Stands behind a run: Stepper::step(dt, filter). It changes the output as little as it can so that limits
/// are kept and obstacles are not touched, and the run's own state with it, so that nothing winds up.
///
/// What it promises, where the motion begins within the limits, with room to stop:
/// - limits are never exceeded, whatever the motion asks for: after every step a stop within them is possible
///   (viability; Del Prete 2018, IEEE RA-L 3(1)).
/// - an obstacle that stands still is never touched: after every step it can brake along a straight line,
/// within
///   the limits, without touching any. Where nothing else is left it does, and says `blocked`.
/// - one that moves is given way to as far as the limits allow, by the velocity that it is stated to have.
/// Before that it keeps `margin`: the smallest change of the acceleration with h'' + 2 a h' + a^2 h >= 0 for
/// the distance h to every obstacle less the margin, a = gain / duration (exponential barrier; Nguyen and
/// Sreenath, ACC 2016). Where an obstacle stands straight in the way it slides along its surface.
///
/// Obstacles are for points of three axes (or fewer: the rest is 0), the position of a pose. Their velocities
/// carry them on from step to step until they are set again.
class DMP_EXPORT SafetyFilter {
 public:
  /// Room for so many obstacles (1 to 256) is taken here. Throws InvalidArgument, naming the field.
  explicit SafetyFilter(const SafetyLimits& limits = {}, int obstacles = 8,
                        const SafetyOptions& options = {});
  SafetyFilter(const SafetyFilter& other);
  SafetyFilter(SafetyFilter&& other) noexcept;
  SafetyFilter& operator=(const SafetyFilter& other);
  SafetyFilter& operator=(SafetyFilter&& other) noexcept;
  ~SafetyFilter();

  int room() const noexcept DMP_REALTIME;
  /// The obstacle of a number, 0 to room - 1, as it is now. invalid_input for another number, or what
  /// require_obstacle refuses; then nothing changes.
  Status set(int index, const Obstacle& obstacle) noexcept DMP_REALTIME;
  Status remove(int index) noexcept DMP_REALTIME;  ///< running where there was none
  void clear() noexcept DMP_REALTIME;
  /// The obstacle of a number where it has been carried to; null where there is none.
  const Obstacle* obstacle(int index) const noexcept DMP_REALTIME;
  /// How far the robot may be from where it should be, m (0 or more): kept in addition to the margin.
  Status set_tracking_error(double error) noexcept DMP_REALTIME;

  /// From the tool where the last step ended to the nearest obstacle as it is now, m; infinite if none.
  double clearance() const noexcept DMP_REALTIME;
  /// Whether the last step changed the motion.
  bool changed() const noexcept DMP_REALTIME;
  const SafetyLimits& limits() const noexcept;
  const SafetyOptions& options() const noexcept;

 private:
  friend struct detail::SafetyAccess;
  std::unique_ptr<detail::SafetyStep> step_;
};

}  // namespace dmp
