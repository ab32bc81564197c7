// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DKEEP_ADJACENT=1
// check: -DGROUP_SIZE=1u -DKEEP_ADJACENT=1
//
// Finds the triangles that leave to be tested on other ranks (cluster/halo.h): those whose box overlaps a box of another rank.
#include "collide/sinks/sink_groups.clh"

#include "geometry/box_words.clh"

/// Writes (triangle, rank) once for each rank, of ranks[] ascending, that a triangle leaves to. Its boxes are wanted[], followed by
/// the box around them all.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void leaving(
    global const Point* points, global const Face* faces, const uint triangles,
    global const BoxWord* wanted, global const uint* ranks, const uint wanted_count,
    global uint2* pairs, const uint capacity, volatile global uint* counters)
{
    OPEN_SINK
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint triangle = (uint)get_global_id(0);
    if (triangle < triangles) {
        const Face face = faces[triangle];
        const Aabb box = triangle_box(points[face.a], points[face.b], points[face.c]);
        uint last = 0xffffffffu;  // the rank it was last found to leave to
        const uint count = overlap(box, load_box(wanted, wanted_count)) ? wanted_count : 0u;
        for (uint k = 0u; k < count; ++k)
            if (ranks[k] != last && overlap(box, load_box(wanted, k))) {
                last = ranks[k];
                put(SINK, (uint2)(triangle, last));
            }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    close_sink(SINK);
}
