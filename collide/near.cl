// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DLISTED=256u
// check: -DGROUP_SIZE=1u -DLISTED=4u
//
// Gathers the triangles that can be in a pair between two objects, as a frame of their own:
//
//     list_touching  lists      per object, the objects whose boxes overlap its box
//     flag_near      places[k]  1 if the box of triangle k overlaps one of those boxes, else 0
//       ... prefix sum of places ...   number of near triangles before k
//     count_near     counts     per object, the number of near triangles; ranks: 1 if there are any, else 0
//       ... prefix sum of ranks ...    rank of the object among those that have any
//     compact_near   near_*     the near triangles, in the frame's order, with object ranks instead of object numbers
//
// Each work-group takes a contiguous range of items in all kernels. GROUP_SIZE is 1 in the chunk form.
#include "builders/stages/chunk.clh"
#include "collide/found.clh"
#include "geometry/box_words.clh"
#include "geometry/scene_bounds.h"

/// Writes the objects that object k overlaps to lists[LISTED * k], ..., as far as LISTED, and their full number to list_sizes[k].
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void list_touching(
    global const Bounds* restrict bounds, const uint object_count, global uint* restrict lists,
    global uint* restrict list_sizes, volatile global uint* test_count)
{
    local ulong group_tests[GROUP_SIZE];
    const Chunk part = own_chunk(object_count);
    for (uint own = part.first; own < part.end; ++own) {
        const Aabb box = bounds[own].scene;
        uint size = 0u;
        for (uint other = 0u; other < object_count; ++other) {
            if (other == own || !overlap(box, bounds[other].scene))
                continue;
            if (size < LISTED)
                lists[(ulong)LISTED * own + size] = other;
            ++size;
        }
        list_sizes[own] = size;
    }
    add_tests(group_tests, (ulong)(part.end - part.first) * (object_count - 1u), test_count);
}

/// True if `box`, of object `own`, overlaps the box of another object. If the list of `own` overflowed, all objects are tested.
static inline bool is_near(const Aabb box, const uint own, global const Bounds* bounds,
                           const uint object_count, global const uint* lists,
                           global const uint* list_sizes, ulong* tests)
{
    const uint size = list_sizes[own];
    const bool ran_over = size > LISTED;
    const uint end = ran_over ? object_count : size;
    bool touches = false;
    for (uint k = 0u; k < end && !touches; ++k) {
        const uint other = ran_over ? k : lists[(ulong)LISTED * own + k];
        if (other == own)
            continue;
        ++*tests;
        touches = overlap(box, bounds[other].scene);
    }
    return touches;
}

/// Writes count + 1 flags; the last one is 0.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void flag_near(
    global const float2* restrict boxes, global const uint* restrict owners,
    global const Bounds* restrict bounds, const uint object_count,
    global const uint* restrict lists, global const uint* restrict list_sizes,
    global uint* restrict places, const uint count, volatile global uint* test_count)
{
    local ulong group_tests[GROUP_SIZE];
    const Chunk part = own_chunk(count + 1u);
    ulong tests = 0ul;
    for (uint k = part.first; k < part.end; ++k)
        places[k] = k < count && is_near(load_box(boxes, k), owners[k], bounds, object_count, lists,
                                         list_sizes, &tests)
                        ? 1u
                        : 0u;
    add_tests(group_tests, tests, test_count);
}

/// Object k consists of triangles first_faces[k] to first_faces[k + 1] - 1.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void count_near(
    global const uint* restrict places, global const uint* restrict first_faces,
    const uint object_count, global uint* restrict counts, global uint* restrict ranks)
{
    const Chunk part = own_chunk(object_count);
    for (uint object = part.first; object < part.end; ++object) {
        const uint count = places[first_faces[object + 1u]] - places[first_faces[object]];
        counts[object] = count;
        ranks[object] = count > 0u ? 1u : 0u;
    }
}

/// Writes nothing beyond `most` entries; if there are more, the host uses the whole frame and reads none of the output.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void compact_near(
    global const uint* restrict places, global const Face* restrict faces,
    global const uint* restrict owners, global const uint* restrict ranks,
    global Face* restrict near_faces, global uint* restrict near_owners,
    global uint* restrict near_ids, const uint count, const uint most)
{
    const Chunk part = own_chunk(count);
    for (uint k = part.first; k < part.end; ++k) {
        const uint place = places[k];
        if (places[k + 1u] == place || place >= most)
            continue;
        near_faces[place] = faces[k];
        near_owners[place] = ranks[owners[k]];
        near_ids[place] = k;
    }
}

/// Replaces ids of near triangles in `pairs` by ids in the whole frame. The order is the same, so the smaller id stays first.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void map_pairs(
    global uint2* restrict pairs, global const uint* restrict pair_count, const uint capacity,
    global const uint* restrict near_ids)
{
    const uint found = count_in_room(pair_count, capacity);
    const Chunk part = own_chunk(found);
    for (uint k = part.first; k < part.end; ++k) {
        const uint2 pair = pairs[k];
        pairs[k] = (uint2)(near_ids[pair.x], near_ids[pair.y]);
    }
}
