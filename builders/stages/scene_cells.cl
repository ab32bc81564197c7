// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=64u -DCELLS_OF=3u
// check: -DGROUP_SIZE=1u -DCELLS_OF=2u
//
// Computes the cells of a scene in the box format CELLS_OF from the bounds of all of its objects, so that boxes of different
// trees can be compared. Launched as one group.
#include "builders/stages/bounds_parts.clh"
#include "geometry/box_cells.h"

__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void find_cells(
    global const Bounds* restrict bounds, const uint object_count,
    global SceneCells* restrict cells)
{
    local Bounds parts[GROUP_SIZE];
    const Bounds all = joined_partials(bounds, 0u, object_count, parts);
    if (get_local_id(0) != 0)
        return;
    const double last = last_cell(CELLS_OF);
    cells->x = axis_cells(all.scene.min_x, all.scene.max_x, last);
    cells->y = axis_cells(all.scene.min_y, all.scene.max_y, last);
    cells->z = axis_cells(all.scene.min_z, all.scene.max_z, last);
}
