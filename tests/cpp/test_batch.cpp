#include <dmp/batch.hpp>
#include <dmp/error.hpp>

#include <doctest/doctest.h>

#include <functional>
#include <string>

#include "motions.hpp"

using namespace dmp;

namespace {

constexpr int kCount = 7;

Eigen::VectorXd grid() { return Eigen::VectorXd::LinSpaced(300, 0.0, 1.5); }

RowMatrix positions(int j) {
  RowMatrix y(300, 3);
  for (int k = 0; k < 300; ++k) {
    const double s = k / 299.0;
    y.row(k) << 0.3 * s + 0.02 * j * std::sin(5 * s), std::cos(2 * s + j), s * s * (j + 1);
  }
  return y;
}

Poses poses(int j) {
  const RowMatrix y = positions(j);
  Poses result;
  for (int k = 0; k < 300; ++k)
    result.push_back(pose_of(so3::from_euler({0.3 * k / 299.0, 0.1 * j, 0.2}, "ZYX"), y.row(k)));
  return result;
}

template <class Value, class Make>
std::vector<Value> all(Make make) {
  std::vector<Value> values;
  for (int j = 0; j < kCount; ++j) values.push_back(make(j));
  return values;
}

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE(
    "many demonstrations on one grid give the models of single fits, bit for bit, on any number of threads") {
  for (const int threads : {1, 2, 5, 0}) {
    const auto models = fit_each(grid(), all<RowMatrix>(positions), {}, threads);
    const auto pose_models = fit_each(grid(), all<Poses>(poses), {}, threads);
    REQUIRE(models.size() == kCount);
    for (int j = 0; j < kCount; ++j) {
      CHECK(models[j].parameters().weights ==
            Dmp::fit(Demonstration(grid(), positions(j))).parameters().weights);
      CHECK(pose_models[j].parameters().weights ==
            PoseDmp::fit(PoseDemonstration(grid(), poses(j))).parameters().weights);
    }
  }
}

TEST_CASE("demonstrations of different grids and dimensions fit one after another as they fit alone") {
  const Eigen::VectorXd other = Eigen::VectorXd::LinSpaced(200, 0.0, 3.0);
  const std::vector<Demonstration> demonstrations{{grid(), positions(0)},
                                                  {other, positions(1).topRows(200)},
                                                  {grid(), positions(2).leftCols(2)},
                                                  {grid(), positions(3)}};
  for (const Scaling scaling : {Scaling::none, Scaling::per_axis_relative, Scaling::rotation_dilation}) {
    DmpOptions options;
    options.scaling = scaling;
    const auto models = fit_each(demonstrations, options);
    for (std::size_t j = 0; j < demonstrations.size(); ++j)
      CHECK(models[j].parameters().weights == Dmp::fit(demonstrations[j], options).parameters().weights);
  }
}

TEST_CASE("many rollouts are the single ones, bit for bit") {
  const Dmp dmp = Dmp::fit(Demonstration(grid(), positions(1)));
  const PoseDmp pose = PoseDmp::fit(PoseDemonstration(grid(), poses(1)));
  const auto goals = all<Eigen::VectorXd>([](int j) { return Eigen::Vector3d(j, 1, -j); });
  const auto pose_goals = all<Eigen::Matrix4d>([](int j) { return poses(j).back(); });
  const Eigen::VectorXd durations = Eigen::VectorXd::LinSpaced(kCount, 0.5, 4.0);
  for (const int threads : {1, 3}) {
    const auto motions = rollout_each(dmp, goals, durations, 101, threads);
    const auto pose_motions = rollout_each(pose, pose_goals, {}, 57, threads);
    for (int j = 0; j < kCount; ++j) {
      REQUIRE(motions[j].time.size() == 101);
      CHECK(motions[j].time[100] == doctest::Approx(durations[j]));
      CHECK(motions[j].position == dmp.rollout(goals[j], durations[j], durations[j] / 100).position);
      CHECK(pose_motions[j].pose == pose.rollout(pose_goals[j], pose.duration(), pose.duration() / 56).pose);
    }
  }
  CHECK(rollout_each(dmp, {}, durations, 11).size() == kCount);
  CHECK(rollout_each(dmp, {}, {}, 11).empty());
}

TEST_CASE("a bad one among many is named") {
  auto bad = all<RowMatrix>(positions);
  bad[4](17, 2) = NAN;
  CHECK(message_of([&] { fit_each(grid(), bad, {}, 3); }).rfind("demonstrations[4]: positions[17, 2]", 0) ==
        0);
  bad[4] = positions(4).topRows(299);
  CHECK(message_of([&] { fit_each(grid(), bad); }).rfind("demonstrations[4]: positions: 299 samples", 0) ==
        0);
  const Dmp dmp = Dmp::fit(Demonstration(grid(), positions(1)));
  CHECK(message_of([&] {
          rollout_each(dmp, {}, Eigen::Vector2d(1, -1), 11, 2);
        }).rfind("rollouts[1]: duration", 0) == 0);
  CHECK(message_of([&] {
          rollout_each(dmp, {Eigen::Vector3d::Zero()}, Eigen::Vector2d(1, 1), 11);
        }).rfind("durations: 2 for 1 goals", 0) == 0);
  CHECK(message_of([&] { fit_each(grid(), bad, {}, -1); }).rfind("threads: -1", 0) == 0);
}

TEST_CASE("orientations and poses fit one after another as they fit alone, on a grid or each on its own") {
  const auto turns = [](int j) { return PoseDemonstration(grid(), poses(j)).orientation().rotation(); };
  const auto on_grid = fit_each(grid(), all<Rotations>(turns));
  std::vector<OrientationDemonstration> orientations;
  std::vector<PoseDemonstration> both;
  for (int j = 0; j < kCount; ++j) {
    const Eigen::VectorXd times = (1.0 + 0.1 * j) * grid();
    orientations.emplace_back(times, turns(j));
    both.emplace_back(times, poses(j));
  }
  const auto apart = fit_each(orientations, {}, 2);
  const auto pose_models = fit_each(both, {}, 2);
  for (int j = 0; j < kCount; ++j) {
    CHECK(on_grid[j].parameters().weights ==
          OrientationDmp::fit(OrientationDemonstration(grid(), turns(j))).parameters().weights);
    CHECK(apart[j].parameters().weights == OrientationDmp::fit(orientations[j]).parameters().weights);
    CHECK(pose_models[j].parameters().weights == PoseDmp::fit(both[j]).parameters().weights);
  }
}

namespace {

/// The motions handed over are those that are kept, each once, by any number of threads.
template <class Motion, class Model, class Goals, class Equal>
void check_handed_over(const Model& model, const Goals& goals, const Equal& equal) {
  const Eigen::VectorXd durations = Eigen::VectorXd::LinSpaced(kCount, 0.5, 4.0);
  const auto kept = rollout_each(model, goals, durations, 31);
  for (const int threads : {1, 3}) {
    std::vector<int> times_taken(kCount, 0);
    std::vector<int> alike(kCount, 0);
    const Take<Motion> take = [&](Eigen::Index m, const Motion& motion) {
      ++times_taken[static_cast<std::size_t>(m)];
      alike[static_cast<std::size_t>(m)] = equal(motion, kept[static_cast<std::size_t>(m)]);
    };
    rollout_each(model, goals, durations, 31, take, threads);
    CHECK(times_taken == std::vector<int>(kCount, 1));
    CHECK(alike == std::vector<int>(kCount, 1));
  }
  CHECK(message_of([&] { rollout_each(model, goals, durations, 1); }).rfind("samples: 1", 0) == 0);
  CHECK(message_of([&] {
          rollout_each(model, goals, durations.head(2), 31);
        }).rfind("durations: 2 for 7 goals", 0) == 0);
  CHECK(message_of([&] {
          rollout_each(model, goals, -durations, 31, 2);
        }).rfind("rollouts[0]: duration", 0) == 0);
}

}  // namespace

TEST_CASE("motions that are handed over one by one are those that rollout_each keeps") {
  const PoseDemonstration demonstration(grid(), poses(1));
  check_handed_over<Trajectory>(
      Dmp::fit(demonstration.position()),
      all<Eigen::VectorXd>([](int j) { return Eigen::VectorXd(Eigen::Vector3d(j, 1, -j)); }),
      [](const Trajectory& a, const Trajectory& b) { return a.position == b.position; });
  check_handed_over<OrientationTrajectory>(
      OrientationDmp::fit(demonstration.orientation()),
      all<Eigen::Matrix3d>([](int j) { return so3::exp({0.1 * j, 0.2, 0}); }),
      [](const OrientationTrajectory& a, const OrientationTrajectory& b) {
        return a.rotation == b.rotation;
      });
  check_handed_over<PoseTrajectory>(
      PoseDmp::fit(demonstration), all<Eigen::Matrix4d>([](int j) { return poses(j).back(); }),
      [](const PoseTrajectory& a, const PoseTrajectory& b) { return a.pose == b.pose; });
}

TEST_CASE("a bad one among many orientations or poses is named, whichever way they came") {
  auto bad = all<Poses>(poses);
  bad[2][9](0, 0) = NAN;
  CHECK(message_of([&] { fit_each(grid(), bad, {}, 3); }).rfind("demonstrations[2]: poses[9]", 0) == 0);
  std::vector<Rotations> turns(3, Rotations(300, Eigen::Matrix3d::Identity()));
  turns[1][5] *= 2.0;
  CHECK(message_of([&] { fit_each(grid(), turns); }).rfind("demonstrations[1]: rotations[5]", 0) == 0);
  DmpOptions options;
  options.basis_count = -1;
  const std::vector<OrientationDemonstration> good{{grid(), Rotations(300, Eigen::Matrix3d::Identity())}};
  CHECK(message_of([&] { fit_each(good, options); }).rfind("demonstrations[0]: options.basis_count", 0) == 0);
  const std::vector<PoseDemonstration> both{{grid(), poses(0)}};
  CHECK(message_of([&] { fit_each(both, options); }).rfind("demonstrations[0]: options.basis_count", 0) == 0);
}
