// SPDX-License-Identifier: MIT
//
// Compiles device/handoff.clh as C++: a thread takes the part of a group of one work-item.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "geometry/dialect.h"

namespace bvhbench {
namespace {

constexpr int CLK_LOCAL_MEM_FENCE = 1, CLK_GLOBAL_MEM_FENCE = 2;
inline void mem_fence(int) { std::atomic_thread_fence(std::memory_order_seq_cst); }
inline void barrier(int) {}
inline uint atomic_xchg(volatile uint* slot, uint word)
{
    return std::atomic_ref(*const_cast<uint*>(slot)).exchange(word);
}
inline uint atomic_inc(volatile uint* slot)
{
    return std::atomic_ref(*const_cast<uint*>(slot)).fetch_add(1);
}
constexpr uint get_local_id(int) { return 0; }
constexpr uint get_local_size(int) { return 1; }

#define global
#include "device/handoff.clh"
#undef global

TEST(WaitForAll, LetsNoGroupPassBeforeTheSlowestAndLosesNone)
{
    constexpr uint groups = 4, steps = 300;
    std::vector<ulong> waits(groups);
    std::vector<std::atomic_uint> reached(groups);
    std::atomic_uint early = 0;
    std::vector<std::thread> agents;
    for (uint group = 0; group < groups; ++group)
        agents.emplace_back([&, group] {
            for (uint step = 1; step <= steps; ++step) {
                reached[group] = step;
                wait_for_all(waits.data(), group, groups, step);
                for (const std::atomic_uint& other : reached)
                    early += other < step;
            }
        });
    for (std::thread& agent : agents)
        agent.join();
    EXPECT_EQ(early, 0u);
}

}  // namespace
}  // namespace bvhbench
