#include <doctest/doctest.h>
#include <dmp/error.hpp>
#include <dmp/ik_branches.hpp>

#include <cmath>

#include "arms.hpp"

using dmp::Arm;
using dmp::IkBranches;

namespace {

std::vector<Eigen::VectorXd> all(IkBranches branches) {
  std::vector<Eigen::VectorXd> found;
  while (const auto one = branches.next()) {
    REQUIRE(one->ok());
    found.push_back(one->joints);
  }
  return found;
}

}  // namespace

TEST_CASE(
    "The two elbows of the two-link arm are all its branches when the tool may turn, the seed's first") {
  const Arm arm = Arm::from_urdf(arms::two_link());
  dmp::IkOptions options;
  options.weight << 1, 1, 1, 0, 0, 0;
  const Eigen::Vector2d q(0.3, 1.2);
  const Eigen::Matrix4d pose = arm.forward_kinematics(Eigen::VectorXd(q));
  const auto found = all(IkBranches(arm, pose, Eigen::Vector2d(0.2, 1.0), options));
  REQUIRE(found.size() == 2);
  CHECK((found[0] - q).norm() < 1e-5);
  CHECK((found[1] - Eigen::Vector2d(1.5, -1.2)).norm() < 1e-5);  // the mirror image in the closed form
}

TEST_CASE(
    "Branches meet the pose within the limits, differ from each other, and come in the same order again") {
  const Arm arm = Arm::from_urdf(arms::seven_joints());
  std::mt19937 random(3);
  const Eigen::Matrix4d pose = arm.forward_kinematics(arms::random_joints(arm, random));
  const Eigen::VectorXd seed = Eigen::VectorXd::Constant(7, -0.5);
  dmp::BranchOptions sparse;
  sparse.apart = 1.0;
  const auto found = all(IkBranches(arm, pose, seed, {}, sparse)),
             again = all(IkBranches(arm, pose, seed, {}, sparse));
  CHECK(found.size() > 3);
  CHECK(found == again);
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(arms::within_limits(arm, found[i]));
    CHECK((arm.forward_kinematics(found[i]) - pose).cwiseAbs().maxCoeff() < 1e-5);
    for (std::size_t k = 0; k < i; ++k) CHECK((found[i] - found[k]).cwiseAbs().maxCoeff() >= 1.0);
  }
}

TEST_CASE("A pose out of reach has no branches; what is no pose is refused") {
  const Arm arm = Arm::from_urdf(arms::two_link());
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose(0, 3) = 5.0;
  CHECK(all(IkBranches(arm, pose, Eigen::Vector2d::Zero())).empty());
  CHECK_THROWS_WITH_AS(IkBranches(arm, pose, Eigen::Vector3d::Zero()), doctest::Contains("seed"),
                       dmp::InvalidArgument);
  pose(0, 3) = std::nan("");
  CHECK_THROWS_WITH_AS(IkBranches(arm, pose, Eigen::Vector2d::Zero()), doctest::Contains("pose"),
                       dmp::InvalidArgument);
  dmp::BranchOptions none;
  none.tries = 0;
  CHECK_THROWS_WITH_AS(IkBranches(arm, Eigen::Matrix4d::Identity(), Eigen::Vector2d::Zero(), {}, none),
                       doctest::Contains("tries"), dmp::InvalidArgument);
}
