// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DPAIRS_EACH=8u
// check: -DSINK_BLOCK=512u
//
// Kernels of the rule `margin` (margin.h). `low` and `high` are the ends of each vertex's room. PAIRS_EACH: pairs that a work-item of
// the group form filters.
#include "builders/stages/chunk.clh"
#include "collide/found.clh"
#include "geometry/box_words.clh"
#ifdef GROUP_SIZE
#include "collide/sinks/sink_groups.clh"
#else
#include "collide/sinks/sink_chunks.clh"
#endif

static inline float3 point_at(global const Point* points, const uint vertex)
{
    return vload3(vertex, (global const float*)points);
}

static inline bool is_within(const float3 low, const float3 p, const float3 high)
{
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
           p.z <= high.z;
}

/// Sets `outside` if a vertex is not in its room.
kernel void check_room(global const Point* restrict points, global const Point* restrict low,
                       global const Point* restrict high, const uint count, global uint* outside)
{
    const Chunk part = own_chunk(count);
    for (uint k = part.first; k < part.end; ++k) {
        if (!is_within(point_at(low, k), point_at(points, k), point_at(high, k)))
            *outside = 1u;
    }
}

/// Gives each vertex the box around its way in the next `frames` frames if it goes on as from `before`, and to all sides `skin` and a
/// share of that way more, since motion changes. A vertex whose room would not be finite gets none.
kernel void give_room(global const Point* restrict before, global const Point* restrict points,
                      const float frames, const float share, const float skin,
                      global Point* restrict low, global Point* restrict high, const uint count)
{
    const Chunk part = own_chunk(count);
    for (uint k = part.first; k < part.end; ++k) {
        const float3 p = point_at(points, k), way = (p - point_at(before, k)) * frames;
        const float slack = skin + share * max(max(fabs(way.x), fabs(way.y)), fabs(way.z));
        const float3 from = min(p, p + way) - slack, to = max(p, p + way) + slack;
        const bool is_finite =
            is_within((float3)(-MAXFLOAT), from, to) && is_within(from, to, (float3)(MAXFLOAT));
        vstore3(is_finite ? from : p, k, (global float*)low);
        vstore3(is_finite ? to : p, k, (global float*)high);
    }
}

#ifdef GROUP_SIZE

/// Writes those of the pairs listed whose boxes overlap. A group filters PAIRS_EACH pairs a work-item.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void filter_listed(
    global const uint2* restrict listed, global const uint* restrict listed_counters,
    const uint listed_room, global const BoxWord* restrict boxes, global uint2* pairs,
    const uint capacity, volatile global uint* counters)
{
    OPEN_SINK
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint count = count_in_room(listed_counters + PAIRS_COUNT, listed_room);
    const ulong first = (ulong)get_group_id(0) * GROUP_SIZE * PAIRS_EACH + get_local_id(0);
    for (uint k = 0u; k < PAIRS_EACH; ++k) {
        const ulong place = first + k * GROUP_SIZE;
        if (place >= count)
            break;
        const uint2 pair = listed[place];
        if (overlap(load_box(boxes, pair.x), load_box(boxes, pair.y)))
            put(SINK, pair);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    close_sink(SINK);
}

#else

/// Writes those of the pairs listed whose boxes overlap.
kernel void filter_listed(global const uint2* restrict listed,
                          global const uint* restrict listed_counters, const uint listed_room,
                          global const BoxWord* restrict boxes, global uint2* pairs,
                          const uint capacity, volatile global uint* counters, global uint2* blocks)
{
    OPEN_SINK
    const Chunk part = own_chunk(count_in_room(listed_counters + PAIRS_COUNT, listed_room));
    for (uint k = part.first; k < part.end; ++k) {
        const uint2 pair = listed[k];
        if (overlap(load_box(boxes, pair.x), load_box(boxes, pair.y)))
            put(SINK, pair);
    }
    close_sink(SINK);
}

#endif
