#pragma once
// CPU time of this thread: other processes disturb it least.

#include <time.h>

#include <algorithm>
#include <functional>
#include <vector>

inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Of fifteen rounds of at least 20 ms each.
inline double median_seconds(const std::function<void()>& operation) {
  int repeats = 1;
  std::vector<double> found;
  while (found.size() < 15) {
    const double begin = thread_seconds();
    for (int i = 0; i < repeats; ++i) operation();
    const double spent = thread_seconds() - begin;
    if (spent < 0.02) {
      repeats *= 2;
    } else {
      found.push_back(spent / repeats);
    }
  }
  std::nth_element(found.begin(), found.begin() + 7, found.end());
  return found[7];
}
