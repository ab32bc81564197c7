// SPDX-License-Identifier: MIT
//
// Morton codes of box centres: the cell of a cubic grid over all centres, its bits interleaved.
//
//     code = ... x1 y1 z1 x0 y0 z0        10 bits an axis in a uint, 21 in a ulong
//
// The grid has one cell size for all axes, that of the longest. Cells stretched to the scene's sides would
// make a step along a short axis count as much as one along a long axis, which costs a flat scene several
// times the tree quality.
#ifndef BVHBENCH_GEOMETRY_MORTON_H
#define BVHBENCH_GEOMETRY_MORTON_H

#include "geometry/bounds.h"

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
SHARED_FN Cell centre_cell(Aabb box, Aabb centres, float cells)
{
    const Grid grid = cubic_grid(centres);
    const Point centre = box_centre(box);
    Cell cell;
    cell.x = part_of(centre.x * grid.scale - grid.low.x, grid.side, cells);
    cell.y = part_of(centre.y * grid.scale - grid.low.y, grid.side, cells);
    cell.z = part_of(centre.z * grid.scale - grid.low.z, grid.side, cells);
    return cell;
}

/// The low 10 bits of x, two zeros before each.
SHARED_FN uint spread_10(uint x)
{
    x &= 0x3ffu;
    x = (x | x << 16u) & 0x030000ffu;
    x = (x | x << 8u) & 0x0300f00fu;
    x = (x | x << 4u) & 0x030c30c3u;
    return (x | x << 2u) & 0x09249249u;
}

/// The low 21 bits of x, two zeros before each.
SHARED_FN ulong spread_21(ulong x)
{
    x &= 0x1ffffful;
    x = (x | x << 32u) & 0x001f00000000fffful;
    x = (x | x << 16u) & 0x001f0000ff0000fful;
    x = (x | x << 8u) & 0x100f00f00f00f00ful;
    x = (x | x << 4u) & 0x10c30c30c30c30c3ul;
    return (x | x << 2u) & 0x1249249249249249ul;
}

/// 30 bits: all that a uint holds with as many an axis.
SHARED_FN uint morton_30(Aabb box, Aabb centres)
{
    const Cell cell = centre_cell(box, centres, 1024.0f);
    return spread_10(cell.x) << 2u | spread_10(cell.y) << 1u | spread_10(cell.z);
}

/// 63 bits: all that a ulong holds with as many an axis.
SHARED_FN ulong morton_63(Aabb box, Aabb centres)
{
    const Cell cell = centre_cell(box, centres, 2097152.0f);
    return spread_21(cell.x) << 2u | spread_21(cell.y) << 1u | spread_21(cell.z);
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(bvhbench::spread_10(0x3ff) == 0x09249249);
static_assert(bvhbench::spread_10(0x201) == 0x08000001);
static_assert(bvhbench::spread_21(0x1fffff) == 0x1249249249249249);
static_assert(bvhbench::spread_21(0x100001) == 0x1000000000000001);
#endif
#endif
