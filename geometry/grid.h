// SPDX-License-Identifier: MIT
//
// The cells that codes number: which cell of a grid holds the centre of a box.
//
//     cubic       over all centres, one cell size for all axes, that of the longest side
//     stretched   over the scene's box, as many cells along each axis, however short
//
// The cubic grid is the default: cells stretched to the scene's sides make a step along a short axis count as
// much as one along a long axis, which costs a flat scene several times the tree quality. The paper's
// Table 4 was made on the stretched one.
#ifndef BVHBENCH_GEOMETRY_GRID_H
#define BVHBENCH_GEOMETRY_GRID_H

#include "geometry/scene_bounds.h"

SHARED_BEGIN

/// A cell of the grid, one number an axis.
typedef struct {
    uint x, y, z;
} Cell;

/// A cubic grid: its low corner and side, both times `scale`.
typedef struct {
    Point low;
    float side;
    float scale;
} Grid;

/// The longest side of a box, times `scale`. Infinite if it overflows.
SHARED_FN float longest_side(Aabb box, float scale)
{
    const float x = box.max_x * scale - box.min_x * scale;
    const float y = box.max_y * scale - box.min_y * scale;
    const float z = box.max_z * scale - box.min_z * scale;
    return fmax(fmax(x, y), z);
}

/// The cubic grid over the bounds of all centres.
///
/// From one end of the floats to the other is further than a float can tell; then everything is halved,
/// which is exact for all that matters at that size. Otherwise nothing is, so that denormals keep every bit.
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

/// Which of `cells` equal parts of [0, side] holds `offset`; the upper end belongs to the last part.
///
/// Divided, not multiplied by a reciprocal: that of a denormal side is infinite. Clamped as a float, since
/// converting what does not fit differs between devices. 0 / 0, where all centres coincide, is NaN and
/// comes out of fmax as 0.
SHARED_FN uint part_of(float offset, float side, float cells)
{
    return (uint)fmin(fmax(offset / side * cells, 0.0f), cells - 1.0f);
}

/// The cell of a box's centre in the cubic grid of `cells` cells a side over the bounds of all centres.
SHARED_FN Cell cubic_cell(Aabb box, Bounds bounds, float cells)
{
    const Grid grid = cubic_grid(bounds.centres);
    const Point centre = box_centre(box);
    Cell cell;
    cell.x = part_of(centre.x * grid.scale - grid.low.x, grid.side, cells);
    cell.y = part_of(centre.y * grid.scale - grid.low.y, grid.side, cells);
    cell.z = part_of(centre.z * grid.scale - grid.low.z, grid.side, cells);
    return cell;
}

/// Which of `cells` equal parts of [low, high] holds `x`; 0 where the two coincide. Halved, so that no side
/// overflows; only denormals lose a bit by that.
SHARED_FN uint part_between(float low, float high, float x, float cells)
{
    return part_of(0.5f * x - 0.5f * low, 0.5f * high - 0.5f * low, cells);
}

/// The cell of a box's centre in the grid over the scene's box with `cells` cells along every axis.
SHARED_FN Cell stretched_cell(Aabb box, Bounds bounds, float cells)
{
    const Point centre = box_centre(box);
    Cell cell;
    cell.x = part_between(bounds.scene.min_x, bounds.scene.max_x, centre.x, cells);
    cell.y = part_between(bounds.scene.min_y, bounds.scene.max_y, centre.y, cells);
    cell.z = part_between(bounds.scene.min_z, bounds.scene.max_z, centre.z, cells);
    return cell;
}

SHARED_END

#endif
