// SPDX-License-Identifier: MIT
//
// Compiles device/handoff.clh, device/group_handoff.clh and builders/implicit/climb.clh as C++ and runs them on threads under
// ThreadSanitizer. Threads climb from the leaves, and the sanitizer reports two unordered accesses to one box. This tests the
// OpenCL C 3.0 branch, whose atomics are those of C++. With PLANT_RACE the atomics are relaxed, and then the sanitizer must
// report a race.
//
// Not tested: the OpenCL C 1.2 branch, because 1.2 has no memory model; and the order of `wait_for_all`, because ThreadSanitizer
// does not know its fences: wait_for_all_test.cpp tests that it ends.
#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

#include "geometry/aabb.h"
#include "oibvh/layout.h"

namespace bvhbench {

using std::atomic_uint;
using std::memory_order;
constexpr int memory_scope_device = 0, memory_scope_work_group = 0;
constexpr int CLK_LOCAL_MEM_FENCE = 1, CLK_GLOBAL_MEM_FENCE = 2;
#ifdef PLANT_RACE
constexpr memory_order memory_order_acq_rel = std::memory_order_relaxed;
#else
constexpr memory_order memory_order_acq_rel = std::memory_order_acq_rel;
#endif
constexpr memory_order memory_order_relaxed = std::memory_order_relaxed;

inline uint atomic_fetch_add_explicit(volatile atomic_uint* to, uint value, memory_order order, int)
{
    return std::atomic_fetch_add_explicit(to, value, order);
}
inline uint atomic_exchange_explicit(volatile atomic_uint* to, uint value, memory_order order, int)
{
    return std::atomic_exchange_explicit(to, value, order);
}
inline void atomic_store_explicit(volatile atomic_uint* to, uint value, memory_order order, int)
{
    std::atomic_store_explicit(to, value, order);
}
inline void atomic_work_item_fence(int, memory_order, int) {}
inline void barrier(int) {}
constexpr uint get_local_id(int) { return 0; }
constexpr uint get_local_size(int) { return 1; }

// What climb.clh needs from the kernel that includes it: the layout's functions, and loads and stores of boxes.
using BoxWord = Aabb;
#define BVHBENCH_GEOMETRY_BOX_WORDS_CLH
inline Aabb load_box(const BoxWord* boxes, uint i) { return boxes[i]; }
inline void store_box(BoxWord* boxes, uint i, Aabb box) { boxes[i] = box; }
constexpr uint first_slot(uint leaves, uint level)
{
    return oi_first_slot(oi_shape(leaves), level);
}
constexpr uint stored_on(uint leaves, uint level) { return oi_real_on(oi_shape(leaves), level); }

#define global
#define local
#define __opencl_c_atomic_order_acq_rel
#define __opencl_c_atomic_scope_device
#include "builders/implicit/climb.clh"
#include "device/group_handoff.clh"
#undef local
#undef global

namespace {

Aabb leaf(uint i)
{
    const auto at = static_cast<float>(i * 2654435761u % 1000u);
    return {at, at + 1, -at, at + 2, 1 - at, 3};
}

/// Builds a tree with `threads` threads. Each climbs from every `threads`-th leaf. `nodes` starts out poisoned.
void build(uint leaves, uint threads, std::vector<Aabb>& nodes, std::vector<Arrivals>& arrivals)
{
    const uint level = oi_shape(leaves).leaf_level;
    std::vector<std::thread> agents;
    for (uint t = 0; t < threads; ++t)
        agents.emplace_back([&, t] {
            for (uint i = t; i < leaves; i += threads) {
                store_box(nodes.data(), first_slot(leaves, level) + i, leaf(i));
                climb(nodes.data(), arrivals.data(), leaves, level, i, leaf(i));
            }
        });
    for (std::thread& agent : agents)
        agent.join();
}

/// Two threads exchange a word at each slot. True if at every slot the second to arrive read the payload that the first wrote.
template <class Exchange>
bool exchange(uint slots, const Exchange& exchanged_at)
{
    std::vector<std::atomic_uint> words(slots);
    std::vector<uint> payload(2 * std::size_t{slots}), got(slots);
    const auto agent = [&](uint side) {
        for (uint i = 0; i < slots; ++i) {
            payload[2 * i + side] = i + 7;
            if (exchanged_at(&words[i], side + 1) != 0)
                got[i] = payload[2 * i + 1 - side];
        }
    };
    std::thread other(agent, 1);
    agent(0);
    other.join();
    for (uint i = 0; i < slots; ++i)
        if (got[i] != i + 7)
            return false;
    return true;
}

int test()
{
    for (const uint leaves : {2u, 3u, 5u, 8u, 63u, 64u, 65u, 1000u})
        for (int again = 0; again < 20; ++again) {
            const Aabb poison = {9, 9, 9, -9, -9, -9};
            std::vector<Aabb> nodes(oi_node_count(oi_shape(leaves)), poison);
            std::vector<Arrivals> arrivals(nodes.size());
            build(leaves, 4, nodes, arrivals);
            Aabb all = leaf(0);
            for (uint i = 1; i < leaves; ++i)
                all = merged(all, leaf(i));
            const Aabb root = nodes[0];
            if (root.min_x != all.min_x || root.max_x != all.max_x || root.min_y != all.min_y ||
                root.min_z != all.min_z) {
                std::printf("%u leaves: the root's box is wrong\n", leaves);
                return 1;
            }
            for (const Arrivals& left : arrivals)
                if (left != 0) {
                    std::printf("%u leaves: an arrival was not forgotten\n", leaves);
                    return 1;
                }
        }
    if (!exchange(10000, exchanged) || !exchange(10000, exchanged_in_group)) {
        std::printf("a word that was exchanged came before what it announced\n");
        return 1;
    }
    std::printf("no box was touched by two at once\n");
    return 0;
}

}  // namespace
}  // namespace bvhbench

int main() { return bvhbench::test(); }
