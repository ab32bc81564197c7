// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DSTRIDED=1
// check: -DGROUP_SIZE=1u -DSTRIDED=0
//
// The table of a hashed grid, made anew every frame:
//
//     add_sides     partials[i]  sums of the boxes' sides
//     choose_cells  *grid        the side of cells, from the mean
//     count_cells   ends[b]      how many entries bucket b gets
//       ... a scan of ends ...   where bucket b begins
//     enter_cells   entries      as in hash_grid.h, bucket after bucket; ends[b] is where b ends
//
// Counting by buckets places every entry with no list of unsorted ones, and no pass over a number of entries that only
// the device knows.
#include "builders/stages/chunk.clh"
#include "collide/grid/hash_grid.h"
#include "geometry/box_words.clh"
#include "geometry/scene_bounds.h"

/// partials[i] is what work-item i's share of the boxes adds to the mean half side. The order of adding is fixed.
kernel void add_sides(global const float2* restrict boxes, global float* restrict partials,
                      const uint count)
{
#if STRIDED
    const uint first = (uint)get_global_id(0), end = count, step = (uint)get_global_size(0);
#else
    const Chunk chunk = own_chunk(count);
    const uint first = chunk.first, end = chunk.end, step = 1u;
#endif
    const float share = 1.0f / (float)count;
    float sum = 0.0f;
    for (uint k = first; k < end; k += step)
        sum += half_longest(load_box(boxes, k)) * share;
    partials[get_global_id(0)] = sum;
}

/// Cells are `cell_sides` times as long as the mean longest side of a box: one that covers fewer cells has more company in
/// each. Where all boxes are points, as if their sides were the scene's divided by their number. One group.
///
/// 2^126 cells a unit are the most: all of a scene of denormals is in one.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void choose_cells(
    global const float* restrict partials, global const Bounds* restrict bounds,
    global HashGrid* restrict grid, const uint partial_count, const uint count,
    const float cell_sides)
{
    local float sums[GROUP_SIZE];
    const uint item = (uint)get_local_id(0);
    float sum = 0.0f;
    for (uint k = item; k < partial_count; k += GROUP_SIZE)
        sum += partials[k];
    sums[item] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item == 0u) {
        float mean = 0.0f;
        for (uint k = 0u; k < GROUP_SIZE; ++k)
            mean += sums[k];
        if (!(mean > 0.0f))
            mean = half_longest(bounds->scene) / (float)count;
        grid->scale = fmin(0.5f / (cell_sides * mean), 8.507059173e+37f);
        grid->levels = 0u;
    }
}

/// `ends` are zero.
kernel void count_cells(global const float2* restrict boxes, volatile global HashGrid* grid,
                        volatile global uint* ends, const uint count, const uint shift)
{
    const uint k = (uint)get_global_id(0);
    if (k >= count)
        return;
    const Aabb box = load_box(boxes, k);
    const float finest = grid->scale;
    const uint level = level_of_box(box, finest);
    const CellRange range = cells_of_box(box, level_scale(finest, level));
    for (int z = range.low_z; z <= range.high_z; ++z)
        for (int y = range.low_y; y <= range.high_y; ++y)
            for (int x = range.low_x; x <= range.high_x; ++x)
                atomic_inc(&ends[bucket_of(cell_number(level, x, y, z), shift)]);
    // Nearly always somebody was here before: looking is cheaper than an atomic on one word by all.
    if ((grid->levels & 1u << level) == 0u)
        atomic_or(&grid->levels, 1u << level);
}

/// What finds no room is counted in `ends` and not written.
kernel void enter_cells(global const float2* restrict boxes, global const HashGrid* restrict grid,
                        volatile global uint* ends, global uint4* restrict entries,
                        const uint entry_room, const uint count, const uint shift)
{
    const uint k = (uint)get_global_id(0);
    if (k >= count)
        return;
    const Aabb box = load_box(boxes, k);
    const float finest = grid->scale;
    const uint level = level_of_box(box, finest);
    const CellRange range = cells_of_box(box, level_scale(finest, level));
    for (int z = range.low_z; z <= range.high_z; ++z)
        for (int y = range.low_y; y <= range.high_y; ++y)
            for (int x = range.low_x; x <= range.high_x; ++x) {
                const uint number = cell_number(level, x, y, z);
                const uint slot = atomic_inc(&ends[bucket_of(number, shift)]);
                if (slot < entry_room)
                    store_entry(entries, slot, box, number, k);
            }
}
