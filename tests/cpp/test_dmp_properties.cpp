// What holds for every movement primitive, held against random demonstrations and options.
#include <doctest/doctest.h>
#include <dmp/file.hpp>
#include <dmp/pose_dmp.hpp>
#include <dmp/so3.hpp>

#include <algorithm>
#include <complex>

#include "cases.hpp"

using namespace dmp;
using cases::Random;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Up to 40 samples at uneven times, over .1 to 30 s.
VectorXd times(Random& random) {
  const int count = random.whole(2, 40);
  VectorXd t(count);
  t[0] = random.uniform(-10.0, 10.0);
  const double usual = random.magnitude(0.1, 30.0) / count;
  for (int k = 1; k < count; ++k) t[k] = t[k - 1] + usual * random.uniform(0.5, 1.5);
  return t;
}

/// A line and two waves along each axis, of any size.
RowMatrix positions(Random& random, const VectorXd& t, Index dimension) {
  const double size = random.magnitude(1e-3, 1e3);
  RowMatrix y(t.size(), dimension);
  const VectorXd s = (t.array() - t[0]) / (t[t.size() - 1] - t[0]);
  for (Index d = 0; d < dimension; ++d) {
    const double way = random.uniform(-1, 1), wave = random.uniform(-1, 1), turns = random.uniform(0, 9);
    y.col(d) = size * (random.uniform(-1, 1) + way * s.array() + wave * (turns * s.array()).sin());
  }
  return y;
}

/// A smooth turn that stays within 2.5 rad of its end, from any orientation.
Rotations rotations(Random& random, const VectorXd& t) {
  const Matrix3d start = so3::exp(random.uniform(0.0, kPi) * random.direction());
  const Vector3d way = random.uniform(0.0, 1.2) * random.direction();
  const Vector3d wave = random.uniform(0.0, 0.5) * random.direction();
  Rotations r;
  for (const double time : t) {
    const double s = (time - t[0]) / (t[t.size() - 1] - t[0]);
    r.push_back(so3::exp(s * way + std::sin(3.0 * s) * wave) * start);
  }
  return r;
}

DmpOptions options(Random& random) {
  DmpOptions o;
  o.basis_count = random.whole(1, 30);
  o.alpha = random.uniform(4.0, 60.0);
  o.beta = o.alpha * random.uniform(0.1, 0.6);  // overdamped, critical and underdamped
  o.alpha_x = random.uniform(1.0, 8.0);
  o.kernels = random.coin() ? Kernels::equal_in_time : Kernels::source;
  o.regression = Regression::lwr;
  o.derivatives = Derivatives::interpolate;
  o.passes = random.whole(1, 10);
  o.orientation_form = random.coin() ? OrientationForm::ude : OrientationForm::log_linear;
  o.start = random.coin() ? Start::demonstrated : Start::rest;
  return o;
}

double size_of(const RowMatrix& y) { return 1e-300 + y.cwiseAbs().maxCoeff(); }

/// u and u' after s of u'' + alpha u' + alpha beta u = 0, by its two exponentials.
struct Free {
  double alpha, beta;
  std::pair<double, double> after(double s, double u, double rate) const {
    const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * alpha * alpha - alpha * beta));
    const std::complex<double> a = -0.5 * alpha + root, b = -0.5 * alpha - root;
    const std::complex<double> first = (rate - b * u) / (a - b), second = (a * u - rate) / (a - b);
    const std::complex<double> one = first * std::exp(a * s), other = second * std::exp(b * s);
    return {(one + other).real(), (a * one + b * other).real()};
  }
};

/// Runs on until the slowest part of the spring has fallen by exp(-40).
template <class Run>
void settle(Run& run, const DmpOptions& o) {
  const double slowest = std::min(0.5 * o.alpha, *o.beta);  // or faster
  for (double left = 40.0 / slowest; left > 0.0; left -= 5.0)
    CHECK(run.step(std::min(left, 5.0) * run.duration()) == Status::finished);
}

bool nearly_critical(const DmpOptions& o) { return std::abs(*o.beta / o.alpha - 0.25) < 1e-3; }

}  // namespace

