// SPDX-License-Identifier: MIT
//
// Boxes in six bytes: the coordinates of a node's children as points of a grid over the node's own box, 256 along each
// axis, rounded outward (after [Ylitie2017]). A step of the grid is a power of two.
//
//     origin                                    a point q is origin + q * step, in floats
//     |--|--|--|--| ... |--|--|--|
//     0  1  2                   255             at 255 or before it lies the node's upper side
//
// That a stored box contains the one it is made of does not rest on how the sum is rounded: whoever chooses a point
// reads it back with grid_point and moves outward until it does. It always ends: point 0 is the origin, and the step is
// chosen so that point 255 is not below the upper side. q * step is exact, so contracting it into the sum changes no
// bit, but for where it overflows: an infinite upper side contains everything.
#ifndef BVHBENCH_OIBVH_WIDE_GRID_BOX_H
#define BVHBENCH_OIBVH_WIDE_GRID_BOX_H

#include "geometry/aabb.h"

SHARED_BEGIN

/// A grid: `steps` holds the exponents of the steps as floats keep them, 8 bits an axis, x lowest. 16 bytes.
typedef struct {
    float x, y, z;
    uint steps;
} BoxGrid;

/// Point q, 0 to 255, of the grid along one axis.
SHARED_FN_INLINED float grid_point(float origin, uint step, uint q)
{
    return origin + (float)q * as_float(step << 23u);
}

/// The exponent of the smallest step with which the grid from `low` reaches `high`, 1 to 248: steps are no denormals,
/// and with 2^121 the last points are infinite.
SHARED_FN uint grid_step(float low, float high)
{
    // 255 steps of 2^(e - 7) are 1.99 * 2^e: one step of the search at most, but for rounding.
    const uint exponent = (as_uint(high - low) >> 23u) & 255u;
    uint step = exponent > 8u ? exponent - 7u : 1u;
    while (grid_point(low, step, 255u) < high)
        ++step;
    return step;
}

/// How many whole steps `at` lies above the origin, roughly.
SHARED_FN_INLINED uint grid_offset(float origin, uint step, float at)
{
    return (uint)fmin((at - origin) * as_float((254u - step) << 23u), 255.0f);
}

/// A point not above `at`, which is not below the origin.
SHARED_FN_INLINED uint grid_below(float origin, uint step, float at)
{
    uint q = grid_offset(origin, step, at);
    while (grid_point(origin, step, q) > at)
        --q;
    return q;
}

/// A point not below `at`, which is not above point 255.
SHARED_FN_INLINED uint grid_above(float origin, uint step, float at)
{
    uint q = grid_offset(origin, step, at);
    while (grid_point(origin, step, q) < at)
        ++q;
    return q;
}

/// The grid of a node whose children's boxes are together `box`.
SHARED_FN BoxGrid grid_of(Aabb box)
{
    BoxGrid grid;
    grid.x = box.min_x;
    grid.y = box.min_y;
    grid.z = box.min_z;
    grid.steps = grid_step(box.min_x, box.max_x) | grid_step(box.min_y, box.max_y) << 8u |
                 grid_step(box.min_z, box.max_z) << 16u;
    return grid;
}

SHARED_FN uint grid_step_x(BoxGrid grid) { return grid.steps & 255u; }
SHARED_FN uint grid_step_y(BoxGrid grid) { return (grid.steps >> 8u) & 255u; }
SHARED_FN uint grid_step_z(BoxGrid grid) { return grid.steps >> 16u; }

/// Points of a box's sides on a grid, each 0 to 255.
typedef struct {
    uint min_x, min_y, min_z, max_x, max_y, max_z;
} GridBox;

/// The points around a box inside the grid's.
SHARED_FN GridBox points_around(BoxGrid grid, Aabb box)
{
    GridBox points;
    points.min_x = grid_below(grid.x, grid_step_x(grid), box.min_x);
    points.min_y = grid_below(grid.y, grid_step_y(grid), box.min_y);
    points.min_z = grid_below(grid.z, grid_step_z(grid), box.min_z);
    points.max_x = grid_above(grid.x, grid_step_x(grid), box.max_x);
    points.max_y = grid_above(grid.y, grid_step_y(grid), box.max_y);
    points.max_z = grid_above(grid.z, grid_step_z(grid), box.max_z);
    return points;
}

/// The box between points: it contains what they were put around.
SHARED_FN Aabb box_between(BoxGrid grid, GridBox points)
{
    Aabb box;
    box.min_x = grid_point(grid.x, grid_step_x(grid), points.min_x);
    box.min_y = grid_point(grid.y, grid_step_y(grid), points.min_y);
    box.min_z = grid_point(grid.z, grid_step_z(grid), points.min_z);
    box.max_x = grid_point(grid.x, grid_step_x(grid), points.max_x);
    box.max_y = grid_point(grid.y, grid_step_y(grid), points.max_y);
    box.max_z = grid_point(grid.z, grid_step_z(grid), points.max_z);
    return box;
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::BoxGrid) == 16);
#endif
#endif
