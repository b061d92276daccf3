#include <doctest/doctest.h>
#include <dmp/demonstration.hpp>
#include <dmp/dtw.hpp>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

using namespace dmp;
using Eigen::Index;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RowMatrix walk(Index count, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  RowMatrix rows(count, columns);
  for (Index k = 0; k < count; ++k)
    for (Index c = 0; c < columns; ++c) rows(k, c) = normal(random) + (k > 0 ? rows(k - 1, c) : 0.0);
  return rows;
}

Poses poses_of(const RowMatrix& positions, const RowMatrix& turns) {
  Poses poses;
  for (Index k = 0; k < positions.rows(); ++k)
    poses.push_back(pose_of(so3::exp(turns.row(k).transpose()), positions.row(k).transpose()));
  return poses;
}

using Cost = std::function<double(Index, Index)>;

/// Every path there is, tried out.
double least_sum(Index i, Index j, const Cost& cost) {
  if (i == 0 && j == 0) return cost(0, 0);
  double before = kInfinity;
  if (i > 0) before = std::min(before, least_sum(i - 1, j, cost));
  if (j > 0) before = std::min(before, least_sum(i, j - 1, cost));
  if (i > 0 && j > 0) before = std::min(before, least_sum(i - 1, j - 1, cost));
  return cost(i, j) + before;
}

double shortest_leash(Index i, Index j, const Cost& cost) {
  if (i == 0 && j == 0) return cost(0, 0);
  double before = kInfinity;
  if (i > 0) before = std::min(before, shortest_leash(i - 1, j, cost));
  if (j > 0) before = std::min(before, shortest_leash(i, j - 1, cost));
  if (i > 0 && j > 0) before = std::min(before, shortest_leash(i - 1, j - 1, cost));
  return std::max(cost(i, j), before);
}

void check_path(const Alignment& alignment, Index rows, Index columns, const Cost& cost) {
  CHECK(alignment.path.front() == std::pair<Index, Index>(0, 0));
  CHECK(alignment.path.back() == std::pair<Index, Index>(rows - 1, columns - 1));
  double sum = 0.0;
  for (std::size_t k = 0; k < alignment.path.size(); ++k) {
    const auto [i, j] = alignment.path[k];
    sum += cost(i, j);
    if (k == 0) continue;
    const Index down = i - alignment.path[k - 1].first, right = j - alignment.path[k - 1].second;
    CHECK((down + right >= 1 && down >= 0 && down <= 1 && right >= 0 && right <= 1));
  }
  CHECK(sum == doctest::Approx(alignment.distance).epsilon(1e-12));
}

}  // namespace

TEST_CASE("the alignment is the best of all paths, and its distance the sum along it") {
  for (const auto& [rows, columns] : {std::pair<Index, Index>{1, 1}, {1, 6}, {6, 1}, {5, 7}, {8, 6}}) {
    const RowMatrix a = walk(rows, 2, 1), b = walk(columns, 2, 2);
    const Cost cost = [&](Index i, Index j) { return (a.row(i) - b.row(j)).norm(); };
    const Alignment alignment = align(a, b);
    CHECK(alignment.distance == doctest::Approx(least_sum(rows - 1, columns - 1, cost)).epsilon(1e-12));
    check_path(alignment, rows, columns, cost);
  }
}

TEST_CASE("poses are as far apart as their positions and their weighted angles") {
  const Poses a = poses_of(walk(6, 3, 3), walk(6, 3, 4)), b = poses_of(walk(7, 3, 5), walk(7, 3, 6));
  for (const double weight : {0.0, 0.2, 3.0}) {
    const Cost cost = [&](Index i, Index j) {
      const Eigen::Matrix4d &p = a[static_cast<std::size_t>(i)], &q = b[static_cast<std::size_t>(j)];
      return (p - q).topRightCorner<3, 1>().norm() +
             weight * so3::distance(p.topLeftCorner<3, 3>(), q.topLeftCorner<3, 3>());
    };
    const Alignment alignment = align(a, b, weight);
    CHECK(alignment.distance == doctest::Approx(least_sum(5, 6, cost)).epsilon(1e-12));
    check_path(alignment, 6, 7, cost);
  }
}

