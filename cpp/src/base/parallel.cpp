#include <dmp/error.hpp>
#include <dmp/parallel.hpp>

#include <algorithm>
#include <exception>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace dmp {

using Eigen::Index;

void parallel_for(Index count, int threads, const std::function<void(Index, Index)>& work) {
  if (threads < 0)
    throw InvalidArgument("threads: " + std::to_string(threads) +
                          ", expected 1 or more, or 0 for as many as the machine runs at once.");
  const Index wanted = threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
  const Index parts = std::min(wanted, count);
  if (parts <= 1) {
    if (count > 0) work(0, count);
    return;
  }
  std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(parts));
  const auto part = [&](Index i) noexcept {
    try {
      work(count * i / parts, count * (i + 1) / parts);
    } catch (...) {
      thrown[static_cast<std::size_t>(i)] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(parts));
  Index started = 1;
  try {
    for (; started < parts; ++started) others.emplace_back(part, started);
  } catch (const std::system_error&) {
    // No more threads to be had: this one does what is left.
  }
  part(0);
  for (Index i = started; i < parts; ++i) part(i);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

}  // namespace dmp
