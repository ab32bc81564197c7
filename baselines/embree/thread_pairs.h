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

/// Pairs that many threads find at once: each adds to a list of its own, without a lock.
class ThreadPairs {
public:
    /// The list of the thread that asks.
    std::vector<Pair>& mine()
    {
        // By number, not by address: at a thread's last address a later one of us may live.
        thread_local std::uint64_t whose = 0;
        thread_local std::vector<Pair>* list = nullptr;
        if (whose != number_) {
            const std::lock_guard lock(door_);
            list = &lists_[std::this_thread::get_id()].pairs;
            whose = number_;
        }
        return *list;
    }

    /// No pairs, while no thread adds any. Memory stays.
    void clear()
    {
        for (auto& [thread, list] : lists_)
            list.pairs.clear();
    }

    /// The pairs of all threads, in no order, while none adds any.
    void append_to(std::vector<Pair>& all) const
    {
        for (const auto& [thread, list] : lists_)
            all.insert(all.end(), list.pairs.begin(), list.pairs.end());
    }

private:
    /// In a cache line of its own, so that threads do not slow each other down.
    struct alignas(64) List {
        std::vector<Pair> pairs;
    };

    inline static std::atomic<std::uint64_t> made_ = 0;
    const std::uint64_t number_ = ++made_;
    std::mutex door_;
    std::map<std::thread::id, List> lists_;
};

}  // namespace bvhbench
