#include <doctest/doctest.h>
#include <dmp/demonstration.hpp>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <cmath>

using namespace dmp;

namespace {
Eigen::VectorXd grid(int count, double end) { return Eigen::VectorXd::LinSpaced(count, 0.0, end); }

Rotations euler_path(const Eigen::VectorXd& t) {
  Rotations rotations;
  for (const double u : t)
    rotations.push_back(so3::from_euler({.8 * std::sin(u), .5 * std::cos(u), .6 * u}, "ZYX"));
  return rotations;
}

/// omega of that path, from the rates of the angles (docs/formulation.md, E10).
Eigen::Vector3d euler_omega(double u) {
  const Eigen::Matrix3d z = so3::from_euler({.8 * std::sin(u), 0, 0}, "ZYX");
  const Eigen::Matrix3d zy = so3::from_euler({.8 * std::sin(u), .5 * std::cos(u), 0}, "ZYX");
  return .8 * std::cos(u) * Eigen::Vector3d::UnitZ() - .5 * std::sin(u) * z * Eigen::Vector3d::UnitY() +
         .6 * zy * Eigen::Vector3d::UnitX();
}
}  // namespace

TEST_CASE("the source's path has the derivatives of its closed form") {
  const Eigen::VectorXd t = grid(201, 1.0);
  RowMatrix positions(201, 3);
  for (int k = 0; k < 201; ++k) positions.row(k) << std::sin(10 * t[k]), std::cos(10 * t[k]), 400 * t[k];
  const Trajectory samples = Demonstration(t, positions).at(t);
  for (int k = 0; k < 201; ++k) {
    CHECK(std::abs(samples.velocity(k, 0) - 10 * std::cos(10 * t[k])) < 1e-6);
    CHECK(std::abs(samples.acceleration(k, 0) + 100 * std::sin(10 * t[k])) < 2e-3);
    CHECK(std::abs(samples.velocity(k, 2) - 400) < 1e-9);
  }
}

TEST_CASE("angular velocity and acceleration are those of the world frame") {
  const Eigen::VectorXd t = grid(1001, 5.0);
  const OrientationDemonstration demonstration(t, euler_path(t));
  const OrientationTrajectory samples = demonstration.at(t);
  for (int k = 0; k < 1001; k += 7) {
    CHECK((samples.angular_velocity.row(k).transpose() - euler_omega(t[k])).norm() < 1e-8);
    const Eigen::Vector3d acceleration = (euler_omega(t[k] + 1e-5) - euler_omega(t[k] - 1e-5)) / 2e-5;
    CHECK((samples.angular_acceleration.row(k).transpose() - acceleration).norm() < 1e-5);
    CHECK(so3::distance(samples.rotation[k], demonstration.rotation()[k]) < 1e-12);
  }
}

TEST_CASE("times count from the first sample") {
  const Demonstration demonstration(Eigen::Vector3d(100.0, 100.5, 101.0), RowMatrix::Ones(3, 2));
  CHECK(demonstration.time()[0] == 0.0);
  CHECK(demonstration.duration() == 1.0);
}

TEST_CASE("Euler angles over time make the orientations of their convention") {
  const Eigen::VectorXd t = grid(50, 1.0);
  RowMatrix angles(50, 3);
  for (int k = 0; k < 50; ++k) angles.row(k) << .8 * std::sin(t[k]), .5 * std::cos(t[k]), .6 * t[k];
  const auto demonstration = OrientationDemonstration::from_euler(t, angles, "ZYX");
  CHECK(so3::distance(demonstration.rotation()[30], euler_path(t)[30]) < 1e-14);
}

