#include <doctest/doctest.h>
#include <dmp/distribution.hpp>
#include <dmp/error.hpp>
#include <dmp/file.hpp>

#include <Eigen/Dense>

#include "varied.hpp"

using namespace dmp;
using namespace varied;

namespace {

const PoseDistribution& learned() {
  static const PoseDistribution distribution = PoseDistribution::fit(poses(8, 1));
  return distribution;
}

double apart(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) {
  return (a.topRightCorner<3, 1>() - b.topRightCorner<3, 1>()).norm() +
         so3::distance(a.topLeftCorner<3, 3>(), b.topLeftCorner<3, 3>());
}

Eigen::Matrix4d turned(Eigen::Matrix4d pose, const Eigen::Vector3d& by, const Eigen::Vector3d& moved) {
  pose.topLeftCorner<3, 3>() = so3::exp(by) * pose.topLeftCorner<3, 3>();
  pose.topRightCorner<3, 1>() += moved;
  return pose;
}

}  // namespace

TEST_CASE("a pose and a twist that are given exactly are met") {
  const PoseDistribution& d = learned();
  const Eigen::Matrix4d pose = turned(d.rollout(3).pose[1], {.3, -.2, .5}, {.02, .03, -.01});
  Eigen::Matrix<double, 6, 1> twist;
  twist << .1, .2, -.1, .5, -.4, .3;
  const PoseDistribution found = d.condition({Given<PoseSpace>(.5, pose, twist)});
  const PoseTrajectory motion = found.rollout(101);
  CHECK(apart(motion.pose[50], pose) < 1e-9);
  CHECK((motion.twist.row(50).transpose() - twist).norm() < 1e-9);
  CHECK(found.spread(3).covariance[1].norm() < 1e-18);
  CHECK(apart(found.mean().rollout_at(VectorXd::Constant(1, 1.0)).pose[0], pose) < 2e-3);
}

TEST_CASE("twists are those of the motion itself") {
  const PoseTrajectory motion = learned().sample(5, 4001);
  const double dt = motion.time[1];
  for (const std::size_t k : {500u, 2000u, 3300u}) {
    const Eigen::Matrix4d &before = motion.pose[k - 1], &behind = motion.pose[k + 1];
    const Eigen::Matrix3d turn = behind.topLeftCorner<3, 3>() * before.topLeftCorner<3, 3>().transpose();
    Eigen::Matrix<double, 6, 1> twist;
    twist << (behind - before).topRightCorner<3, 1>() / (2 * dt), so3::log(turn) / (2 * dt);
    CHECK((motion.twist.row(static_cast<Index>(k)).transpose() - twist).norm() < 1e-5);
  }
}

TEST_CASE("no orientation of the world is special") {
  const Eigen::Matrix3d q = so3::exp({1.2, -2.0, .7});
  Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
  world.topLeftCorner<3, 3>() = q;
  std::vector<PoseDemonstration> moved;
  for (const PoseDemonstration& one : poses(8, 1)) {
    Poses path;
    for (const Eigen::Matrix4d& pose : one.pose()) path.push_back(world * pose);
    moved.emplace_back(one.time(), path);
  }
  const PoseDistribution other = PoseDistribution::fit(moved);
  Given<PoseSpace> given(.6, turned(learned().rollout(6).pose[3], {.1, .2, -.3}, {.01, 0, .02}));
  given.covariance = 1e-4 * MatrixXd::Identity(6, 6);
  Given<PoseSpace> there = given;
  there.point = world * *given.point;
  const auto motion = learned().condition({given}).rollout(21);
  const auto again = other.condition({there}).rollout(21);
  for (std::size_t k = 0; k < 21; ++k) CHECK(apart(world * motion.pose[k], again.pose[k]) < 1e-7);
  CHECK(other.distance(there) == doctest::Approx(learned().distance(given)).epsilon(1e-6));
}

