// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DROUNDS=4u -DSWEPT=0
// check: -DGROUP_SIZE=64u -DROUNDS=4u -DSWEPT=1
//
// As bounds.cl, of several objects at once: a group or a work-item leaves the bounds of one run of one object's
// triangles in `partials`, then one an object joins those of its runs: of objects[k], from first_runs[k] on. Runs are
// those of ObjectRun, from .x to before .y.
#include "builders/stages/bounds_parts.clh"

/// boxes[k] is the box of faces[k]; partials[g] the bounds of runs[g], ROUNDS times a group's size
/// at most.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void runs_groups(
    POINTS_PARAMETERS(restrict), global const Face* restrict faces, global float2* restrict boxes,
    global Bounds* restrict partials, global const uint4* restrict runs)
{
    local float2 staged[3u * GROUP_SIZE];
    local Bounds parts[GROUP_SIZE];
    const uint item = (uint)get_local_id(0);
    const uint4 run = runs[get_group_id(0)];
    Bounds bounds = empty_bounds();

    for (uint round = 0u; round < ROUNDS; ++round) {
        const uint start = min(run.y, run.x + round * GROUP_SIZE);
        const uint here = min(GROUP_SIZE, run.y - start);
        bounds = make_boxes(POINTS, faces, boxes, staged, start, here, bounds);
    }
    bounds = joined_in_group(bounds, parts);
    if (item == 0u)
        partials[get_group_id(0)] = bounds;
}

/// A group an object.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void join_groups(
    global const Bounds* restrict partials, global Bounds* restrict result,
    global const uint* restrict first_runs, global const uint* restrict objects)
{
    local Bounds parts[GROUP_SIZE];
    const uint item = (uint)get_local_id(0);
    const uint end = first_runs[get_group_id(0) + 1];
    Bounds bounds = empty_bounds();
    for (uint run = first_runs[get_group_id(0)] + item; run < end; run += GROUP_SIZE)
        bounds = joined(bounds, partials[run]);
    bounds = joined_in_group(bounds, parts);
    if (item == 0u)
        result[objects[get_group_id(0)]] = bounds;
}

/// As runs_groups, a work-item a run.
kernel void runs_chunks(POINTS_PARAMETERS(restrict), global const Face* restrict faces,
                        global Aabb* restrict boxes, global Bounds* restrict partials,
                        global const uint4* restrict runs)
{
    const uint4 run = runs[get_global_id(0)];
    Bounds bounds = empty_bounds();
    for (uint k = run.x; k < run.y; ++k) {
        const Aabb box = box_of_face(POINTS, faces[k]);
        boxes[k] = box;
        bounds = grown(bounds, box);
    }
    partials[get_global_id(0)] = bounds;
}

/// As join_groups, a work-item an object.
kernel void join_chunks(global const Bounds* restrict partials, global Bounds* restrict result,
                        global const uint* restrict first_runs, global const uint* restrict objects)
{
    const uint k = (uint)get_global_id(0);
    Bounds bounds = empty_bounds();
    for (uint run = first_runs[k]; run < first_runs[k + 1u]; ++run)
        bounds = joined(bounds, partials[run]);
    result[objects[k]] = bounds;
}
