// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=16u -DDIGIT_BITS=8u -DSTATE_EPOCH_BITS=31u -DMOST_TILES=144u -DFEW_TILES=16u -DPOST_ID_BITS=28u -DSWEPT=0 -DAXIS_BITS=10u -DHILBERT=1 -DSTRETCHED=0 -DSEVERAL_OBJECTS=0
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DDIGIT_BITS=8u -DSTATE_EPOCH_BITS=31u -DMOST_TILES=1u -DFEW_TILES=16u -DPOST_ID_BITS=28u -DSWEPT=0 -DAXIS_BITS=16u -DHILBERT=0 -DSTRETCHED=1 -DSEVERAL_OBJECTS=0
//
// From the triangles of one object to ordered leaves in one launch: boxes, codes and all passes of the sort, for so few triangles
// that each group has one tile and all groups are resident at the same time (stages/sort/at_once.clh). After the boxes, groups
// post the bounds of theirs, and each waits for those of all others.
#include "builders/stages/bounds_parts.clh"
#include "builders/stages/box_code.clh"
#include "builders/stages/sort/at_once.clh"

#define SIDES 12u  // of the two boxes of Bounds

/// Posts the bounds of a tile, a side per word below the epoch.
static inline void post_bounds(volatile global ulong* posts, const Bounds bounds, const uint epoch)
{
    const float sides[SIDES] = {bounds.scene.min_x,   bounds.scene.min_y,   bounds.scene.min_z,
                                bounds.scene.max_x,   bounds.scene.max_y,   bounds.scene.max_z,
                                bounds.centres.min_x, bounds.centres.min_y, bounds.centres.min_z,
                                bounds.centres.max_x, bounds.centres.max_y, bounds.centres.max_z};
#pragma unroll
    for (uint k = 0u; k < SIDES; ++k)
        post(&posts[k], (ulong)epoch << 32 | as_uint(sides[k]));
}

/// Returns the bounds that a tile posted, and waits for them.
static inline Bounds posted_bounds(volatile global const ulong* posts, const uint epoch)
{
    ulong seen[SIDES];
    bool all_there;
    do {
        all_there = true;
#pragma unroll
        for (uint k = 0u; k < SIDES; ++k)
            seen[k] = posted(&posts[k]);
#pragma unroll
        for (uint k = 0u; k < SIDES; ++k)
            all_there = all_there && (uint)(seen[k] >> 32) == epoch;
    } while (!all_there);
#define SIDE(k) as_float((uint)seen[k])
    const Bounds bounds = {{SIDE(0), SIDE(1), SIDE(2), SIDE(3), SIDE(4), SIDE(5)},
                           {SIDE(6), SIDE(7), SIDE(8), SIDE(9), SIDE(10), SIDE(11)}};
    return bounds;
}

/// Writes the boxes of a tile, fills `table`, and waits for the bounds of all tiles. Returns them, joined, to item 0. `words` is
/// scratch.
static inline Bounds bounds_of_all(POINTS_PARAMETERS(), const global Face* faces,
                                   global float2* boxes, volatile global ulong* posts,
                                   local uint* words, local ushort* table, const uint first,
                                   const uint here, const uint epoch)
{
    local float2* const staged = (local float2*)words;
    local Bounds* const parts = (local Bounds*)words;
    const uint tiles = (uint)get_num_groups(0);
    Bounds bounds = empty_bounds();
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint start = min(here, k * GROUP_SIZE);
        bounds = make_boxes(POINTS, faces, boxes, staged, first + start,
                            min(GROUP_SIZE, here - start), bounds);
    }
    bounds = joined_in_group(bounds, parts);
    if (get_local_id(0) == 0)
        post_bounds(posts + SIDES * (uint)get_group_id(0), bounds, epoch);
    fill_hilbert_table(table);
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);  // the group may read its boxes
    bounds = empty_bounds();
    for (uint tile = (uint)get_local_id(0); tile < tiles; tile += GROUP_SIZE)
        bounds = joined(bounds, posted_bounds(posts + SIDES * tile, epoch));
    return joined_in_group(bounds, parts);
}

/// Writes the boxes of all faces, their bounds to *result, and the ids in the order of the codes to `ids_out`; with `keeps_codes`, also the
/// codes by id and in order. Launched as sort_at_once is. After `states` come SIDES words per tile.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void order_at_once(
    POINTS_PARAMETERS(restrict), global const Face* restrict faces, global float2* boxes,
    global Bounds* restrict result, global Code* codes, global Code* codes_out,
    global uint* ids_out, volatile global ulong* states, volatile global ulong* posts,
    const uint count, const uint passes, const uint epoch, const uint keeps_codes)
{
    local AtOnceScratch scratch;
    local Bounds common[1];
    local ushort table[HILBERT_TABLE_SIZE];
    const AtOnce all = {states, posts, count, passes, epoch, codes, codes_out, keeps_codes};
    const uint first = (uint)get_group_id(0) * TILE, here = min(TILE, count - first);
    const Bounds bounds =
        bounds_of_all(POINTS, faces, boxes, states + 2ul * TILE_STATES((uint)get_num_groups(0)),
                      scratch.tile.words, table, first, here, epoch);
    if (get_local_id(0) == 0) {
        common[0] = bounds;
        if (get_group_id(0) == 0)
            *result = bounds;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    OwnCodes own;
    uint ids[KEYS_PER_ITEM];
    load_ids(ids, ids_out, first, here, true);
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const bool is_real = ids[k] - first < here;
        own.codes[k] = is_real ? code_of_box(load_box(boxes, ids[k]), common[0], table) : ~(Code)0;
        if (keeps_codes != 0u && is_real)
            codes[ids[k]] = own.codes[k];
    }
    sort_at_once_from(&own, ids, &scratch, all, ids_out);
}
