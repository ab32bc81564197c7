// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=0
// check: -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=1 -DBOX_FORMAT=1u
// check: -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=1 -DBOX_FORMAT=2u
// check: -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=0 -DBOX_FORMAT=4u
//
// sorted[first + k] becomes boxes[ids[k]], for all k below `count`. Boxes are seen as three pairs of sides. Of several
// objects (SEVERAL_OBJECTS), `first` is the owner's slot, modulo 2^32: its own leaves do not begin at k = 0.
//
// Boxes are floats; those lined up are in the format that trees keep (BOX_FORMAT), and this is the one place where they
// are rounded. `cells` is what scene_cells.cl has found; of formats without cells nobody reads it.
#include "builders/stages/chunk.clh"
#include "builders/stages/stored_box.clh"

/// A group fills GROUP_SIZE boxes, and neighbours in it neighbouring pairs of floats: the memory sees whole
/// lines written, which a work-item writing its own 24 bytes would not give it.
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

/// The same, each work-item by itself.
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

/// As gather_groups, of some of several objects: a group fills a run (ObjectRun), whatever the group's size.
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

/// The same, each work-item a run.
kernel void gather_runs_chunks(global const float2* restrict boxes, global const uint* restrict ids,
                               global BoxWord* restrict sorted, global const uint4* restrict runs,
                               global const uint* restrict slots CELLS_PARAMETER)
{
    const uint4 run = runs[get_global_id(0)];
    for (uint k = run.x; k < run.y; ++k)
        gather_box(boxes, ids[k], sorted, slots[run.z] + k CELLS_PASSED);
}
