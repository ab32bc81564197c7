// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace bvhbench {

/// Returns the number of the host's cores, at least 1.
inline std::size_t core_count() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Calls work(k) once for each k below `tasks`, on up to `threads` threads, one of them the caller's. Threads take the tasks as they
/// become free. Blocks; rethrows an exception of a task after all threads have ended.
template <class Work>
void on_all_cores(std::size_t tasks, const Work& work, std::size_t threads = core_count())
{
    std::atomic<std::size_t> next = 0;
    const auto take = [&] {
        for (std::size_t k; (k = next++) < tasks;)
            work(k);
    };
    std::vector<std::future<void>> others;  // their destructors wait
    for (std::size_t i = 1; i < std::min(threads, tasks); ++i)
        others.push_back(std::async(std::launch::async, take));
    take();
    for (std::future<void>& other : others)
        other.get();
}

}  // namespace bvhbench
