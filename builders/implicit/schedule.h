// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {

/// One launch: builds `levels` levels, entry_level and those above it, as `subtrees` independent subtrees with one root each.
struct SubtreeLaunch {
    uint entry_level = 0;
    uint levels = 0;
    uint subtrees = 0;
};

/// The launches that build an implicit tree bottom-up: App. B, Eq. (14) to (16).
///
/// The paper maps a group of g work-items to g nodes of the entry level, so a launch covers log2(g) + 1
/// levels: `levels` here. Three things differ from the printed scheme.
///  - Eq. (14) starts from r_1 = the number of triangles; Algorithm 1 starts on the level above the leaves, so this schedule
///    starts from that level's nodes. Otherwise half of the first launch idles.
///  - The next entry level is the one above the roots just built. Stepping by log2(g), as Eq. (15) does, builds the level
///    between two launches twice.
///  - The last launch ends at the root, however few levels remain; instead of Eq. (16)'s smaller last group, the kernel stores
///    nothing above the root.
struct SubtreeSchedule {
    std::array<SubtreeLaunch, 32> launches{};
    uint count = 0;
};

/// Returns the launches of a tree. `stored_on(level)` is the number of nodes stored on a level; with `leaf_level` 0 there are
/// none.
template <class StoredOn>
constexpr SubtreeSchedule subtree_schedule(uint leaf_level, uint levels_a_launch,
                                           StoredOn stored_on)
{
    assert(levels_a_launch > 0);
    SubtreeSchedule schedule;
    uint unbuilt = leaf_level;  // number of unbuilt levels: 0 to unbuilt - 1
    while (unbuilt > 0) {
        const uint levels = levels_a_launch < unbuilt ? levels_a_launch : unbuilt;
        const uint entry_level = unbuilt - 1;
        schedule.launches[schedule.count++] = {entry_level, levels,
                                               stored_on(entry_level + 1 - levels)};
        unbuilt -= levels;
    }
    return schedule;
}

}  // namespace bvhbench
