// SPDX-License-Identifier: MIT
//
// Lists that kernels fill on the device: allocation, 64-bit counts, download and growth.
#pragma once

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device/arena.h"
#include "device/queue.h"
#include "geometry/dialect.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"

namespace bvhbench {

/// Largest number of entries of a list: kernels index entries by 32 bits.
inline constexpr std::uint64_t most_entries = std::numeric_limits<uint>::max();

/// Pairs a triangle that the first list of pairs has room for, up to `most_entries` in all.
inline constexpr std::size_t first_pairs_each = 8;

/// Measures what `plan` allocates, frees the old arena, and allocates a new one of that size.
template <class Plan>
void take_memory(std::optional<Arena>& arena, const Device& device, const Plan& plan)
{
    Arena measuring = Arena::measuring(device);
    plan(measuring);
    arena.reset();
    arena = Arena::reserved(device, measuring.used());
    plan(*arena);
}

/// Returns the 64-bit counts stored in `words`, two words each (collide/found.clh). Blocks.
inline std::vector<std::uint64_t> wide_counts(const Buffer<uint>& words, const Queue& queue)
{
    const std::vector<uint> halves = words.download(queue.cl());
    std::vector<std::uint64_t> counts;
    for (std::size_t k = 0; k < halves.size(); k += 2)
        counts.push_back(halves[k] | std::uint64_t{halves[k + 1]} << 32);
    return counts;
}

/// Downloads the first `count` entries of a list. Throws Unavailable if host memory is too small.
template <class T>
std::vector<T> first_entries(const Buffer<T>& list, std::uint64_t count, const Queue& queue,
                             const std::string& what)
{
    require_host_memory(what + ", " + std::to_string(count) + " of them,", count * sizeof(T));
    assert(count <= list.size());
    std::vector<T> entries(static_cast<std::size_t>(count));
    if (!entries.empty())
        queue.cl().enqueueReadBuffer(list.cl(), CL_TRUE, 0, count * sizeof(T), entries.data());
    return entries;
}

/// True if `needed` entries fit into a list with this `room`. Otherwise sets `room` to `needed` plus `more`, limited by the
/// largest allocation. Throws Unavailable if `needed` exceeds 32 bits.
inline bool had_room(std::size_t& room, std::uint64_t needed, std::uint64_t more,
                     std::size_t entry_bytes, const Device& device, std::string_view what)
{
    if (needed <= room)
        return true;
    if (needed > most_entries)
        throw Unavailable(std::to_string(needed) + ' ' + std::string(what) +
                          " or more: a query holds at most " + std::to_string(most_entries));
    room = device.room_for(std::min(most_entries, needed + more), entry_bytes, needed);
    return false;
}

}  // namespace bvhbench
