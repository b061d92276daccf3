#pragma once
// Counts every allocation of the process. To be included in one source file of a test only.

#include <atomic>
#include <cstdlib>

// A sanitizer has a malloc of its own, which must not be replaced: there nothing is counted, and the loops
// run for the sanitizer to watch.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define COUNTS_MALLOC 0
#elif defined(__has_feature)
#if __has_feature(realtime_sanitizer) || __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define COUNTS_MALLOC 0
#else
#define COUNTS_MALLOC 1
#endif
#else
#define COUNTS_MALLOC 1
#endif

extern "C" void* __libc_malloc(std::size_t size);

namespace {
std::atomic<long> allocations{0};
}

#if COUNTS_MALLOC
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace {

/// How often memory was asked for while `loop` ran.
template <class Loop>
long allocations_in(Loop loop) {
  const long before = allocations;
  loop();
  return allocations - before;
}

}  // namespace
