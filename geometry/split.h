// SPDX-License-Identifier: MIT
//
// Where a set of boxes is cut in two: so many go left as the tree has leaves there, those whose centres come
// first along one axis, equals by id. So which boxes go left depends on the set alone, and not on the order
// they are found in. The axis is chosen in one of two ways:
//
//     by cell    the longest side of the node's cell: for large nodes, without looking at the boxes
//     by cost    the axis whose halves have the smallest boxes around their centres, weighed by their counts
//
// A cell is what the cuts above a node have left of the box around all centres. It is cut at the edges of
// slabs, between which the median lies, so that both children's cells are known before the median is.
#ifndef BVHBENCH_GEOMETRY_SPLIT_H
#define BVHBENCH_GEOMETRY_SPLIT_H

#include "geometry/scene_bounds.h"

SHARED_BEGIN

/// 0, 1 or 2: the longest side of the box around all centres, the first of equals. Sides that overflow are
/// equal.
SHARED_FN uint widest_axis(Aabb centres)
{
    const float x = centres.max_x - centres.min_x;
    const float y = centres.max_y - centres.min_y;
    const float z = centres.max_z - centres.min_z;
    return x >= y && x >= z ? 0u : y >= z ? 1u : 2u;
}

/// An integer that compares as `x` does; `x` is no NaN and no -0.
SHARED_FN uint ordered_bits(float x)
{
    const uint bits = as_uint(x);
    return bits ^ ((bits & 0x80000000u) != 0u ? 0xffffffffu : 0x80000000u);
}

/// The float that ordered_bits was made of.
SHARED_FN float from_ordered_bits(uint ordered)
{
    return as_float(ordered ^ ((ordered & 0x80000000u) != 0u ? 0x80000000u : 0xffffffffu));
}

/// Along an axis.
SHARED_FN float coordinate(Point at, uint axis)
{
    return axis == 0u ? at.x : axis == 1u ? at.y : at.z;
}

/// The key of a centre along an axis.
SHARED_FN uint split_key(Point centre, uint axis) { return ordered_bits(coordinate(centre, axis)); }

/// A power of two that brings `side` to between 1 and 2, or as near as there are such powers.
SHARED_FN float scale_to_one(float side)
{
    const uint exponent = as_uint(side) >> 23u & 255u;
    return as_float((exponent < 253u ? 254u - exponent : 1u) << 23u);
}

/// What a half of a node costs: the surface of the box around its `count` centres, of sides x, y and z, times
/// their number. Sides are scaled first, so that neither a small nor a large scene's surfaces leave the range
/// of floats.
SHARED_FN float cost_of_half(float x, float y, float z, float scale, uint count)
{
    x *= scale;
    y *= scale;
    z *= scale;
    return (x * y + y * z + z * x) * (float)count;
}

/// The axis with the smallest cost, the first of equals.
SHARED_FN uint cheapest_axis(float x, float y, float z)
{
    return y < x ? (z < y ? 2u : 1u) : (z < x ? 2u : 0u);
}

/// How a cell is cut across its longest side into slabs of equal width. 16 bytes.
typedef struct {
    float low;
    float slabs_per_unit;
    uint axis;
    uint slab;  ///< that of the last box that goes left; past all slabs if there is no cut
} CellCut;

/// Slabs for a node on a level, 2^height leaves high: as many as leave few boxes in one. On the first levels
/// the counts of all nodes together, 2^13, are to fit a work-group's memory.
SHARED_FN uint slab_count(uint level, uint height)
{
    const uint most = level < 3u ? 4096u >> level : level < 6u ? 8192u >> level : 1024u;
    const uint wanted = height < 11u ? 128u : 1u << (height < 16u ? height - 4u : 12u);
    return wanted < most ? wanted : most;
}

SHARED_FN float low_side(Aabb cell, uint axis)
{
    return axis == 0u ? cell.min_x : axis == 1u ? cell.min_y : cell.min_z;
}

SHARED_FN float high_side(Aabb cell, uint axis)
{
    return axis == 0u ? cell.max_x : axis == 1u ? cell.max_y : cell.max_z;
}

/// The slabs of a cell; the last that goes left is open yet.
SHARED_FN CellCut cut_of_cell(Aabb cell, uint slabs)
{
    CellCut cut;
    cut.axis = widest_axis(cell);
    cut.low = low_side(cell, cut.axis);
    cut.slabs_per_unit = (float)slabs / (high_side(cell, cut.axis) - cut.low);
    cut.slab = 0u;
    return cut;
}

/// Which slab holds a coordinate along the cut's axis. Never falls where the coordinate rises; what is not in
/// the cell belongs to its first or last slab. 0 * infinity, in a cell without extent, is NaN and
/// comes out of fmax as 0.
SHARED_FN uint slab_of(CellCut cut, float at, uint slabs)
{
    return (uint)fmin(fmax((at - cut.low) * cut.slabs_per_unit, 0.0f), (float)(slabs - 1u));
}

/// The lower edge of a slab.
SHARED_FN float slab_edge(Aabb cell, CellCut cut, uint slab, uint slabs)
{
    const float high = high_side(cell, cut.axis);
    return slab == 0u      ? cut.low
           : slab >= slabs ? high
                           : cut.low + (float)slab * ((high - cut.low) / (float)slabs);
}

/// What the cut leaves of a cell on the left: all slabs to the last that goes left; on the right: that and
/// all after it.
SHARED_FN Aabb left_cell(Aabb cell, CellCut cut, uint slabs)
{
    const float edge = slab_edge(cell, cut, cut.slab + 1u, slabs);
    if (cut.axis == 0u)
        cell.max_x = edge;
    else if (cut.axis == 1u)
        cell.max_y = edge;
    else
        cell.max_z = edge;
    return cell;
}

SHARED_FN Aabb right_cell(Aabb cell, CellCut cut, uint slabs)
{
    const float edge = slab_edge(cell, cut, cut.slab, slabs);
    if (cut.axis == 0u)
        cell.min_x = edge;
    else if (cut.axis == 1u)
        cell.min_y = edge;
    else
        cell.min_z = edge;
    return cell;
}

/// Of `count` boxes over leaves of which the left side holds 2^(height - 1): how many go left. This is the
/// split of a tree without pointers, whose levels fill up from the left.
SHARED_FN uint left_count(uint count, uint height)
{
    return count < 1u << (height - 1u) ? count : 1u << (height - 1u);
}

/// Grown by a point.
SHARED_FN Aabb grown_to(Aabb box, Point at)
{
    const Aabb point = {at.x, at.y, at.z, at.x, at.y, at.z};
    return merged(box, point);
}

SHARED_END

#endif
