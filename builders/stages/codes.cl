// SPDX-License-Identifier: MIT
//
// One entry point an order: codes[k] is afterwards the code of boxes[k], given the bounds of all boxes and of
// their centres. The code itself is a function shared with the host, and all that differs between orders.
//
// NAME_objects does the same for several objects at once, each against its own bounds: a box's object above, its
// code below, less the `dropped` lowest bits for which there is no room. NAME_runs does so for some of the objects,
// a run (ObjectRun) a group or a work-item: their codes are put one object behind the other. An object's bounds are
// all_bounds[bounds_apart * object]: with 0, all share the first.
#include "geometry/box_words.clh"
#include "geometry/hilbert.h"

#define ORDER(name, Code, code_of_box)                                                            \
    kernel void name(global const float2* restrict boxes, global const Bounds* restrict bounds,   \
                     global Code* restrict codes, const uint count)                               \
    {                                                                                             \
        const uint k = (uint)get_global_id(0);                                                    \
        if (k < count) {                                                                          \
            const Aabb box = load_box(boxes, k);                                                  \
            codes[k] = code_of_box;                                                               \
        }                                                                                         \
    }                                                                                             \
                                                                                                  \
    kernel void name##_objects(                                                                   \
        global const float2* restrict boxes, global const Bounds* restrict all_bounds,            \
        global const uint* restrict owners, global Code* restrict codes, const uint count,        \
        const uint dropped, const uint object_shift, const uint bounds_apart)                     \
    {                                                                                             \
        const uint k = (uint)get_global_id(0);                                                    \
        if (k < count) {                                                                          \
            const Aabb box = load_box(boxes, k);                                                  \
            const uint owner = owners[k];                                                         \
            global const Bounds* bounds = all_bounds + bounds_apart * owner;                      \
            codes[k] = ((Code)owner << object_shift) | ((code_of_box) >> dropped);                \
        }                                                                                         \
    }                                                                                             \
                                                                                                  \
    kernel void name##_runs(global const float2* restrict boxes,                                  \
                            global const Bounds* restrict all_bounds,                             \
                            global const uint4* restrict runs, global Code* restrict codes,       \
                            const uint dropped, const uint object_shift, const uint bounds_apart) \
    {                                                                                             \
        const uint4 run = runs[get_group_id(0)];                                                  \
        global const Bounds* bounds = all_bounds + bounds_apart * run.z;                          \
        for (uint k = run.x + (uint)get_local_id(0); k < run.y; k += (uint)get_local_size(0)) {   \
            const Aabb box = load_box(boxes, k);                                                  \
            codes[k - run.w] = ((Code)run.z << object_shift) | ((code_of_box) >> dropped);        \
        }                                                                                         \
    }

ORDER(morton30, uint, morton_30(cubic_cell(box, *bounds, CELLS_30)))
ORDER(morton48, ulong, morton_48(cubic_cell(box, *bounds, CELLS_48)))
ORDER(morton63, ulong, morton_63(cubic_cell(box, *bounds, CELLS_63)))
ORDER(hilbert30, uint, hilbert_30(cubic_cell(box, *bounds, CELLS_30)))
ORDER(hilbert48, ulong, hilbert_48(cubic_cell(box, *bounds, CELLS_48)))
ORDER(hilbert63, ulong, hilbert_63(cubic_cell(box, *bounds, CELLS_63)))
ORDER(morton30_axis, uint, morton_30(stretched_cell(box, *bounds, CELLS_30)))
ORDER(morton48_axis, ulong, morton_48(stretched_cell(box, *bounds, CELLS_48)))
ORDER(morton63_axis, ulong, morton_63(stretched_cell(box, *bounds, CELLS_63)))
ORDER(hilbert30_axis, uint, hilbert_30(stretched_cell(box, *bounds, CELLS_30)))
ORDER(hilbert48_axis, ulong, hilbert_48(stretched_cell(box, *bounds, CELLS_48)))
ORDER(hilbert63_axis, ulong, hilbert_63(stretched_cell(box, *bounds, CELLS_63)))
