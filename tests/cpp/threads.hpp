#pragma once
// The same work on many threads at once.

#include <atomic>
#include <thread>
#include <vector>

namespace threads {

constexpr int kCount = 8;

/// Whether `same()` holds `times` times on each of eight threads that start together.
template <class Same>
bool all_same(int times, const Same& same) {
  std::atomic<int> waiting{kCount};
  std::atomic<int> wrong{0};
  std::vector<std::thread> others;
  for (int i = 0; i < kCount; ++i)
    others.emplace_back([&] {
      for (--waiting; waiting > 0;) std::this_thread::yield();
      for (int k = 0; k < times; ++k) wrong += same() ? 0 : 1;
    });
  for (std::thread& other : others) other.join();
  return wrong == 0;
}

}  // namespace threads