TEST_CASE("poses are positions and orientations side by side") {
  const Eigen::VectorXd t = grid(20, 1.0);
  Poses poses;
  for (int k = 0; k < 20; ++k) poses.push_back(pose_of(euler_path(t)[k], {t[k], 2.0, -t[k]}));
  const PoseDemonstration demonstration(t, poses);
  for (int k = 0; k < 20; ++k) CHECK((demonstration.pose()[k] - poses[k]).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("what is no demonstration is refused, with the sample named") {
  const Eigen::VectorXd t = grid(4, 1.0);
  RowMatrix y = RowMatrix::Ones(4, 2);
  CHECK_THROWS_WITH_AS(Demonstration(grid(3, 1.0), y), doctest::Contains("times: 3 of them"),
                       InvalidArgument);
  CHECK_THROWS_WITH_AS(Demonstration(Eigen::Vector4d(0, 1, 1, 2), y),
                       doctest::Contains("times[2]: 1 s after 1 s"), InvalidArgument);
  CHECK_THROWS_WITH_AS(Demonstration(Eigen::Vector4d(0, 1, NAN, 2), y), doctest::Contains("times[2]"),
                       InvalidArgument);
  CHECK_THROWS_AS(Demonstration(Eigen::VectorXd::Zero(1), RowMatrix::Zero(1, 1)), InvalidArgument);
  y(2, 1) = INFINITY;
  CHECK_THROWS_WITH_AS(Demonstration(t, y), doctest::Contains("positions[2, 1]: inf"), InvalidArgument);
  Rotations rotations(4, Eigen::Matrix3d::Identity());
  rotations[3] = so3::exp({2.0, 0, 0});
  CHECK_THROWS_WITH_AS(OrientationDemonstration(t, rotations), doctest::Contains("rotations[3]: 114.592 deg"),
                       InvalidArgument);
  rotations[3] = -Eigen::Matrix3d::Identity();
  CHECK_THROWS_WITH_AS(OrientationDemonstration(t, rotations), doctest::Contains("a reflection"),
                       InvalidArgument);
  Poses poses(4, Eigen::Matrix4d::Identity());
  poses[1](3, 0) = 1.0;
  CHECK_THROWS_WITH_AS(PoseDemonstration(t, poses), doctest::Contains("poses[1]: its last row"),
                       InvalidArgument);
}

TEST_CASE("poses are smoothed as their positions and orientations are") {
  const Eigen::VectorXd t = grid(60, 1.0);
  Poses poses;
  for (int k = 0; k < 60; ++k)
    poses.push_back(pose_of(euler_path(t)[k], {t[k] + (k % 2 ? 1e-3 : -1e-3), 2.0, -t[k]}));
  const PoseDemonstration demonstration(t, poses);
  Smoothing position, orientation, alone;
  const PoseDemonstration smooth = demonstration.smoothed(&position, &orientation);
  CHECK(smooth.position().position() == demonstration.position().smoothed(&alone).position());
  CHECK(position.removed == alone.removed);
  CHECK(position.removed[0] == doctest::Approx(1e-3).epsilon(.1));
  CHECK(smooth.orientation().rotation() == demonstration.orientation().smoothed(&alone).rotation());
  CHECK(orientation.noise == alone.noise);
  CHECK(demonstration.smoothed().pose() == smooth.pose());
}

TEST_CASE("bad poses are named as the poses that they came as") {
  const Eigen::VectorXd t = grid(4, 1.0);
  const Poses good(4, Eigen::Matrix4d::Identity());
  const auto refused = [&](const Eigen::VectorXd& times, const Poses& poses, const char* reason) {
    CHECK_THROWS_WITH_AS(PoseDemonstration(times, poses), doctest::Contains(reason), InvalidArgument);
  };
  const auto with = [&](const Eigen::Matrix4d& pose) {
    Poses poses = good;
    poses[2] = pose;
    return poses;
  };
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose(1, 3) = NAN;
  refused(t, with(pose), "poses[2]: its position");
  refused(t, with(pose_of(2.0 * Eigen::Matrix3d::Identity(), {0, 0, 0})), "poses[2]:");
  refused(t, with(pose_of(so3::exp({2.0, 0, 0}), {0, 0, 0})), "poses[2]: 114.592 deg");
  refused(grid(3, 1.0), good, "one for each of the 4 poses");
  refused(Eigen::VectorXd::Zero(1), Poses(1, pose), "poses: 1 samples");
  CHECK_THROWS_WITH_AS(PoseDemonstration(t, good).with(Poses(3, good[0])),
                       doctest::Contains("poses: 3 samples"), InvalidArgument);
}

TEST_CASE("angles and positions without a meaning are refused by name") {
  CHECK_THROWS_WITH_AS(OrientationDemonstration::from_euler(grid(4, 1.0), RowMatrix::Zero(4, 2), "ZYX"),
                       doctest::Contains("angles: 2 columns"), InvalidArgument);
  RowMatrix angles = RowMatrix::Zero(4, 3);
  angles(2, 0) = NAN;
  CHECK_THROWS_WITH_AS(OrientationDemonstration::from_euler(grid(4, 1.0), angles, "ZYX"),
                       doctest::Contains("angles[2]"), InvalidArgument);
  CHECK_THROWS_WITH_AS(Demonstration(grid(4, 1.0), RowMatrix(4, 0)),
                       doctest::Contains("positions: no columns"), InvalidArgument);
}

TEST_CASE("quaternions in either order, of either sign, make the orientations that they mean") {
  const Eigen::VectorXd t = grid(30, 1.0);
  const Rotations r = euler_path(t);
  RowMatrix scalar_first(30, 4), scalar_last(30, 4), positions(30, 3);
  Poses poses;
  for (int k = 0; k < 30; ++k) {
    const Eigen::Quaterniond q(r[k]);
    const double factor = (k % 3 == 0 ? -1.0 : 1.0) * (k % 2 ? 1.0 : 1.005);
    scalar_first.row(k) << factor * q.w(), factor * q.x(), factor * q.y(), factor * q.z();
    scalar_last.row(k) << factor * q.x(), factor * q.y(), factor * q.z(), factor * q.w();
    positions.row(k) << t[k], 2.0, -t[k];
    poses.push_back(pose_of(r[k], positions.row(k)));
  }
  const auto first = OrientationDemonstration::from_quaternions(t, scalar_first, "wxyz");
  const auto last = OrientationDemonstration::from_quaternions(t, scalar_last, "xyzw");
  for (int k = 0; k < 30; ++k) {
    CHECK(so3::distance(first.rotation()[k], r[k]) < 1e-14);
    CHECK(so3::distance(last.rotation()[k], r[k]) < 1e-14);
  }
  const auto both = PoseDemonstration::from_quaternions(t, positions, scalar_last, "xyzw");
  for (int k = 0; k < 30; ++k) CHECK((both.pose()[k] - poses[k]).cwiseAbs().maxCoeff() < 1e-14);
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(1, 0.4321);
  CHECK(so3::distance(both.orientation().at(middle).rotation[0], first.at(middle).rotation[0]) < 1e-14);
}

TEST_CASE("quaternions that are none are refused by name") {
  const Eigen::VectorXd t = grid(4, 1.0);
  RowMatrix q = RowMatrix::Zero(4, 4);
  q.col(0).setOnes();
  const RowMatrix positions = RowMatrix::Zero(4, 3);
  const auto refused = [&](const RowMatrix& quaternions, const char* order, const char* reason) {
    CHECK_THROWS_WITH_AS(OrientationDemonstration::from_quaternions(t, quaternions, order),
                         doctest::Contains(reason), InvalidArgument);
    CHECK_THROWS_WITH_AS(PoseDemonstration::from_quaternions(t, positions, quaternions, order),
                         doctest::Contains(reason), InvalidArgument);
  };
  refused(q, "zyxw", "order: 'zyxw'");
  refused(q.leftCols(3), "wxyz", "quaternions: 3 columns");
  q.row(2) *= 0.5;
  refused(q, "wxyz", "quaternions[2]: its length is 0.5");
  q(2, 1) = NAN;
  refused(q, "wxyz", "quaternions[2]");
  CHECK_THROWS_WITH_AS(PoseDemonstration::from_quaternions(t, RowMatrix::Zero(4, 2), q, "wxyz"),
                       doctest::Contains("positions: 2 columns"), InvalidArgument);
  CHECK_THROWS_WITH_AS(PoseDemonstration::from_quaternions(t, positions, RowMatrix::Zero(3, 4), "wxyz"),
                       doctest::Contains("quaternions: 3 samples"), InvalidArgument);
}
