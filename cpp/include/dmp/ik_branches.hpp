#pragma once

#include <dmp/arm.hpp>
#include <dmp/export.hpp>
#include <dmp/inverse_kinematics.hpp>

#include <Eigen/Core>
#include <memory>
#include <optional>

namespace dmp {

/// Documented defaults; IkBranches throws InvalidArgument for values out of range.
struct BranchOptions {
  double apart = 0.3;  ///< rad or m, > 0: some joint of a new branch is that far from every one before
  int tries = 200;     ///< descents from random joints after which one call gives up, > 0
};

/// The different joints that meet one pose, one after the other, for a user who chooses among them: elbow up
/// or down, wrist flipped, the windings of joints wider than a turn. A redundant arm meets a pose
/// in a continuum of ways; then these are samples of it. The same arguments give the same joints.
class DMP_EXPORT IkBranches {
 public:
  /// `seed` (n): the first branch is the one a descent from there finds. Throws InvalidArgument for a pose or
  /// seed that is none (IkStatus::invalid_input says which), or an option out of range. Of the IkOptions the
  /// tolerances, weights and the random seed count.
  IkBranches(Arm arm, const Eigen::Matrix4d& pose, const Eigen::VectorXd& seed, const IkOptions& options = {},
             const BranchOptions& branches = {});
  IkBranches(IkBranches&&) noexcept;
  IkBranches& operator=(IkBranches&&) noexcept;
  ~IkBranches();

  /// Joints that meet the pose unlike all before, within the limits; none when `tries` found no more.
  std::optional<IkResult> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dmp
