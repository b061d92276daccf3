#include <doctest/doctest.h>
#include <dmp/mailbox.hpp>
#include <dmp/pose_dmp.hpp>

#include <Eigen/Core>
#include <thread>
#include <type_traits>

#include "allocations.hpp"
#include "motions.hpp"

using namespace dmp;

static_assert(noexcept(std::declval<Mailbox<double>&>().post(0.0)));
static_assert(!std::is_copy_constructible_v<Mailbox<double>>);

TEST_CASE("what was posted last is taken once") {
  Mailbox<double> mail(0.0);
  double value = -1.0;
  CHECK_FALSE(mail.take(value));
  CHECK(value == -1.0);
  mail.post(1.0);
  mail.post(2.0);
  CHECK(mail.take(value));
  CHECK(value == 2.0);
  CHECK_FALSE(mail.take(value));
  for (int i = 3; i < 100; ++i) {
    mail.post(i);
    REQUIRE(mail.take(value));
    REQUIRE(value == i);
  }
}

TEST_CASE("two threads: every value arrives whole, none twice or out of order, the last one for certain") {
  constexpr long kPosts = 200000;
  Mailbox<Eigen::Matrix4d> mail(Eigen::Matrix4d::Zero());
  std::thread planner([&] {
    for (long i = 1; i <= kPosts; ++i) mail.post(Eigen::Matrix4d::Constant(static_cast<double>(i)));
  });
  Eigen::Matrix4d value = Eigen::Matrix4d::Zero();
  double last = 0.0;
  long torn = 0;
  long disorder = 0;
  while (last < kPosts) {
    if (!mail.take(value)) continue;
    if ((value.array() != value(0, 0)).any()) ++torn;
    if (!(value(0, 0) > last)) ++disorder;
    last = value(0, 0);
  }
  planner.join();
  CHECK(torn == 0);
  CHECK(disorder == 0);
  CHECK_FALSE(mail.take(value));
}

TEST_CASE("vectors of the size given at first change hands without memory being taken") {
  Mailbox<Eigen::VectorXd> mail(Eigen::VectorXd::Zero(7));
  const Eigen::VectorXd posted = Eigen::VectorXd::Ones(7);
  Eigen::VectorXd taken = Eigen::VectorXd::Zero(7);
  bool arrived = true;
  CHECK(allocations_in([&] {
          for (int i = 0; i < 1000; ++i) {
            mail.post(posted);
            arrived = mail.take(taken) && arrived;
          }
        }) == 0);
  CHECK(arrived);
  CHECK(taken == posted);
}

TEST_CASE("a goal and a duration from another thread lead a run there while it moves") {
  struct Wish {
    Eigen::Matrix4d goal;
    double duration;
  };
  const PoseDmp model = PoseDmp::fit(motions::pose(200, 1.0));
  PoseRun run(model);
  Wish wish{run.goal(), run.duration()};
  wish.goal(0, 3) += 0.2;
  wish.duration = 1.5;
  Mailbox<Wish> mail(wish);
  std::thread planner([&] { mail.post(wish); });
  Wish taken = wish;
  bool arrived = false;
  while (!arrived || run.step(1e-3) == Status::running) {
    if (!mail.take(taken)) continue;
    arrived = true;
    CHECK(run.set_goal(taken.goal) != Status::invalid_input);
    CHECK(run.set_duration(taken.duration) != Status::invalid_input);
  }
  planner.join();
  CHECK(run.time() > 1.2);
  CHECK((run.position() - taken.goal.topRightCorner<3, 1>()).norm() < 2e-3);
}
