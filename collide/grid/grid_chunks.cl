// SPDX-License-Identifier: MIT
// check: -DAMONG=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u
// check: -DAMONG=1 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u
//
// The chunk form: a work-item takes a contiguous run of entries or of triangles.
#include "builders/stages/chunk.clh"
#include "collide/sinks/sink_chunks.clh"

#include "collide/grid/grid_walk.clh"

/// As `cell_pairs` in grid_groups.cl. `blocks` has SINK_BLOCK pairs per work-item.
kernel void cell_pairs(TABLE_PARAMETERS, global uint2* pairs, const uint capacity,
                       volatile global uint* counters, global uint2* blocks)
{
    if (get_global_id(0) == 0)
        counters[QUEUES_COUNT] = ends[(1u << (32u - shift)) - 1u];
    const Chunk chunk = own_chunk(entry_count(TABLE));
    OPEN_SINK
    ulong tests = 0ul;
    for (uint k = chunk.first; k < chunk.end; ++k)
        tests += meet_behind(TABLE, SINK, k);
    add_wide(counters + BOX_TESTS_COUNT, tests);
    close_sink(SINK);
}

kernel void level_pairs(TABLE_PARAMETERS, global uint2* pairs, const uint capacity,
                        volatile global uint* counters, global uint2* blocks, const uint triangles)
{
    const uint levels = grid->levels;
    if (levels == 1u)
        return;  // only level 0 has boxes
    const Chunk chunk = own_chunk(triangles);
    OPEN_SINK
    ulong tests = 0ul;
    for (uint k = chunk.first; k < chunk.end; ++k)
        tests += meet_coarser(TABLE, SINK, load_box(boxes, k), k);
    add_wide(counters + BOX_TESTS_COUNT, tests);
    close_sink(SINK);
}
