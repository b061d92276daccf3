#pragma once

#include <dmp/export.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dmp {

namespace detail {
struct ChainModel;
}

/// Kinds of joint limits.
enum class LimitKind { position, velocity, acceleration, jerk, effort };

/// Where a joint limit comes from.
enum class LimitSource {
  unstated,  ///< nobody states one: the limit is infinite
  urdf,      ///< the robot's description
  maker,     ///< the maker's data sheet
  user,      ///< the caller
  assumed    ///< a usual value, in place of one that nobody states
};

/// Joint acceleration [rad/s^2 or m/s^2] that is assumed where nobody states a limit: a URDF 1.0 cannot.
inline constexpr double assumed_acceleration = 10.0;

/// The sources of each kind of limit (indexed by LimitKind), one for each joint.
using LimitSources = std::array<std::vector<LimitSource>, 5>;

/// Replacements for the joint limits of an arm, each of n values or absent (then what the arm has stays).
struct LimitOverrides {
  std::optional<Eigen::VectorXd> lower;                        ///< rad or m
  std::optional<Eigen::VectorXd> upper;                        ///< rad or m
  std::optional<Eigen::VectorXd> velocity;                     ///< rad/s or m/s, > 0
  std::optional<Eigen::VectorXd> effort;                       ///< N m or N, > 0
  std::optional<Eigen::VectorXd> acceleration = std::nullopt;  ///< rad/s^2 or m/s^2, > 0
  std::optional<Eigen::VectorXd> jerk = std::nullopt;          ///< rad/s^3 or m/s^3, > 0
  std::optional<double> tool_speed = std::nullopt;             ///< m/s, > 0
  LimitSource source = LimitSource::user;  ///< of the values given here; infinite ones are unstated
  LimitSources sources = {};               ///< in place of `source` where joints differ; else empty
};

/// The serial chain of n free joints from the link `base` to the link `tip` of a robot.
///
/// An immutable value: copies share their data, and any number of threads may use one Arm. Revolute,
/// continuous and prismatic joints count; fixed joints are folded away; a mimic joint moves with its master
/// and is not counted. Units are radians for turning joints and metres for sliding ones; poses are tip in
/// base.
class DMP_EXPORT Arm {
 public:
  /// Reads a URDF. `base` "" is the root link; `tip` "" is the tool at the end of the longest chain of arm
  /// joints: no gripper's joint is one, and frames named tcp, tool0, grasp, end_effector, tool or hand are
  /// preferred (choice() says what was taken). Throws InvalidArgument, naming the joint or link, when urdfdom
  /// refuses the text; when a link does not exist; when several arms could be meant or the last joint could
  /// be a jaw (the message has one line for each); when tip is not below base; when a joint
  /// between base and tip is floating or planar, or has no axis, no limits, or lower >= upper; when a mimic
  /// joint's master is not between base and tip; when links form a cycle. Non-fatal problems are listed in
  /// warnings(). Mesh paths are relative to `folder`.
  static Arm from_urdf(const std::string& text, const std::string& base = "", const std::string& tip = "",
                       const std::string& folder = "");
  /// Reads a URDF file; mesh paths are relative to its folder. Throws FileError if it cannot be read.
  static Arm from_urdf_file(const std::string& path, const std::string& base = "",
                            const std::string& tip = "");

  /// A copy with other limits, for a URDF whose own are placeholders or to run a robot below its limits.
  /// Throws InvalidArgument unless the sizes are n, lower < upper, and all other limits are > 0.
  Arm with_limits(const LimitOverrides& limits) const;

  /// A copy whose tip is a frame fixed to this one's, for what a flange carries: `frame` is the tool in the
  /// tip, [R p; 0 1] in m with R in SO(3) to 1e-3. Its link is called `tip`_tool and weighs nothing.
  Arm with_tool(const Eigen::Matrix4d& frame) const;

  const std::string& name() const;
  const std::string& base() const;
  const std::string& tip() const;
  /// "6 joints, j1 to j6; held still: jaw" where base and tip were chosen; "" where both were stated.
  const std::string& choice() const;
  Eigen::Index joint_count() const;                     ///< n
  const std::vector<std::string>& joint_names() const;  ///< n, from base to tip
  const Eigen::VectorXd& lower() const;                 ///< (n); -infinity for a continuous joint
  const Eigen::VectorXd& upper() const;                 ///< (n); +infinity for a continuous joint
  const Eigen::VectorXd& velocity_limit() const;        ///< (n) rad/s or m/s; +infinity where none is stated
  const Eigen::VectorXd& acceleration_limit()
      const;                                    ///< (n) rad/s^2 or m/s^2; assumed_acceleration if unstated
  const Eigen::VectorXd& jerk_limit() const;    ///< (n) rad/s^3 or m/s^3; +infinity where none is stated
  const Eigen::VectorXd& effort_limit() const;  ///< (n) N m or N; +infinity where none is stated
  double tool_speed_limit() const;              ///< m/s of the tip; +infinity where none is stated
  const std::vector<LimitSource>& limit_sources(LimitKind kind) const;  ///< n, from base to tip
  const std::vector<std::string>& warnings() const;  ///< non-fatal problems of the URDF, one sentence each
  const std::string& urdf() const;                   ///< the text that was read
  const std::string& folder() const;                 ///< to which mesh paths are relative; "" if unknown

  /// The pose of the tip in the base frame at the joints q (n), by KDL. Limits are not checked.
  /// Throws InvalidArgument if q has another size or is not finite.
  Eigen::Matrix4d forward_kinematics(const Eigen::VectorXd& q) const;
  /// One pose for each row of q (T x n).
  Poses forward_kinematics(const RowMatrix& q) const;
  /// (6 x n) by KDL: velocity of the tip (rows 0-2, m/s) and angular velocity (rows 3-5, rad/s), in the base
  /// frame.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& q) const;
  /// sqrt(det(J J^T)): the volume of reachable twists (Yoshikawa 1985). 0 where the arm is singular.
  double manipulability(const Eigen::VectorXd& q) const;

  /// Gravity in the base frame [m/s^2]: 9.81 along -z of the URDF's root. Joints above the base stand in the
  /// middle of their range, or at 0 without one.
  Eigen::Vector3d gravity() const;
  /// (n) N m or N for `acceleration` (n) at joints q (n) that move with `velocity` (n), by KDL's recursive
  /// Newton-Euler under gravity(), with the inertias of the URDF and without friction; joints beside the way
  /// from base to tip stand in the middle of their range. Throws InvalidArgument for other sizes or if not
  /// finite.
  Eigen::VectorXd inverse_dynamics(const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
                                   const Eigen::VectorXd& acceleration) const;
  /// (T x n) N m or N that hold the arm still at each row of q (T x n).
  RowMatrix gravity_effort(const RowMatrix& q) const;

  /// For dmp::kinematics itself.
  const detail::ChainModel& model() const { return *model_; }

 private:
  explicit Arm(std::shared_ptr<const detail::ChainModel> model);
  std::shared_ptr<const detail::ChainModel> model_;
};

}  // namespace dmp
