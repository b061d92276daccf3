#include <dmp/error.hpp>
#include <dmp/ik_branches.hpp>

#include <algorithm>

#include "geometry/pose.hpp"
#include "kinematics/ik_search.hpp"
#include "kinematics/random.hpp"
#include "robot/checks.hpp"

namespace dmp {
namespace {

constexpr int iterations_each = 100;

detail::Frame checked_target(const Eigen::Matrix4d& pose) {
  if (!detail::is_pose(pose))
    throw InvalidArgument("pose: expected a finite [R p; 0 1] with R orthonormal to 1e-3 and det(R) = +1.");
  return detail::rigid_frame(pose);
}

detail::Joints checked_seed(const Eigen::VectorXd& seed, const detail::JointRange& range) {
  detail::check_joints(seed, range.lower.size(), "seed");
  return detail::Joints(seed).cwiseMax(range.lower).cwiseMin(range.upper);
}

}  // namespace

/// The arm comes first: the search refers to its model.
struct IkBranches::State {
  State(Arm arm_, const Eigen::Matrix4d& pose, const Eigen::VectorXd& seed, const IkOptions& options,
        const BranchOptions& branches_)
      : arm(std::move(arm_)),
        branches(branches_),
        search(arm.model(), options),
        target(checked_target(pose)),
        start(checked_seed(seed, search.range())),
        sampled(search.range().lower, search.range().upper, start),
        random(options.random_seed) {}

  bool is_new(const detail::Joints& q) const {
    return std::none_of(found.begin(), found.end(), [&](const detail::Joints& other) {
      return (other - q).cwiseAbs().maxCoeff() < branches.apart;
    });
  }

  Arm arm;
  BranchOptions branches;
  detail::IkSearch search;
  detail::Frame target;
  detail::Joints start;
  detail::FiniteRange sampled;
  detail::Random random;
  std::vector<detail::Joints> found;
};

IkBranches::IkBranches(Arm arm, const Eigen::Matrix4d& pose, const Eigen::VectorXd& seed,
                       const IkOptions& options, const BranchOptions& branches) {
  detail::check_positive(branches.apart, "apart");
  detail::check_positive(branches.tries, "tries");
  const InverseKinematics checked(arm, options);
  state_ = std::make_unique<State>(std::move(arm), pose, seed, options, branches);
}
IkBranches::IkBranches(IkBranches&&) noexcept = default;
IkBranches& IkBranches::operator=(IkBranches&&) noexcept = default;
IkBranches::~IkBranches() = default;

std::optional<IkResult> IkBranches::next() {
  State& s = *state_;
  const detail::JointRange& range = s.search.range();
  for (int i = 0; i < s.branches.tries; ++i) {
    const detail::Descent end =
        s.search.lm().descend(s.target, s.start, range.lower, range.upper, iterations_each);
    s.start = s.random.between(s.sampled.lower, s.sampled.upper);
    if (!end.converged || !s.is_new(end.joints)) continue;
    s.found.push_back(end.joints);
    return s.search.result(s.target, end.joints, end.iterations);
  }
  return std::nullopt;
}

}  // namespace dmp
