// Eight threads that share models answer what one thread answers, bit for bit.
#include <dlfcn.h>
#include <doctest/doctest.h>
#include <pthread.h>
#include <dmp/file.hpp>
#include <dmp/parallel.hpp>
#include <dmp/pose_dmp.hpp>

#include <atomic>
#include <cerrno>
#include <climits>
#include <vector>

#include "allocations.hpp"
#include "motions.hpp"
#include "threads.hpp"

#if COUNTS_MALLOC  // a sanitizer has a pthread_create of its own
namespace {
std::atomic<int> threads_left{INT_MAX};
}
/// A machine that gives no more than `threads_left`.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                              void* of) {
  if (--threads_left < 0) return EAGAIN;
  static const auto create = reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, work, of);
}
#endif

using namespace dmp;
using threads::all_same;

namespace {

bool equal(const Trajectory& a, const Trajectory& b) {
  return a.position == b.position && a.velocity == b.velocity && a.acceleration == b.acceleration;
}
bool equal(const OrientationTrajectory& a, const OrientationTrajectory& b) {
  return a.rotation == b.rotation && a.angular_velocity == b.angular_velocity &&
         a.angular_acceleration == b.angular_acceleration;
}
bool equal(const PoseTrajectory& a, const PoseTrajectory& b) {
  return a.pose == b.pose && a.twist == b.twist && a.acceleration == b.acceleration;
}

/// Fits and rollouts of one shared demonstration and one shared model.
template <class Model, class Demonstration>
void check_sharing(const Demonstration& demonstration) {
  const Model model = Model::fit(demonstration);
  const std::string text = to_json(model);
  const auto motion = model.rollout({}, 3.0, 0.01);
  CHECK(all_same(3, [&] { return to_json(Model::fit(demonstration)) == text; }));
  CHECK(all_same(10, [&] { return equal(model.rollout({}, 3.0, 0.01), motion); }));
  CHECK(all_same(10, [&] {
    const Model copy = model;  // the last copy to go frees what is shared
    return std::get<Model>(from_json(text)).forcing().weights() == copy.forcing().weights();
  }));
}

}  // namespace

TEST_CASE("threads share demonstrations and models of positions, orientations and poses") {
  check_sharing<Dmp>(motions::helix(200, 2.0, .1, .2, 1.3));
  check_sharing<OrientationDmp>(motions::rotation(200, 2.0, 2.0));
  check_sharing<PoseDmp>(motions::pose(200, 2.0));
}

TEST_CASE("each thread steps a run of its own of one model") {
  const PoseDmp model = PoseDmp::fit(motions::pose(200, 2.0));
  const PoseRun first(model);
  const auto end_of = [&](PoseRun run) {
    run.set_duration(1.5);
    for (int i = 0; i < 400; ++i) run.step(5e-3);
    return run.pose();
  };
  const Eigen::Matrix4d end = end_of(first);
  CHECK(all_same(10, [&] { return end_of(first) == end && end_of(PoseRun(model)) == end; }));
}

TEST_CASE("work is divided among any number of threads") {
  for (const int threads : {1, 2, 8, 100000}) {
    std::vector<int> done(200, 0);
    parallel_for(200, threads, [&](Eigen::Index first, Eigen::Index last) {
      for (Eigen::Index i = first; i < last; ++i) ++done[static_cast<std::size_t>(i)];
    });
    CHECK(done == std::vector<int>(200, 1));
  }
}

#if COUNTS_MALLOC
TEST_CASE("where the machine gives no more threads, the work is done without them") {
  std::vector<int> done(8, 0);
  threads_left = 3;
  parallel_for(8, 8, [&](Eigen::Index first, Eigen::Index last) {
    for (Eigen::Index i = first; i < last; ++i) ++done[static_cast<std::size_t>(i)];
  });
  threads_left = INT_MAX;
  CHECK(done == std::vector<int>(8, 1));
}
#endif

TEST_CASE("the exception of the first part that threw arrives") {
  const auto work = [](Eigen::Index first, Eigen::Index) {
    if (first > 0) throw std::runtime_error(std::to_string(first));
  };
  CHECK_THROWS_WITH(parallel_for(8, 8, work), "1");
}
