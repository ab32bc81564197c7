// SPDX-License-Identifier: MIT
//
// Grids on which Morton and Hilbert codes are computed: the cell that holds the centre of a box.
//
//     cubic       over all centres; cubic cells, sized by the longest side
//     stretched   over the scene's box; as many cells along each axis, however short the axis
//
// The cubic grid is the default. With cells stretched to the scene's sides, a step along a short axis counts as much as one
// along a long axis, which makes the trees of flat scenes several times worse. The paper's Table 4 uses the stretched grid.
#ifndef BVHBENCH_GEOMETRY_GRID_H
#define BVHBENCH_GEOMETRY_GRID_H

#include "geometry/scene_bounds.h"

SHARED_BEGIN

/// A cell of the grid, one number per axis.
typedef struct {
    uint x, y, z;
} GridCell;

/// A cubic grid: its low corner and side, both multiplied by `scale`.
typedef struct {
    Point low;
    float side;
    float scale;
} Grid;

/// Returns the longest side of a box, times `scale`. Infinite on overflow.
SHARED_FN float longest_side(Aabb box, float scale)
{
    const float x = box.max_x * scale - box.min_x * scale;
    const float y = box.max_y * scale - box.min_y * scale;
    const float z = box.max_z * scale - box.min_z * scale;
    return fmax(fmax(x, y), z);
}

/// Returns the cubic grid over the bounds of all centres. If its side overflows a float, everything is halved, which is exact
/// for all coordinates that matter at that size. Otherwise nothing is halved, so that denormals keep every bit.
SHARED_FN Grid cubic_grid(Aabb centres)
{
    const float largest = 3.402823466e+38f;
    Grid grid;
    grid.scale = longest_side(centres, 1.0f) <= largest ? 1.0f : 0.5f;
    grid.side = longest_side(centres, grid.scale);
    grid.low.x = centres.min_x * grid.scale;
    grid.low.y = centres.min_y * grid.scale;
    grid.low.z = centres.min_z * grid.scale;
    return grid;
}

/// Returns which of `cells` equal parts of [0, side] holds `offset`; the upper end belongs to the last part.
///
/// Divides instead of multiplying by a reciprocal, which is infinite for a denormal side. Clamps as a float, because the
/// conversion of out-of-range floats differs between devices. If all centres coincide, 0 / 0 is NaN, which fmax turns into 0.
SHARED_FN uint part_of(float offset, float side, float cells)
{
    return (uint)fmin(fmax(offset / side * cells, 0.0f), cells - 1.0f);
}

/// Returns the cell of a box's centre in the cubic grid with `cells` cells per side over the bounds of all centres.
SHARED_FN GridCell cubic_cell(Aabb box, Bounds bounds, float cells)
{
    const Grid grid = cubic_grid(bounds.centres);
    const Point centre = box_centre(box);
    GridCell cell;
    cell.x = part_of(centre.x * grid.scale - grid.low.x, grid.side, cells);
    cell.y = part_of(centre.y * grid.scale - grid.low.y, grid.side, cells);
    cell.z = part_of(centre.z * grid.scale - grid.low.z, grid.side, cells);
    return cell;
}

/// Returns which of `cells` equal parts of [low, high] holds `x`; 0 if low equals high. Halves its arguments, so that no
/// side overflows; only denormals lose a bit.
SHARED_FN uint part_between(float low, float high, float x, float cells)
{
    return part_of(0.5f * x - 0.5f * low, 0.5f * high - 0.5f * low, cells);
}

/// Returns the cell of a box's centre in the grid over the scene's box with `cells` cells along every axis.
SHARED_FN GridCell stretched_cell(Aabb box, Bounds bounds, float cells)
{
    const Point centre = box_centre(box);
    GridCell cell;
    cell.x = part_between(bounds.scene.min_x, bounds.scene.max_x, centre.x, cells);
    cell.y = part_between(bounds.scene.min_y, bounds.scene.max_y, centre.y, cells);
    cell.z = part_between(bounds.scene.min_z, bounds.scene.max_z, centre.z, cells);
    return cell;
}

SHARED_END

#endif
