// SPDX-License-Identifier: MIT
// check: -DAXIS_BITS=10u -DHILBERT=0 -DSTRETCHED=0 -DSEVERAL_OBJECTS=0
// check: -DAXIS_BITS=16u -DHILBERT=1 -DSTRETCHED=1 -DSEVERAL_OBJECTS=1
// check: -DAXIS_BITS=21u -DHILBERT=1 -DSTRETCHED=0 -DSEVERAL_OBJECTS=1
//
// Writes the code of boxes[k] to codes[k], given the bounds of all boxes and of their centres. With several objects
// (SEVERAL_OBJECTS) each code is computed in all_bounds[bounds_apart * object]; with bounds_apart 0 all objects share the
// first. Such a code has the object number above the box's code, without the lowest `dropped` bits of it, for which there is no
// room.
#include "builders/stages/box_code.clh"

kernel void codes_of_all(global const float2* restrict boxes,
                         global const Bounds* restrict all_bounds,
                         global const uint* restrict owners, global Code* restrict codes,
                         const uint count, const uint dropped, const uint object_shift,
                         const uint bounds_apart)
{
    local ushort table[HILBERT_TABLE_SIZE];
    fill_hilbert_table(table);
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = (uint)get_global_id(0); k < count; k += (uint)get_global_size(0)) {
        const Aabb box = load_box(boxes, k);
        codes[k] = code_in_object(box, all_bounds, bounds_apart, SEVERAL_OBJECTS ? owners[k] : 0u,
                                  object_shift, dropped, table);
    }
}

/// Computes the codes of some objects, a run (ObjectRun) per group, and stores them one object after the other.
kernel void codes_of_runs(global const float2* restrict boxes,
                          global const Bounds* restrict all_bounds,
                          global const uint4* restrict runs, global Code* restrict codes,
                          const uint dropped, const uint object_shift, const uint bounds_apart)
{
    local ushort table[HILBERT_TABLE_SIZE];
    fill_hilbert_table(table);
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint4 run = runs[get_group_id(0)];
    for (uint k = run.x + (uint)get_local_id(0); k < run.y; k += (uint)get_local_size(0))
        codes[k - run.w] = code_in_object(load_box(boxes, k), all_bounds, bounds_apart, run.z,
                                          object_shift, dropped, table);
}