TEST_CASE("a motion starts at its start and beyond its end follows the spring's closed form to the goal") {
  cases::each([](Random& random) {
    const VectorXd t = times(random);
    const DmpOptions o = options(random);
    if (nearly_critical(o)) return;  // where the closed form above divides by next to nothing
    const Dmp dmp = Dmp::fit(Demonstration(t, positions(random, t, 2)), o);
    Run run(dmp);
    CHECK(run.position() == dmp.start());
    run.step(dmp.duration());
    const Eigen::VectorXd y = run.position(), v = run.velocity();
    const double s = random.uniform(0.0, 1.0);
    run.step(s * dmp.duration());
    for (Index d = 0; d < 2; ++d) {
      const double u = y[d] - dmp.goal()[d], rate = v[d] * dmp.duration();
      const auto [place, speed] = Free{o.alpha, *o.beta}.after(s, u, rate);
      const double size = std::abs(u) + std::abs(rate) + std::abs(dmp.goal()[d]);
      CHECK(std::abs(run.position()[d] - dmp.goal()[d] - place) < 1e-10 * size);
      CHECK(std::abs(run.velocity()[d] * dmp.duration() - speed) < 1e-10 * (o.alpha * size));
    }
    settle(run, o);
    CHECK((run.position() - dmp.goal()).norm() <
          1e-12 * (size_of(y.transpose()) + v.norm() * dmp.duration() + dmp.goal().norm()));
  });
}

TEST_CASE("a motion moved, enlarged or slowed down is the same motion moved, enlarged or slowed down") {
  cases::each([](Random& random) {
    const VectorXd t = times(random);
    const RowMatrix y = positions(random, t, 3);
    const Dmp dmp = Dmp::fit(Demonstration(t, y), options(random));
    const double dt = dmp.duration() / 10;
    const Trajectory motion = dmp.rollout({}, {}, dt);
    const double size = size_of(motion.position);

    DmpParameters moved = dmp.parameters();
    const Vector3d way = size * random.direction();
    moved.start += way;
    moved.goal += way;
    const RowMatrix there = Dmp(moved).rollout({}, {}, dt).position;
    CHECK((there.rowwise() - way.transpose() - motion.position).cwiseAbs().maxCoeff() < 1e-11 * size);

    const Dmp large = Dmp::fit(Demonstration(t, RowMatrix(-8.0 * y)), dmp.options());
    CHECK((large.rollout({}, {}, dt).position + 8.0 * motion.position).cwiseAbs().maxCoeff() < 1e-9 * size);

    const Trajectory slow = dmp.rollout({}, 4.0 * dmp.duration(), 4.0 * dt);
    CHECK(slow.position == motion.position);
    CHECK(RowMatrix(4.0 * slow.velocity) == motion.velocity);
    CHECK(RowMatrix(16.0 * slow.acceleration) == motion.acceleration);
  });
}

TEST_CASE("a goal that is moved is reached, however the forcing term is scaled") {
  cases::each([](Random& random) {
    const VectorXd t = times(random);
    DmpOptions o = options(random);
    o.scaling = random.coin() ? Scaling::none : Scaling::per_axis_relative;
    const Dmp dmp = Dmp::fit(Demonstration(t, positions(random, t, 3)), o);
    const double size = size_of(dmp.goal().transpose()) + dmp.parameters().amplitude.maxCoeff();
    Run run(dmp);
    const VectorXd goal = dmp.goal() + size * random.vector(3, -1.0, 1.0);
    CHECK(run.set_goal(goal) != Status::invalid_input);
    run.step(dmp.duration());
    settle(run, o);
    CHECK((run.position() - goal).norm() < 1e-6 * (size + run.velocity().norm()));
    CHECK(run.status() == Status::finished);
  });
}

TEST_CASE("however the time is cut into steps, the motion is the same to the order of the integrator") {
  cases::each([](Random& random) {
    const VectorXd t = times(random);
    const Dmp dmp = Dmp::fit(Demonstration(t, positions(random, t, 1)), options(random));
    const Trajectory motion = dmp.rollout({}, {}, dmp.duration() / 400);
    const double range =
        motion.position.maxCoeff() - motion.position.minCoeff() + dmp.parameters().amplitude[0];
    Run run(dmp);
    for (Index k = 1; k <= 4; ++k) {
      const double first = random.uniform(0.0, 1.0);
      run.step(first * 100 * dmp.duration() / 400);
      run.step((1.0 - first) * 100 * dmp.duration() / 400);
      CHECK(std::abs(run.position()[0] - motion.position(100 * k, 0)) < 1e-6 * range);
    }
  });
}

