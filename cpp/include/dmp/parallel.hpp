#pragma once

#include <dmp/export.hpp>

#include <Eigen/Core>
#include <functional>

namespace dmp {

/// Calls work(first, last) for consecutive ranges first .. last - 1 that together cover 0 .. count - 1, one
/// range a thread. threads: how many to use, this one among them; 0 for as many as the machine runs at once;
/// where the system gives fewer, those do the work. When all have ended, the exception of the first range
/// that threw is thrown again. Throws InvalidArgument for fewer than 0 threads.
DMP_EXPORT void parallel_for(Eigen::Index count, int threads,
                             const std::function<void(Eigen::Index first, Eigen::Index last)>& work);

}  // namespace dmp
