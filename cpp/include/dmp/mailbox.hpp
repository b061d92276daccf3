#pragma once

#include <dmp/realtime.hpp>

#include <array>
#include <atomic>

namespace dmp {

/// The latest value, from one thread to another, without locks: a planner posts a goal, the control loop
/// takes it at its next step. Neither ever waits for the other: three places change hands by one atomic
/// exchange (Lamport 1977, CACM 20(11), on reading while writing; known as a triple buffer).
///
/// One thread may post, one other may take. What is posted before the last value was taken replaces it. T is
/// copied by assignment, which must not allocate: Eigen::Matrix4d, double, a struct of both, or an
/// Eigen::VectorXd of the size that it was given at first.
///
///   dmp::Mailbox<Eigen::Matrix4d> goals(run.goal());
///   // planner:  goals.post(cup_pose);
///   // loop:     if (goals.take(goal)) run.set_goal(goal);
template <class T>
class Mailbox {
 public:
  /// `like`: what every place holds at first, for its size; it does not count as posted.
  explicit Mailbox(const T& like) : place_{{{like}, {like}, {like}}} {}
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  /// The posting thread: makes `value` the latest.
  void post(const T& value) noexcept DMP_REALTIME {
    place_[writing_].value = value;
    writing_ = between_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// The taking thread: whether something was posted since the last time; if so `value` is the latest,
  /// otherwise it stays as it is.
  bool take(T& value) noexcept DMP_REALTIME {
    if (!(between_.load(std::memory_order_relaxed) & kFresh)) return false;
    reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    value = place_[reading_].value;
    return true;
  }

 private:
  static constexpr unsigned kIndex = 3;
  static constexpr unsigned kFresh = 4;
  static_assert(std::atomic<unsigned>::is_always_lock_free);

  struct alignas(64) Place {  // of its own cache line, so that the threads do not slow each other down
    T value;
  };
  std::array<Place, 3> place_;
  alignas(64) unsigned writing_ = 0;              // the posting thread's place
  alignas(64) std::atomic<unsigned> between_{1};  // the place that changes hands, and whether it is fresh
  alignas(64) unsigned reading_ = 2;              // the taking thread's place
};

}  // namespace dmp