TEST_CASE("motions of several turns are learned and conditioned as others are") {
  const PoseDistribution d = PoseDistribution::fit(poses(6, 2, 3.0, 400));
  const auto unseen = poses(1, 50, 3.0, 400).front();
  const auto mean = d.rollout(400);
  for (std::size_t k = 0; k < 400; k += 40) CHECK(apart(mean.pose[k], unseen.pose()[k]) < .4);
  const Eigen::Matrix4d pose = turned(d.rollout(3).pose[1], {.2, .1, 0}, {.01, 0, 0});
  CHECK(apart(d.condition({Given<PoseSpace>(.5, pose)}).rollout(3).pose[1], pose) < 1e-9);
}

TEST_CASE("positions of a pose may be known alone: rotations follow as far as they vary together") {
  const PoseDistribution& d = learned();
  Given<PoseSpace> given(1.0, turned(d.rollout(3).pose[2], {1, 0, 0}, {.02, .01, 0}));
  given.axes = {0, 1, 2};
  const PoseDistribution found = d.condition({given});
  const Eigen::Matrix4d end = found.rollout(3).pose[2];
  CHECK((end - *given.point).topRightCorner<3, 1>().norm() < 1e-12);
  CHECK(so3::distance(end.topLeftCorner<3, 3>(), given.point->topLeftCorner<3, 3>()) > .5);
}

TEST_CASE("a pose that was measured counts as far as it is trusted") {
  const PoseDistribution& d = learned();
  const Eigen::Matrix4d pose = turned(d.rollout(3).pose[1], {0, 0, .2}, {.03, 0, 0});
  double last = 1.0;
  for (const double trust : {1.0, 1e-2, 1e-4, 1e-6}) {
    Given<PoseSpace> given(.5, pose);
    given.covariance = trust * d.observation_covariance(.5);
    const double left = apart(d.condition({given}).rollout(3).pose[1], pose);
    CHECK(left < last);
    last = left;
  }
  CHECK(last < 1e-3);
}

TEST_CASE("a take that turns the other way does not belong to the others") {
  auto mixed = poses(5, 3, .7);
  Poses other;
  for (const Eigen::Matrix4d& pose : poses(1, 4, -.7).front().pose()) other.push_back(pose);
  mixed[2] = mixed[2].with(other);
  CHECK_THROWS_WITH_AS(PoseDistribution::fit(mixed), doctest::Contains("demonstrations[2]"), InvalidArgument);
}

TEST_CASE("orientations alone, and a pose with a gripper") {
  std::vector<OrientationDemonstration> turns;
  std::vector<PoseGripperDemonstration> grips;
  for (const PoseDemonstration& one : poses(5, 6)) {
    turns.push_back(one.orientation());
    RowMatrix gripper(one.size(), 1);
    for (Index k = 0; k < one.size(); ++k) gripper(k, 0) = one.position().position()(k, 0);
    grips.emplace_back(one, Demonstration(one.time(), gripper));
  }
  const auto d = OrientationDistribution::fit(turns);
  const Eigen::Matrix3d way = so3::exp({.2, .3, 0}) * d.rollout(3).rotation[1];
  CHECK(so3::distance(d.condition({Given<RotationSpace>(.5, way)}).rollout(3).rotation[1], way) < 1e-9);
  CHECK(d.log_likelihood(turns[0]) > 0.0);
  CHECK(to_json(from_json(to_json(d))) == to_json(d));

  // The opening is x: what is known of one is known of the other.
  const auto both = PoseGripperDistribution::fit(grips);
  CHECK(both.parameters().noise.size() == 3);
  Given<PoseGripperSpace> given(1.0, both.mean().goal());
  given.point->second[0] += .02;
  given.axes = {6};
  const auto found = both.condition({given}).rollout(3);
  CHECK(found.second.position(2, 0) == doctest::Approx(given.point->second[0]));
  CHECK(found.first.pose[2](0, 3) - both.rollout(3).first.pose[2](0, 3) > .005);
  CHECK(to_json(from_json(to_json(both))) == to_json(both));
}

TEST_CASE("a pose distribution comes back bit for bit") {
  const auto back = std::get<PoseDistribution>(from_json(to_json(learned())));
  CHECK(to_json(back) == to_json(learned()));
  CHECK(back.sample(2).pose == learned().sample(2).pose);
}
