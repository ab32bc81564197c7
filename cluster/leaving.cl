// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DKEEP_ADJACENT=1 -DWITH_VERTICES=1
// check: -DGROUP_SIZE=1u -DKEEP_ADJACENT=1 -DWITH_VERTICES=0
//
// Finds the triangles that leave to be tested on other ranks (cluster/halo.h), those whose box overlaps a box of another rank, and
// packs them to be sent.
#include "collide/sinks/sink_groups.clh"

#include "cluster/halo_triangle.h"
#include "geometry/box_words.clh"

/// Writes (triangle, rank) for each rank that a triangle leaves to. ranks[] has a rank and where its boxes end in wanted[]; the first
/// of them is around the others.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void leaving(
    global const Point* points, global const Face* faces, const uint triangles,
    global const BoxWord* wanted, global const uint2* ranks, const uint rank_count,
    global uint2* pairs, const uint capacity, volatile global uint* counters)
{
    OPEN_SINK
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint triangle = (uint)get_global_id(0);
    if (triangle < triangles) {
        const Face face = faces[triangle];
        const Aabb box = triangle_box(points[face.a], points[face.b], points[face.c]);
        uint k = 0u;
        for (uint r = 0u; r < rank_count; ++r) {
            const uint end = ranks[r].y;
            if (overlap(box, load_box(wanted, k++))) {
                while (k < end && !overlap(box, load_box(wanted, k)))
                    ++k;
                if (k < end)
                    put(SINK, (uint2)(triangle, ranks[r].x));
            }
            k = end;
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    close_sink(SINK);
}

/// Writes packed[k], the triangle of pairs[k], for all pairs that were found and have room. `ids` and `vertices` have the scene's
/// numbers of the triangles and of the points; `vertices` is read only with WITH_VERTICES.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void pack(
    global const Point* points, global const Face* faces, global const uint* ids,
    global const uint* vertices, global const uint2* pairs, const uint capacity,
    global const uint* counters, global HaloTriangle* packed)
{
    const uint k = (uint)get_global_id(0);
    if (k >= min(capacity, counters[PAIRS_COUNT]))
        return;
    const uint triangle = pairs[k].x;
    const Face face = faces[triangle];
    HaloTriangle one;
    one.box = triangle_box(points[face.a], points[face.b], points[face.c]);
    one.id = ids[triangle];
#if WITH_VERTICES
    one.vertices.a = vertices[face.a];
    one.vertices.b = vertices[face.b];
    one.vertices.c = vertices[face.c];
#else
    (void)vertices;
    one.vertices = face;
#endif
    packed[k] = one;
}