TEST_CASE("a model is what its file says, to the last bit, and so is its motion") {
  cases::each([](Random& random) {
    const VectorXd t = times(random);
    const Dmp dmp = Dmp::fit(Demonstration(t, positions(random, t, 2)), options(random));
    const std::string text = to_json(dmp);
    const Model read = from_json(text);
    CHECK(to_json(read) == text);
    const double dt = dmp.duration() / 7;
    CHECK(std::get<Dmp>(read).rollout({}, {}, dt).position == dmp.rollout({}, {}, dt).position);
  });
}

TEST_CASE("a turn seen from another frame, of the world or of the body, is the same turn") {
  cases::each([](Random& random) {
    const VectorXd t = times(random);
    const Rotations r = rotations(random, t);
    const DmpOptions o = options(random);
    const Matrix3d world = so3::exp(random.uniform(0.0, kPi) * random.direction());
    const Matrix3d body = so3::exp(random.uniform(0.0, kPi) * random.direction());
    Rotations turned;
    for (const Matrix3d& one : r) turned.push_back(world * one * body);
    const OrientationDmp dmp = OrientationDmp::fit(OrientationDemonstration(t, r), o);
    const OrientationDmp other = OrientationDmp::fit(OrientationDemonstration(t, turned), o);
    const OrientationTrajectory motion = dmp.rollout({}, {}, dmp.duration() / 8);
    const OrientationTrajectory again = other.rollout({}, {}, dmp.duration() / 8);
    for (std::size_t k = 0; k < motion.rotation.size(); ++k) {
      CHECK(
          (motion.rotation[k] * motion.rotation[k].transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff() <
          1e-14);
      CHECK(so3::distance(world * motion.rotation[k] * body, again.rotation[k]) < 1e-11);
    }
  });
}

TEST_CASE("a turn ends at its goal; in the log-linear form by the spring's closed form") {
  cases::each([](Random& random) {
    const VectorXd t = times(random);
    const DmpOptions o = options(random);
    if (nearly_critical(o)) return;
    const OrientationDmp dmp = OrientationDmp::fit(OrientationDemonstration(t, rotations(random, t)), o);
    OrientationRun run(dmp);
    CHECK(so3::distance(run.rotation(), dmp.start()) < 3e-15);
    run.step(dmp.duration());
    const Vector3d p = so3::log(Matrix3d(run.rotation() * dmp.goal().transpose()));
    const Vector3d rate = so3::left_jacobian_inverse(p) * run.angular_velocity() * dmp.duration();
    const double s = random.uniform(0.0, 0.5);
    run.step(s * dmp.duration());
    if (o.orientation_form == OrientationForm::log_linear && p.norm() < 2.0) {
      Vector3d place;
      for (int d = 0; d < 3; ++d) place[d] = Free{o.alpha, *o.beta}.after(s, p[d], rate[d]).first;
      CHECK(so3::distance(run.rotation(), so3::exp(place) * dmp.goal()) < 1e-9 * (1.0 + rate.norm()));
    }
    settle(run, o);
    CHECK(so3::distance(run.rotation(), dmp.goal()) < 1e-9);
    CHECK(std::abs(run.quaternion().norm() - 1.0) < 1e-14);
  });
}

TEST_CASE("a pose is its position and its orientation, bit for bit") {
  cases::each([](Random& random) {
    const VectorXd t = times(random);
    const RowMatrix y = positions(random, t, 3);
    const Rotations r = rotations(random, t);
    Poses poses;
    for (Index k = 0; k < t.size(); ++k)
      poses.push_back(pose_of(r[static_cast<std::size_t>(k)], y.row(k).transpose()));
    const PoseDemonstration both(t, poses);
    const DmpOptions o = options(random);
    const PoseDmp pose = PoseDmp::fit(both, o);
    const Dmp position = Dmp::fit(both.position(), o);
    const OrientationDmp orientation = OrientationDmp::fit(both.orientation(), o);
    const double dt = pose.duration() / 6;
    const PoseTrajectory motion = pose.rollout({}, {}, dt);
    const Trajectory moved = position.rollout({}, {}, dt);
    const OrientationTrajectory turned = orientation.rollout({}, {}, dt);
    for (Index k = 0; k < motion.time.size(); ++k) {
      const Eigen::Matrix4d& one = motion.pose[static_cast<std::size_t>(k)];
      CHECK(one.topRightCorner<3, 1>() == moved.position.row(k).transpose());
      CHECK(so3::distance(one.topLeftCorner<3, 3>(), turned.rotation[static_cast<std::size_t>(k)]) < 1e-12);
    }
  });
}
