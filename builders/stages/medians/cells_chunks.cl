// SPDX-License-Identifier: MIT
//
// Nodes are halved at the exact median by their cells, each by one work-item: the form of cells_groups.cl for a
// few fast cores.
#include "builders/stages/medians/cells.clh"
#include "builders/stages/medians/select.clh"

/// Halve the `count` leaves from `first` on, those of a node, and leave its children's cells.
static inline void halve(global const float2* boxes, global uint* ids, global ulong* keys,
                         global Aabb* cells, const uint first, const uint count, const uint level,
                         const uint height)
{
    const uint node = first_node(level) + (first >> height);
    const uint child = first_node(level + 1u) + 2u * (first >> height);
    const uint left = left_count(count, height);
    const Aabb cell = cells[node];
    if (left == count) {
        cells[child] = cell;
        return;
    }
    const uint slabs = slab_count(level, height);
    CellCut cut = cut_of_cell(cell, slabs);
    select_left(boxes, ids, keys, cut.axis, first, count, left);
    for (uint k = first; k < first + left; ++k) {
        const Point centre = box_centre(load_box(boxes, (uint)keys[k]));
        cut.slab = max(cut.slab, slab_of(cut, coordinate(centre, cut.axis), slabs));
    }
    for (uint k = first; k < first + count; ++k)
        ids[k] = (uint)keys[k];
    cells[child] = left_cell(cell, cut, slabs);
    cells[child + 1u] = right_cell(cell, cut, slabs);
}

/// The nodes on `level`, a work-item each, are halved, their children are, and so on down to what is
/// 2^(bottom - 1) leaves high. `keys` is scratch, one a leaf; `cells` of a level are known.
kernel void halve_nodes(global const float2* restrict boxes, global const Bounds* restrict bounds,
                        global uint* restrict ids, global ulong* restrict keys,
                        global Aabb* restrict cells, const uint count, const uint root_height,
                        const uint level, const uint bottom)
{
    const uint top = root_height - level;
    const uint start = (uint)get_global_id(0) << top;
    const uint here = min(1u << top, count - start);
    if (level == 0u)
        cells[0] = bounds->centres;
    for (uint height = top; height >= bottom; --height)
        for (uint first = 0u; first < here; first += 1u << height)
            halve(boxes, ids, keys, cells, start + first, min(1u << height, here - first),
                  root_height - height, height);
}
