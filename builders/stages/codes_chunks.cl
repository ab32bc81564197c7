// SPDX-License-Identifier: MIT
// check: -DORDER_morton30=1u
// check: -DORDER_morton48=1u
// check: -DORDER_morton63=1u
// check: -DORDER_hilbert30=1u
// check: -DORDER_hilbert48=1u
// check: -DORDER_hilbert63=1u
// check: -DORDER_morton30_axis=1u
// check: -DORDER_morton48_axis=1u
// check: -DORDER_morton63_axis=1u
// check: -DORDER_hilbert30_axis=1u
// check: -DORDER_hilbert48_axis=1u
// check: -DORDER_hilbert63_axis=1u
//
// As codes.cl for devices with a few fast cores: a work-item takes a run of boxes, a block at a time.
//
// Within a block every step is a loop over all of its boxes without a branch, which compilers turn into vector
// instructions: to cells, one turn of the curve after the other, to codes. What waits between two steps is in arrays
// that stay in the nearest cache. Boxes are read as floats: loads of pairs are not put together to vectors.
#include "builders/stages/chunk.clh"
#include "geometry/hilbert.h"

#define BLOCK 64u
#define FLOATS_PER_BOX 6ul

// An order: a box's cell is cell_of(box, bounds, cells), of `bits` bits an axis. Its code is code_of(cell) once
// turn(cell, size) has been applied for all sizes from bits - 1 down to 1.
//
// block_NAME writes the codes of `lanes` boxes from `box_floats` on, at most a block, measured against `bounds`: less
// their `dropped` lowest bits, under `above`.
#define ORDER(name, Code, cell_of, cells, bits, turn, code_of)                                     \
    static inline __attribute__((always_inline)) void block_##name(                                \
        global const float* box_floats, const Bounds bounds, global Code* codes, const uint lanes, \
        const Code above, const uint dropped)                                                      \
    {                                                                                              \
        uint x[BLOCK], y[BLOCK], z[BLOCK];                                                         \
        for (uint lane = 0u; lane < lanes; ++lane) {                                               \
            global const float* f = box_floats + FLOATS_PER_BOX * lane;                            \
            const Aabb box = {f[0], f[1], f[2], f[3], f[4], f[5]};                                 \
            const Cell cell = cell_of(box, bounds, cells);                                         \
            x[lane] = cell.x;                                                                      \
            y[lane] = cell.y;                                                                      \
            z[lane] = cell.z;                                                                      \
        }                                                                                          \
        for (uint size = bits - 1u; size > 0u; --size)                                             \
            for (uint lane = 0u; lane < lanes; ++lane) {                                           \
                Cell cell = {x[lane], y[lane], z[lane]};                                           \
                cell = turn(cell, size);                                                           \
                x[lane] = cell.x;                                                                  \
                y[lane] = cell.y;                                                                  \
                z[lane] = cell.z;                                                                  \
            }                                                                                      \
        for (uint lane = 0u; lane < lanes; ++lane) {                                               \
            const Cell cell = {x[lane], y[lane], z[lane]};                                         \
            codes[lane] = above | code_of(cell) >> dropped;                                        \
        }                                                                                          \
    }                                                                                              \
                                                                                                   \
    kernel void name(global const float* restrict boxes, global const Bounds* restrict bounds,     \
                     global Code* restrict codes, const uint count)                                \
    {                                                                                              \
        const Chunk chunk = own_chunk(count);                                                      \
        const Bounds all = *bounds;                                                                \
        for (uint k = chunk.first; k < chunk.end; k += BLOCK)                                      \
            block_##name(boxes + FLOATS_PER_BOX * k, all, codes + k, min(BLOCK, chunk.end - k),    \
                         0u, 0u);                                                                  \
    }                                                                                              \
                                                                                                   \
    kernel void name##_objects(                                                                    \
        global const float* restrict boxes, global const Bounds* restrict all_bounds,              \
        global const uint* restrict owners, global Code* restrict codes, const uint count,         \
        const uint dropped, const uint object_shift, const uint bounds_apart)                      \
    {                                                                                              \
        const Chunk chunk = own_chunk(count);                                                      \
        for (uint k = chunk.first, lanes; k < chunk.end; k += lanes) {                             \
            const uint owner = owners[k], most = min(BLOCK, chunk.end - k);                        \
            for (lanes = 1u; lanes < most && owners[k + lanes] == owner;)                          \
                ++lanes;                                                                           \
            block_##name(boxes + FLOATS_PER_BOX * k, all_bounds[bounds_apart * owner], codes + k,  \
                         lanes, (Code)owner << object_shift, dropped);                             \
        }                                                                                          \
    }                                                                                              \
                                                                                                   \
    kernel void name##_runs(global const float* restrict boxes,                                    \
                            global const Bounds* restrict all_bounds,                              \
                            global const uint4* restrict runs, global Code* restrict codes,        \
                            const uint dropped, const uint object_shift, const uint bounds_apart)  \
    {                                                                                              \
        const uint4 run = runs[get_global_id(0)];                                                  \
        const Bounds bounds = all_bounds[bounds_apart * run.z];                                    \
        for (uint k = run.x; k < run.y; k += BLOCK)                                                \
            block_##name(boxes + FLOATS_PER_BOX * k, bounds, codes + (k - run.w),                  \
                         min(BLOCK, run.y - k), (Code)run.z << object_shift, dropped);             \
    }

// One order a program, the one that is defined as ORDER_<name>: what is not there need not be compiled.
#define NO_TURN(cell, size) (cell)
#if defined(ORDER_morton30)
ORDER(morton30, uint, cubic_cell, CELLS_30, 1u, NO_TURN, morton_30)
#elif defined(ORDER_morton48)
ORDER(morton48, ulong, cubic_cell, CELLS_48, 1u, NO_TURN, morton_48)
#elif defined(ORDER_morton63)
ORDER(morton63, ulong, cubic_cell, CELLS_63, 1u, NO_TURN, morton_63)
#elif defined(ORDER_hilbert30)
ORDER(hilbert30, uint, cubic_cell, CELLS_30, 10u, hilbert_turned, hilbert_turned_30)
#elif defined(ORDER_hilbert48)
ORDER(hilbert48, ulong, cubic_cell, CELLS_48, 16u, hilbert_turned, hilbert_turned_48)
#elif defined(ORDER_hilbert63)
ORDER(hilbert63, ulong, cubic_cell, CELLS_63, 21u, hilbert_turned, hilbert_turned_63)
#elif defined(ORDER_morton30_axis)
ORDER(morton30_axis, uint, stretched_cell, CELLS_30, 1u, NO_TURN, morton_30)
#elif defined(ORDER_morton48_axis)
ORDER(morton48_axis, ulong, stretched_cell, CELLS_48, 1u, NO_TURN, morton_48)
#elif defined(ORDER_morton63_axis)
ORDER(morton63_axis, ulong, stretched_cell, CELLS_63, 1u, NO_TURN, morton_63)
#elif defined(ORDER_hilbert30_axis)
ORDER(hilbert30_axis, uint, stretched_cell, CELLS_30, 10u, hilbert_turned, hilbert_turned_30)
#elif defined(ORDER_hilbert48_axis)
ORDER(hilbert48_axis, ulong, stretched_cell, CELLS_48, 16u, hilbert_turned, hilbert_turned_48)
#elif defined(ORDER_hilbert63_axis)
ORDER(hilbert63_axis, ulong, stretched_cell, CELLS_63, 21u, hilbert_turned, hilbert_turned_63)
#endif