TEST_CASE("the distance of a motion from itself is zero, at half turns too") {
  RowMatrix turns = walk(50, 3, 7);
  turns.row(10) << M_PI, 0.0, 0.0;
  const Poses poses = poses_of(walk(50, 3, 8), turns);
  CHECK(align(poses, poses).distance < 1e-12);
  CHECK(align(poses, poses).path.size() == 50);
}

TEST_CASE("a band holds pairs near the straight line between the ends, and a wide one changes nothing") {
  const RowMatrix a = walk(60, 3, 9), b = walk(45, 3, 10);
  const Alignment narrow = align(a, b, 4.0);
  for (const auto& [i, j] : narrow.path)
    CHECK(std::abs(static_cast<double>(j) - 44.0 / 59.0 * static_cast<double>(i)) <= 4.0 + 1e-6);
  CHECK(narrow.distance >= align(a, b).distance);
  CHECK(align(a, b, 60.0).distance == align(a, b).distance);
}

TEST_CASE("a band in which no path would fit is widened until one does") {
  for (const auto& [rows, columns] :
       {std::pair<Index, Index>{30, 3}, {3, 30}, {1, 30}, {30, 1}, {20, 20}, {2, 2}}) {
    const RowMatrix a = walk(rows, 1, 11), b = walk(columns, 1, 12);
    const Alignment alignment = align(a, b, 0.0);
    CHECK(std::isfinite(alignment.distance));
    check_path(alignment, rows, columns, [&](Index i, Index j) { return (a.row(i) - b.row(j)).norm(); });
  }
}

TEST_CASE("the Frechet distance is the shortest leash of all walks") {
  for (const auto& [rows, columns] : {std::pair<Index, Index>{1, 1}, {1, 6}, {5, 7}, {8, 6}}) {
    const RowMatrix a = walk(rows, 2, 13), b = walk(columns, 2, 14);
    const Cost cost = [&](Index i, Index j) { return (a.row(i) - b.row(j)).norm(); };
    CHECK(frechet(a, b) == doctest::Approx(shortest_leash(rows - 1, columns - 1, cost)).epsilon(1e-14));
  }
}

TEST_CASE("what cannot be aligned is refused with the argument and the sample") {
  const RowMatrix a = walk(10, 3, 15);
  RowMatrix broken = a;
  broken(4, 1) = std::nan("");
  CHECK_THROWS_WITH_AS(align(a, broken), doctest::Contains("b[4]: not finite"), InvalidArgument);
  CHECK_THROWS_WITH_AS(frechet(broken, a), doctest::Contains("a[4]: not finite"), InvalidArgument);
  CHECK_THROWS_WITH_AS(align(a, walk(5, 2, 1)), doctest::Contains("b: 2 columns, expected 3"),
                       InvalidArgument);
  CHECK_THROWS_WITH_AS(align(RowMatrix(0, 3), a), doctest::Contains("a: no samples"), InvalidArgument);
  CHECK_THROWS_WITH_AS(align(a, a, -1.0), doctest::Contains("band: -1"), InvalidArgument);
  CHECK_THROWS_WITH_AS(align(a, a, std::nan("")), doctest::Contains("band"), InvalidArgument);
  Poses poses = poses_of(a, a);
  CHECK_THROWS_WITH_AS(align(poses, poses, -0.1), doctest::Contains("angle_weight"), InvalidArgument);
  CHECK_THROWS_WITH_AS(align(poses, Poses{}), doctest::Contains("b: no samples"), InvalidArgument);
  poses[3](0, 3) = std::nan("");
  CHECK_THROWS_WITH_AS(align(poses_of(a, a), poses), doctest::Contains("b[3]: not finite"), InvalidArgument);
  poses[2].topLeftCorner<3, 3>() *= -1.0;
  CHECK_THROWS_WITH_AS(align(poses, poses), doctest::Contains("a[2]"), InvalidArgument);
}
