// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=0
// check: -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=1 -DBOX_FORMAT=1u
// check: -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=1 -DBOX_FORMAT=2u
// check: -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=0 -DBOX_FORMAT=4u
//
// Copies boxes[ids[k]] to sorted[first + k], for all k below `count`. A box is three pairs of sides. With several objects
// (SEVERAL_OBJECTS), the owner's slot replaces `first`, modulo 2^32, because k counts the leaves of all objects.
//
// The input boxes are floats; the output is in the tree's format (BOX_FORMAT). This is the only place where boxes are rounded.
// `cells` is the result of scene_cells.cl; formats without cells do not read it.
#include "builders/stages/chunk.clh"
#include "builders/stages/stored_box.clh"

/// A group writes GROUP_SIZE boxes, neighbouring work-items neighbouring pairs of sides, so that whole memory lines are
/// written; if each work-item wrote its own box of 24 bytes, they would not be.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void gather_groups(
    global const float2* restrict boxes, global const uint* restrict ids,
    global BoxWord* restrict sorted, global const uint* restrict owners,
    global const uint* restrict slots, const uint first, const uint count CELLS_PARAMETER)
{
    const uint start = (uint)get_group_id(0) * GROUP_SIZE;
    const uint words = 3u * min(GROUP_SIZE, count - start);
#pragma unroll
    for (uint round = 0u; round < 3u; ++round) {
        const uint word = round * GROUP_SIZE + (uint)get_local_id(0);
        if (word < words) {
            const uint id = ids[start + word / 3u];
            const ulong to = SEVERAL_OBJECTS
                                 ? 3ul * (slots[owners[id]] + start + word / 3u) + word % 3u
                                 : 3ul * ((ulong)first + start) + word;
            sorted[to] = STORED_WORD(boxes[3ul * id + word % 3u], word % 3u);
        }
    }
}

/// As gather_groups, a chunk per work-item.
kernel void gather_chunks(global const float2* restrict boxes, global const uint* restrict ids,
                          global BoxWord* restrict sorted, global const uint* restrict owners,
                          global const uint* restrict slots, const uint first,
                          const uint count CELLS_PARAMETER)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const ulong to = SEVERAL_OBJECTS ? slots[owners[ids[k]]] + k : (ulong)first + k;
        gather_box(boxes, ids[k], sorted, to CELLS_PASSED);
    }
}

/// As gather_groups, for some of several objects: a group copies a run (ObjectRun), with any group size.
kernel void gather_runs_groups(global const float2* restrict boxes, global const uint* restrict ids,
                               global BoxWord* restrict sorted, global const uint4* restrict runs,
                               global const uint* restrict slots CELLS_PARAMETER)
{
    const uint4 run = runs[get_group_id(0)];
    const uint slot = slots[run.z] + run.x;
    const uint words = 3u * (run.y - run.x);
    for (uint word = (uint)get_local_id(0); word < words; word += (uint)get_local_size(0))
        sorted[3ul * slot + word] =
            STORED_WORD(boxes[3ul * ids[run.x + word / 3u] + word % 3u], word % 3u);
}

/// As gather_runs_groups, a run per work-item.
kernel void gather_runs_chunks(global const float2* restrict boxes, global const uint* restrict ids,
                               global BoxWord* restrict sorted, global const uint4* restrict runs,
                               global const uint* restrict slots CELLS_PARAMETER)
{
    const uint4 run = runs[get_global_id(0)];
    for (uint k = run.x; k < run.y; ++k)
        gather_box(boxes, ids[k], sorted, slots[run.z] + k CELLS_PASSED);
}
