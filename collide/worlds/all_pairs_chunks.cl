// SPDX-License-Identifier: MIT
// check: -DAMONG=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u
// check: -DAMONG=1 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u
// check: -DAMONG=2 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u
//
// The chunk form: a work-item takes a contiguous run of tiles of eight boxes. It has the boxes of a tile side by side in registers, and
// tests each box of the tiles behind it against all eight at once.
#include "builders/stages/chunk.clh"
#include "collide/sinks/sink_chunks.clh"

#include "collide/worlds/eight.clh"
#include "collide/worlds/report.clh"
#include "collide/worlds/tile.h"

#define PAIRS_PARAMETERS \
    global const float2 *boxes, global const Face *faces, global const uint *owners
#define PAIRS boxes, faces, owners

/// Finds the pairs of a tile in itself and with those behind it. Returns the number of tests.
static inline ulong meet_tile(PAIRS_PARAMETERS, SINK_PARAMETERS, const Tile tile)
{
    Eight eight;
    const uint size = tile.end - tile.first;
    for (uint k = 0u; k < LANES; ++k)
        set_lane(&eight, k, load_box(boxes, tile.first + min(k, size - 1u)));
    const uint ring = divided_up(tile.object_end - tile.object_first, LANES);
    const uint next = (tile.first - tile.object_first) / LANES + 1u;
    const uint last = next + met_behind(ring, next - 1u);
    // The tile and those behind it are boxes up to the end of the object, and then from its first on.
    const uint until = last < ring ? tile.object_first + last * LANES : tile.object_end;
    const uint around = last > ring ? tile.object_first + (last - ring) * LANES : 0u;
    const ulong rows = (ulong)(until - tile.end) + (last > ring ? around - tile.object_first : 0u);
    for (uint run = 0u; run < 2u; ++run) {
        const uint end = run == 0u ? until : around;
        for (uint row = run == 0u ? tile.first : tile.object_first; row < end; ++row) {
            const uint place = row - tile.first;
            uint lanes = (1u << size) - 1u;
            if (place < size)  // in the tile: those behind it
                lanes &= ~0u << (place + 1u);
            uint hits = eight_meet(&eight, load_box(boxes, row)) & lanes;
            for (; hits != 0u; hits &= hits - 1u)
                report(SINK, faces, owners, tile.first + lowest_lane(hits), row);
        }
    }
    return (ulong)size * (size - 1u) / 2ul + size * rows;
}

/// As `all_pairs` in all_pairs_groups.cl. Step numbers of tiles are not used. `blocks` has SINK_BLOCK pairs per work-item.
kernel void all_pairs(global const float2* boxes, global const Tile* tiles,
                      global const uint* starts, global const uint* owners,
                      global const Face* faces, global uint2* pairs, const uint capacity,
                      volatile global uint* counters, global uint2* blocks, const uint tile_count)
{
    (void)starts;
    const Chunk chunk = own_chunk(tile_count);
    OPEN_SINK
    ulong tests = 0ul;
    for (uint k = chunk.first; k < chunk.end; ++k)
        tests += meet_tile(PAIRS, SINK, tiles[k]);
    add_wide(counters + BOX_TESTS_COUNT, tests);
    close_sink(SINK);
}
