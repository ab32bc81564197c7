// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DPAIRS_EACH=8u
// check: -DSINK_BLOCK=512u
//
// Kernels of contacts that stand (standing.h). PAIRS_EACH: pairs that a work-item of the group form looks at.
#include "builders/stages/chunk.clh"
#include "collide/found.clh"
#ifdef GROUP_SIZE
#include "collide/sinks/sink_groups.clh"
#else
#include "collide/sinks/sink_chunks.clh"
#endif

static inline bool has_moved(global const Point* before, global const Point* points,
                             const uint vertex)
{
    const uint3 a = as_uint3(vload3(vertex, (global const float*)before));
    const uint3 b = as_uint3(vload3(vertex, (global const float*)points));
    return a.x != b.x || a.y != b.y || a.z != b.z;
}

/// Sets moved[k] to 1 if a corner of triangle k has other bits than `before`, and to 0 otherwise.
kernel void mark_moved(global const Point* restrict before, global const Point* restrict points,
                       global const Face* restrict faces, global uchar* restrict moved,
                       const uint count)
{
    const Chunk part = own_chunk(count);
    for (uint k = part.first; k < part.end; ++k) {
        const Face face = faces[k];
        moved[k] = has_moved(before, points, face.a) || has_moved(before, points, face.b) ||
                   has_moved(before, points, face.c);
    }
}

/// True if the pair stands and `standing` is 1, or it does not and `standing` is 0.
static inline bool is_one(global const uchar* moved, const uint2 pair, const uint standing)
{
    return (moved[pair.x] == 0 && moved[pair.y] == 0) == (standing != 0u);
}

#ifdef GROUP_SIZE

/// Appends to `pairs` those of the pairs listed that stand, if `standing` is 1, or else those that do not. A group looks at PAIRS_EACH
/// pairs a work-item.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void copy_those(
    global const uint2* restrict listed, global const uint* restrict listed_counters,
    const uint listed_room, global const uchar* restrict moved, const uint standing,
    global uint2* pairs, const uint capacity, volatile global uint* counters)
{
    OPEN_SINK
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint count = count_in_room(listed_counters + PAIRS_COUNT, listed_room);
    const ulong first = (ulong)get_group_id(0) * GROUP_SIZE * PAIRS_EACH + get_local_id(0);
    for (uint k = 0u; k < PAIRS_EACH; ++k) {
        const ulong place = first + k * GROUP_SIZE;
        if (place < count && is_one(moved, listed[place], standing))
            put(SINK, listed[place]);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    close_sink(SINK);
}

#else

/// As in the other form.
kernel void copy_those(global const uint2* restrict listed,
                       global const uint* restrict listed_counters, const uint listed_room,
                       global const uchar* restrict moved, const uint standing, global uint2* pairs,
                       const uint capacity, volatile global uint* counters, global uint2* blocks)
{
    OPEN_SINK
    const Chunk part = own_chunk(count_in_room(listed_counters + PAIRS_COUNT, listed_room));
    for (uint k = part.first; k < part.end; ++k)
        if (is_one(moved, listed[k], standing))
            put(SINK, listed[k]);
    close_sink(SINK);
}

#endif
