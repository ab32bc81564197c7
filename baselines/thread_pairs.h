// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "collide/pairs.h"

namespace bvhbench {

/// Pairs found by several threads at once. Each thread adds to its own list, without a lock.
class ThreadPairs {
public:
    /// Returns the list of the calling thread.
    std::vector<Pair>& mine()
    {
        // Compares numbers, not addresses, since a later ThreadPairs may have the same address as a former one.
        thread_local std::uint64_t whose = 0;
        thread_local std::vector<Pair>* list = nullptr;
        if (whose != number_) {
            const std::lock_guard lock(door_);
            list = &lists_[std::this_thread::get_id()].pairs;
            whose = number_;
        }
        return *list;
    }

    /// Removes all pairs but keeps the memory. No thread may add pairs meanwhile.
    void clear()
    {
        for (auto& [thread, list] : lists_)
            list.pairs.clear();
    }

    /// Appends the pairs of all threads to `all`, in no order. No thread may add pairs meanwhile.
    void append_to(std::vector<Pair>& all) const
    {
        for (const auto& [thread, list] : lists_)
            all.insert(all.end(), list.pairs.begin(), list.pairs.end());
    }

private:
    /// Aligned to a cache line, so that lists of different threads do not share one.
    struct alignas(64) List {
        std::vector<Pair> pairs;
    };

    inline static std::atomic<std::uint64_t> made_ = 0;
    const std::uint64_t number_ = ++made_;
    std::mutex door_;
    std::map<std::thread::id, List> lists_;
};

}  // namespace bvhbench
