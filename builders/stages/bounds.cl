// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DSWEPT=0
// check: -DGROUP_SIZE=64u -DSWEPT=1
//
// Triangles to boxes, and in the same pass the bounds of them all. Every group or chunk leaves the bounds of what it saw
// in `partials`. Who joins those is the last group to finish, where groups may meet (device/handoff.clh), else a launch of
// its own. No float atomics.
#include "builders/stages/bounds_parts.clh"
#include "builders/stages/chunk.clh"
#include "device/handoff.clh"

/// boxes[k] is the box of faces[k], for all `count`; *result the bounds of them all. The groups together take `rounds`
/// rounds of a group's size each. *arrivals is zero before and after. Unless they `meet`, nobody joins.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void bounds_groups(
    POINTS_PARAMETERS(restrict), global const Face* restrict faces, global float2* restrict boxes,
    global Bounds* partials, global Bounds* restrict result,
    volatile global Arrivals* restrict arrivals, const uint count, const uint rounds,
    const uint meet)
{
    local float2 staged[3u * GROUP_SIZE];
    local Bounds parts[GROUP_SIZE];
    local uint is_last[1];
    const uint item = (uint)get_local_id(0);
    Bounds bounds = empty_bounds();

    for (uint round = 0u; round < rounds; ++round) {
        const uint start = (round * (uint)get_num_groups(0) + (uint)get_group_id(0)) * GROUP_SIZE;
        const uint here = min(GROUP_SIZE, count - min(count, start));
        bounds = make_boxes(POINTS, faces, boxes, staged, start, here, bounds);
    }
    bounds = joined_in_group(bounds, parts);
    if (item == 0u) {
        partials[get_group_id(0)] = bounds;
        is_last[0] = meet != 0u && arrived_last(arrivals, (uint)get_num_groups(0)) ? 1u : 0u;
    }
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);

    // All groups go on, so that no barrier is left out, but only the last has something to join.
    const uint to_join = is_last[0] != 0u ? (uint)get_num_groups(0) : 0u;
    bounds = empty_bounds();
    for (uint partial = item; partial < to_join; partial += GROUP_SIZE)
        bounds = joined(bounds, partials[partial]);
    bounds = joined_in_group(bounds, parts);
    if (item == 0u && is_last[0] != 0u) {
        *result = bounds;
        forget_arrivals(arrivals);
    }
}

/// *result is the bounds of all `partial_count` partials. One group; rounds of its size cover them.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void join_groups(
    global const Bounds* restrict partials, global Bounds* restrict result,
    const uint partial_count)
{
    local Bounds parts[GROUP_SIZE];
    const uint item = (uint)get_local_id(0);
    Bounds bounds = empty_bounds();
    for (uint partial = item; partial < partial_count; partial += GROUP_SIZE)
        bounds = joined(bounds, partials[partial]);
    bounds = joined_in_group(bounds, parts);
    if (item == 0u)
        *result = bounds;
}

/// As bounds_groups, each work-item by itself.
kernel void bounds_chunks(POINTS_PARAMETERS(restrict), global const Face* restrict faces,
                          global Aabb* restrict boxes, global Bounds* restrict partials,
                          const uint count)
{
    const Chunk chunk = own_chunk(count);
    Bounds bounds = empty_bounds();
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Aabb box = box_of_face(POINTS, faces[k]);
        boxes[k] = box;
        bounds = grown(bounds, box);
    }
    partials[get_global_id(0)] = bounds;
}

/// As join_groups, in one work-item.
kernel void join_chunks(global const Bounds* restrict partials, global Bounds* restrict result,
                        const uint partial_count)
{
    Bounds bounds = empty_bounds();
    for (uint partial = 0u; partial < partial_count; ++partial)
        bounds = joined(bounds, partials[partial]);
    *result = bounds;
}
