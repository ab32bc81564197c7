// SPDX-License-Identifier: MIT
//
// Lists that kernels fill on the device: memory for them, their counts, and more room where those found none.
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

/// Most entries of a list: kernels place them by 32 bits.
inline constexpr std::uint64_t most_entries = std::numeric_limits<uint>::max();

/// Take what `plan` takes of an arena, measured first; the old memory goes before the new comes.
template <class Plan>
void take_memory(std::optional<Arena>& arena, const Device& device, const Plan& plan)
{
    Arena measuring = Arena::measuring(device);
    plan(measuring);
    arena.reset();
    arena = Arena::reserved(device, measuring.used());
    plan(*arena);
}

/// The 64-bit counts of `words`, two words each (collide/found.clh).
inline std::vector<std::uint64_t> wide_counts(const Buffer<uint>& words, const Queue& queue)
{
    const std::vector<uint> halves = words.download(queue.cl());
    std::vector<std::uint64_t> counts;
    for (std::size_t k = 0; k < halves.size(); k += 2)
        counts.push_back(halves[k] | std::uint64_t{halves[k + 1]} << 32);
    return counts;
}

/// The first `count` entries of a list. Throws Unavailable when the host has not the memory.
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

/// Whether `needed` entries, as counted, fit into a list with this `room`; if not, it is made for them and for `more`, as
/// far as one allocation goes. Throws Unavailable for more than 32 bits count.
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
