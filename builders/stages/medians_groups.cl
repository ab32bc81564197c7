// SPDX-License-Identifier: MIT
// check: -DGROUP_HEIGHT=6u -DBLOCK_HEIGHT=8u
// check: -DGROUP_HEIGHT=4u -DBLOCK_HEIGHT=4u
//
// Every aligned block of 2^BLOCK_HEIGHT leaves is put into the order of exact median splits, by a group in
// local memory. A level at a time, all runs of 2^height leaves of the block are halved at once:
//
//     boxes       around the centres of neighbouring positions, joined to those of whole runs
//     keys[p]     along the widest axis of its run << 32 | slot, position by position
//     network     two runs sorted opposite ways and one step across: the smaller half comes first
//
// Each is some turns of one loop with one barrier (halving.clh).
//
// Slots number the block's leaves by ascending id: equal coordinates are told apart by it. What fills up the
// last block has centres that are no numbers: minima and maxima pass them over, and their keys are the
// largest.
#include "builders/stages/halving.clh"
#include "geometry/box_words.clh"
#include "geometry/split.h"

#define GROUP_SIZE (1u << GROUP_HEIGHT)
#define BLOCK (1u << BLOCK_HEIGHT)
#define ITEMS (BLOCK / GROUP_SIZE)  // neighbouring positions that a work-item looks at

/// One step of a bitonic network: compare what is `apart`. Of runs of `run` keys every other one descends,
/// but runs of `size` all ascend.
static inline void network_step(local ulong* const keys, const uint apart, const uint run,
                                const uint size)
{
    const uint turned = run < size ? run : 0u;
    for (uint pair = (uint)get_local_id(0); pair < BLOCK / 2u; pair += GROUP_SIZE) {
        const uint at = 2u * pair - (pair & (apart - 1u));
        const ulong a = keys[at];
        const ulong b = keys[at + apart];
        if ((a > b) != ((at & turned) != 0u)) {
            keys[at] = b;
            keys[at + apart] = a;
        }
    }
}

static inline Point centre_of(local const float* const centres, const uint slot)
{
    const Point centre = {centres[slot], centres[BLOCK + slot], centres[2u * BLOCK + slot]};
    return centre;
}

/// The box around the centres at `size` positions from `first`.
///
/// Grown in registers: PoCL 3.1 loses what a loop without a barrier adds to a structure.
static inline Aabb box_of_run(local const ulong* const keys, local const float* const centres,
                              const uint first, const uint size)
{
    const Aabb empty = empty_box();
    float3 low = empty.min_x;
    float3 high = empty.max_x;
    for (uint k = first; k < first + size; ++k) {
        const uint slot = (uint)keys[k];
        const float3 at =
            (float3)(centres[slot], centres[BLOCK + slot], centres[2u * BLOCK + slot]);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    const Aabb box = {low.x, low.y, low.z, high.x, high.y, high.z};
    return box;
}

/// Key every leaf along the widest axis of its run of `size`. Runs shorter than ITEMS are a work-item's own;
/// the box of a longer one is that of its first ITEMS, which the others have been joined to.
static inline void key_runs(local ulong* const keys, local const float* const centres,
                            local const Aabb* const boxes, const uint size)
{
    const uint own = (uint)get_local_id(0) * ITEMS;
    for (uint k = own; k < own + ITEMS; ++k) {
        const uint slot = (uint)keys[k];
        const uint first = k & ~(size - 1u);
        const Aabb box =
            size < ITEMS ? box_of_run(keys, centres, first, size) : boxes[first / ITEMS];
        keys[k] = (ulong)split_key(centre_of(centres, slot), widest_axis(box)) << 32u | slot;
    }
}

/// Sort the keys of the whole block. What was written to them before is waited for.
static inline void sort_block(local ulong* const keys)
{
    for (uint turn = 0u; turn < BLOCK_HEIGHT * (BLOCK_HEIGHT + 1u) / 2u; ++turn) {
        const Turn step = network_turn(turn);
        barrier(CLK_LOCAL_MEM_FENCE);
        network_step(keys, 1u << step.apart_height, 1u << step.run_height, BLOCK);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/// Halve the block, its halves, and so on down to pairs.
static inline void halve_block(local ulong* const keys, local const float* const centres,
                               local Aabb* const boxes, local uint* const turns)
{
    const uint item = (uint)get_local_id(0);
    for (uint turn = item; turn < TURNS; turn += GROUP_SIZE)
        turns[turn] = packed_turn(halving_turn(turn));
    for (uint turn = 0u; turn < TURNS; ++turn) {
        barrier(CLK_LOCAL_MEM_FENCE);
        const Turn what = unpacked_turn(turns[turn]);
        const uint size = 1u << what.height;
        const uint apart = 1u << what.apart_height;
        if (what.kind == TURN_BOXES)
            boxes[item] = box_of_run(keys, centres, item * ITEMS, ITEMS);
        else if (what.kind == TURN_JOIN && item % (2u * apart) == 0u)
            boxes[item] = merged(boxes[item], boxes[item + apart]);
        else if (what.kind == TURN_KEYS)
            key_runs(keys, centres, boxes, size);
        else if (what.kind == TURN_NETWORK)
            network_step(keys, apart, 1u << what.run_height, size);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/// The ids of each block, leaves in any order before, in the order of median splits after.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void order_blocks(
    global const float2* restrict boxes, global uint* restrict ids, const uint count)
{
    local ulong keys[BLOCK];
    local uint slot_ids[BLOCK];
    local float centres[3u * BLOCK];
    local Aabb run_boxes[GROUP_SIZE];
    local uint turns[TURNS];
    const uint item = (uint)get_local_id(0);
    const uint start = (uint)get_group_id(0) * BLOCK;
    const uint here = min(BLOCK, count - start);

    for (uint k = item; k < BLOCK; k += GROUP_SIZE)
        keys[k] = k < here ? (ulong)ids[start + k] : ~0ul;
    sort_block(keys);
    for (uint k = item; k < BLOCK; k += GROUP_SIZE) {
        const uint id = (uint)keys[k];
        Point centre = {as_float(0x7fc00000u), as_float(0x7fc00000u), as_float(0x7fc00000u)};
        if (k < here)
            centre = box_centre(load_box(boxes, id));
        centres[k] = centre.x;
        centres[BLOCK + k] = centre.y;
        centres[2u * BLOCK + k] = centre.z;
        slot_ids[k] = id;
        keys[k] = k;
    }
    halve_block(keys, centres, run_boxes, turns);
    for (uint k = item; k < here; k += GROUP_SIZE)
        ids[start + k] = slot_ids[(uint)keys[k]];
}
