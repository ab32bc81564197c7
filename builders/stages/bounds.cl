// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DROUNDS=4u -DSWEPT=0
// check: -DGROUP_SIZE=64u -DROUNDS=4u -DSWEPT=1
//
// Computes the boxes of triangles and, in the same pass, their common bounds. Every group or chunk writes the bounds of its
// triangles to `partials`. The last group to finish joins them if groups may meet (device/handoff.clh), else a second launch
// does. No float atomics.
//
// With several objects, a group or work-item processes one run (ObjectRun: .x to .y - 1) of one object's triangles. A second
// launch joins each object's partials: those of objects[k] start at first_runs[k].
#include "builders/stages/bounds_parts.clh"
#include "builders/stages/chunk.clh"
#include "device/handoff.clh"

/// Writes the box of faces[k] to boxes[k], for all `count`, and their bounds to *result. The groups together process `rounds`
/// rounds of a group's size each. *arrivals is zero before and after. Without `meet`, the partials are not joined.
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

    // All groups continue, so that every work-item reaches the barriers; only the last group has partials to join.
    bounds = joined_partials(partials, 0u, is_last[0] != 0u ? (uint)get_num_groups(0) : 0u, parts);
    if (item == 0u && is_last[0] != 0u) {
        *result = bounds;
        forget_arrivals(arrivals);
    }
}

/// Writes the bounds of all `partial_count` partials to *result. Launched as one group.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void join_groups(
    global const Bounds* restrict partials, global Bounds* restrict result,
    const uint partial_count)
{
    local Bounds parts[GROUP_SIZE];
    const Bounds bounds = joined_partials(partials, 0u, partial_count, parts);
    if (get_local_id(0) == 0)
        *result = bounds;
}

/// Writes the box of faces[k] to boxes[k] and the bounds of runs[g] to partials[g]. A run has at most ROUNDS * GROUP_SIZE
/// faces.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void runs_groups(
    POINTS_PARAMETERS(restrict), global const Face* restrict faces, global float2* restrict boxes,
    global Bounds* restrict partials, global const uint4* restrict runs)
{
    local float2 staged[3u * GROUP_SIZE];
    local Bounds parts[GROUP_SIZE];
    const uint4 run = runs[get_group_id(0)];
    Bounds bounds = empty_bounds();

    for (uint round = 0u; round < ROUNDS; ++round) {
        const uint start = min(run.y, run.x + round * GROUP_SIZE);
        const uint here = min(GROUP_SIZE, run.y - start);
        bounds = make_boxes(POINTS, faces, boxes, staged, start, here, bounds);
    }
    bounds = joined_in_group(bounds, parts);
    if (get_local_id(0) == 0)
        partials[get_group_id(0)] = bounds;
}

/// Joins the partials of one object per group.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void join_objects_groups(
    global const Bounds* restrict partials, global Bounds* restrict result,
    global const uint* restrict first_runs, global const uint* restrict objects)
{
    local Bounds parts[GROUP_SIZE];
    const uint k = (uint)get_group_id(0);
    const Bounds bounds = joined_partials(partials, first_runs[k], first_runs[k + 1u], parts);
    if (get_local_id(0) == 0)
        result[objects[k]] = bounds;
}

/// Returns the coordinates of a vertex as a vector: a processor computes with all three at once.
static inline float3 point_of(global const Point* points, const uint vertex)
{
    return vload3(vertex, (global const float*)points);
}

/// Writes the boxes of faces `first` to `end` - 1, by one work-item. Returns their bounds. The sums are those of box_of_face() and
/// grown().
static inline Bounds make_run(POINTS_PARAMETERS(), global const Face* faces, global Aabb* boxes,
                              const uint first, const uint end)
{
    float3 low = (float3)(MOST_SIDE), high = (float3)(LEAST_SIDE), low_centre = low,
           high_centre = high;
    for (uint k = first; k < end; ++k) {
        const Face face = faces[k];
        const float3 a = point_of(points, face.a), b = point_of(points, face.b),
                     c = point_of(points, face.c);
        float3 box_low = min(min(a, b), c), box_high = max(max(a, b), c);
#if SWEPT
        const float3 d = point_of(end_points, face.a), e = point_of(end_points, face.b),
                     f = point_of(end_points, face.c);
        box_low = min(box_low, min(min(d, e), f));
        box_high = max(box_high, max(max(d, e), f));
#endif
        box_low += 0.0f;
        box_high += 0.0f;
        const float3 centre = 0.5f * box_low + 0.5f * box_high + 0.0f;
        vstore3(box_low, 2ul * k, (global float*)boxes);
        vstore3(box_high, 2ul * k + 1ul, (global float*)boxes);
        low = min(low, box_low);
        high = max(high, box_high);
        low_centre = min(low_centre, centre);
        high_centre = max(high_centre, centre);
    }
    const Bounds bounds = {
        {low.x, low.y, low.z, high.x, high.y, high.z},
        {low_centre.x, low_centre.y, low_centre.z, high_centre.x, high_centre.y, high_centre.z}};
    return bounds;
}

static inline Bounds joined_run(global const Bounds* partials, const uint first, const uint end)
{
    Bounds bounds = empty_bounds();
    for (uint partial = first; partial < end; ++partial)
        bounds = joined(bounds, partials[partial]);
    return bounds;
}

/// As bounds_groups, a chunk per work-item, without joining.
kernel void bounds_chunks(POINTS_PARAMETERS(restrict), global const Face* restrict faces,
                          global Aabb* restrict boxes, global Bounds* restrict partials,
                          const uint count)
{
    const Chunk chunk = own_chunk(count);
    partials[get_global_id(0)] = make_run(POINTS, faces, boxes, chunk.first, chunk.end);
}

/// As join_groups, by one work-item.
kernel void join_chunks(global const Bounds* restrict partials, global Bounds* restrict result,
                        const uint partial_count)
{
    *result = joined_run(partials, 0u, partial_count);
}

/// As runs_groups, a run per work-item.
kernel void runs_chunks(POINTS_PARAMETERS(restrict), global const Face* restrict faces,
                        global Aabb* restrict boxes, global Bounds* restrict partials,
                        global const uint4* restrict runs)
{
    const uint4 run = runs[get_global_id(0)];
    partials[get_global_id(0)] = make_run(POINTS, faces, boxes, run.x, run.y);
}

/// As join_objects_groups, an object per work-item.
kernel void join_objects_chunks(global const Bounds* restrict partials,
                                global Bounds* restrict result,
                                global const uint* restrict first_runs,
                                global const uint* restrict objects)
{
    const uint k = (uint)get_global_id(0);
    result[objects[k]] = joined_run(partials, first_runs[k], first_runs[k + 1u]);
}
