// SPDX-License-Identifier: MIT
// check: -DAMONG=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DROWS=2u
// check: -DAMONG=1 -DKEEP_ADJACENT=0 -DGROUP_SIZE=32u -DROWS=1u
// check: -DAMONG=2 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DROWS=2u
//
// The work-group form: a group per tile. A work-item has ROWS boxes of the tile in registers, the rows, and tests them against the boxes
// of another tile in local memory, the columns: each column that it reads is tested ROWS times.
#include "collide/sinks/sink_groups.clh"

#include "collide/worlds/report.clh"
#include "collide/worlds/tile.h"
#include "geometry/bits.h"
#include "geometry/box_words.clh"

#define TILE (ROWS * GROUP_SIZE)

/// A box in local memory, in parts that are read at once.
static inline Aabb column_at(local const float4* lows, local const float2* highs, const uint k)
{
    const float4 low = lows[k];
    const float2 high = highs[k];
    const Aabb box = {low.x, low.y, low.z, low.w, high.x, high.y};
    return box;
}

/// The boxes of the object of box `first` + `place` that are in the tile, by their places.
static inline uint2 range_in_tile(const Tile tile, global const uint* owners,
                                  global const uint* starts, const uint place)
{
#if AMONG == 2
    const uint object = owners[tile.first + place];
    return (uint2)(max(starts[object], tile.first) - tile.first,
                   min(starts[object + 1u], tile.end) - tile.first);
#else
    (void)owners, (void)starts, (void)place;
    return (uint2)(0u, tile.end - tile.first);
#endif
}

/// Finds the pairs of all tiles; `counters` must be zero. `starts`: first box of each object, and the number of boxes. Without AMONG == 2
/// all boxes are one object.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void all_pairs(
    global const float2* boxes, global const Tile* tiles, global const uint* starts,
    global const uint* owners, global const Face* faces, global uint2* pairs, const uint capacity,
    volatile global uint* counters)
{
    OPEN_SINK
    local float4 lows[TILE];   // min x, y, z, max x
    local float2 highs[TILE];  // max y, z
    local ulong tests[GROUP_SIZE];
    const uint item = (uint)get_local_id(0);
    const Tile tile = tiles[get_group_id(0)];
    const uint size = tile.end - tile.first;
    Aabb rows[ROWS];
    uint met[ROWS], others[ROWS], ends[ROWS],
        begins[ROWS];  // of step 0: as met_behind, places in the tile
    uint row_count = 0u, most_met = 0u;
    for (uint r = 0u; r < ROWS; ++r) {
        const uint place = item + r * GROUP_SIZE;
        rows[r] = empty_box();
        met[r] = others[r] = begins[r] = ends[r] = 0u;
        if (place < size) {
            rows[r] = load_box(boxes, tile.first + place);
            const uint2 range = range_in_tile(tile, owners, starts, place);
            others[r] = place, begins[r] = range.x, ends[r] = range.y;
            met[r] = met_behind(range.y - range.x, place - range.x);
            most_met = max(most_met, met[r]);
            ++row_count;
        }
    }
    const uint ring = divided_up(tile.object_end - tile.object_first, TILE);
    const uint in_ring = (tile.first - tile.object_first) / TILE;
    ulong own_tests = 0ul;
    for (uint step = tile.first_step; step < tile.end_step; ++step) {
        const uint behind = in_ring + step;
        const uint first = tile.object_first + (behind < ring ? behind : behind - ring) * TILE;
        const uint count = min(TILE, tile.object_end - first);
        barrier(CLK_LOCAL_MEM_FENCE);  // the columns of the step before are read
        for (uint k = item; k < count; k += GROUP_SIZE) {
            const Aabb box = load_box(boxes, first + k);
            lows[k] = (float4)(box.min_x, box.min_y, box.min_z, box.max_x);
            highs[k] = (float2)(box.max_y, box.max_z);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        const uint trips = step != 0u ? count : most_met;
        for (uint k = 0u; k < trips; ++k) {
            uint hits = 0u;  // a bit for each row
            if (step != 0u) {
                const Aabb column = column_at(lows, highs, k);
                for (uint r = 0u; r < ROWS; ++r)
                    hits |= overlap(rows[r], column) ? 1u << r : 0u;
                hits &= (1u << row_count) - 1u;
                own_tests += row_count;
            } else {
                for (uint r = 0u; r < ROWS; ++r) {
                    others[r] = others[r] + 1u < ends[r] ? others[r] + 1u : begins[r];
                    if (k >= met[r])
                        continue;
                    hits |= overlap(rows[r], column_at(lows, highs, others[r])) ? 1u << r : 0u;
                    ++own_tests;
                }
            }
            // One call for both kinds of steps: of a function inlined twice, PoCL 3.1 mixes up variables.
            for (uint r = 0u; hits != 0u && r < ROWS; ++r)
                if ((hits >> r & 1u) != 0u)
                    report(SINK, faces, owners, tile.first + item + r * GROUP_SIZE,
                           first + (step != 0u ? k : others[r]));
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    add_tests(tests, own_tests, counters + BOX_TESTS_COUNT);
    close_sink(SINK);
}
