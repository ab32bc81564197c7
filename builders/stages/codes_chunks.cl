// SPDX-License-Identifier: MIT
// check: -DAXIS_BITS=10u -DHILBERT=0 -DSTRETCHED=0 -DSEVERAL_OBJECTS=0
// check: -DAXIS_BITS=16u -DHILBERT=1 -DSTRETCHED=1 -DSEVERAL_OBJECTS=1
// check: -DAXIS_BITS=21u -DHILBERT=1 -DSTRETCHED=0 -DSEVERAL_OBJECTS=1
//
// As codes.cl, for devices with a few fast cores: a work-item processes a run of boxes, one block at a time.
//
// Within a block every step is a loop over all of its boxes without branches, which compilers vectorise: to cells, then each
// turn of the curve, then to codes. Between two steps the values are in arrays that fit the nearest cache. Boxes are read as
// single floats, because compilers do not combine loads of pairs into vectors.
#include "builders/stages/chunk.clh"
#include "builders/stages/code_of.clh"

#define BLOCK 64u
#define FLOATS_PER_BOX 6ul

/// Computes the codes of `lanes` boxes (at most BLOCK) from `box_floats` on, in the grid over `bounds`. Drops the lowest
/// `dropped` bits of each code and sets the bits `above`.
static inline __attribute__((always_inline)) void code_block(global const float* box_floats,
                                                             const Bounds bounds,
                                                             global Code* codes, const uint lanes,
                                                             const Code above, const uint dropped)
{
    uint x[BLOCK], y[BLOCK], z[BLOCK];
    for (uint lane = 0u; lane < lanes; ++lane) {
        global const float* f = box_floats + FLOATS_PER_BOX * lane;
        const Aabb box = {f[0], f[1], f[2], f[3], f[4], f[5]};
        const GridCell cell = CELL_OF(box, bounds);
        x[lane] = cell.x;
        y[lane] = cell.y;
        z[lane] = cell.z;
    }
#if HILBERT
    for (uint size = AXIS_BITS - 1u; size > 0u; --size)
        for (uint lane = 0u; lane < lanes; ++lane) {
            const GridCell cell = {x[lane], y[lane], z[lane]};
            const GridCell turned = hilbert_turned(cell, size);
            x[lane] = turned.x;
            y[lane] = turned.y;
            z[lane] = turned.z;
        }
#endif
    for (uint lane = 0u; lane < lanes; ++lane) {
        const GridCell cell = {x[lane], y[lane], z[lane]};
        codes[lane] = above | code_of(cell) >> dropped;
    }
}

kernel void codes_of_all(global const float* restrict boxes,
                         global const Bounds* restrict all_bounds,
                         global const uint* restrict owners, global Code* restrict codes,
                         const uint count, const uint dropped, const uint object_shift,
                         const uint bounds_apart)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first, lanes; k < chunk.end; k += lanes) {
        const uint owner = SEVERAL_OBJECTS ? owners[k] : 0u, most = min(BLOCK, chunk.end - k);
        for (lanes = SEVERAL_OBJECTS ? 1u : most; lanes < most && owners[k + lanes] == owner;)
            ++lanes;
        code_block(boxes + FLOATS_PER_BOX * k, all_bounds[bounds_apart * owner], codes + k, lanes,
                   (Code)owner << object_shift, SEVERAL_OBJECTS ? dropped : 0u);
    }
}

kernel void codes_of_runs(global const float* restrict boxes,
                          global const Bounds* restrict all_bounds,
                          global const uint4* restrict runs, global Code* restrict codes,
                          const uint dropped, const uint object_shift, const uint bounds_apart)
{
    const uint4 run = runs[get_global_id(0)];
    const Bounds bounds = all_bounds[bounds_apart * run.z];
    for (uint k = run.x; k < run.y; k += BLOCK)
        code_block(boxes + FLOATS_PER_BOX * k, bounds, codes + (k - run.w), min(BLOCK, run.y - k),
                   (Code)run.z << object_shift, dropped);
}
