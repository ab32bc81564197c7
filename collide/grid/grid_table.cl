// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DSTRIDED=1
// check: -DGROUP_SIZE=1u -DSTRIDED=0
//
// Builds the table of the hashed grid, every frame:
//
//     add_sides     partials[i]  sums of the boxes' half sides
//     choose_cells  *grid        side of the cells, from the mean
//     count_cells   ends[b]      number of entries of bucket b
//       ... prefix sum of ends ...   where bucket b begins
//     enter_cells   entries      as in hash_grid.h, ordered by bucket; afterwards ends[b] is where bucket b ends
//
// Counting per bucket places every entry without a list of unsorted ones, or a pass over a number that only the device knows.
#include "builders/stages/chunk.clh"
#include "collide/grid/hash_grid.h"
#include "geometry/box_words.clh"
#include "geometry/scene_bounds.h"

/// Sums the half sides of the share of work-item i into partials[i], in a fixed order.
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

/// Sets the cell side to `cell_sides` times the mean longest side of a box. A smaller cell has fewer boxes, but a box covers more
/// cells. If all boxes are points, the scene's longest side divided by `count` replaces the mean. Runs as one work-group.
///
/// The number of cells per unit of length is at most 2^126, so that a scene of denormals is in one cell.
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

/// Counts the entries per bucket. `ends` must be zero.
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
    // The bit is almost always set already, and a load is cheaper than an atomic on one word by all work-items.
    if ((grid->levels & 1u << level) == 0u)
        atomic_or(&grid->levels, 1u << level);
}

/// Writes the entries. Entries beyond `entry_room` are counted in `ends`, not written.
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
