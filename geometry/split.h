// SPDX-License-Identifier: MIT
//
// Splitting of a set of boxes in two: as many boxes go left as the tree has leaves there, namely those whose centres come first
// along one axis; ties are broken by id. The result depends on the set alone and not on the order in which the boxes are
// stored. The axis is chosen in one of two ways:
//
//     by cell    the longest side of the node's cell: for large nodes, without reading the boxes
//     by cost    the axis whose halves have the smallest boxes around their centres, weighted by their counts
//
// The cell of a node is the part of the box around all centres that the cuts above the node leave. It is divided into slabs,
// and the children's cells end at the edges of the slab that holds the median, so both are known before the median is.
#ifndef BVHBENCH_GEOMETRY_SPLIT_H
#define BVHBENCH_GEOMETRY_SPLIT_H

#include "geometry/scene_bounds.h"

SHARED_BEGIN

/// Returns the axis (0, 1 or 2) of the longest side of `centres`, the first of equals. Sides that overflow are equal.
SHARED_FN uint widest_axis(Aabb centres)
{
    const float x = centres.max_x - centres.min_x;
    const float y = centres.max_y - centres.min_y;
    const float z = centres.max_z - centres.min_z;
    return x >= y && x >= z ? 0u : y >= z ? 1u : 2u;
}

/// Returns an integer that compares as `x` does; `x` must be neither NaN nor -0.
SHARED_FN uint ordered_bits(float x)
{
    const uint bits = as_uint(x);
    return bits ^ ((bits & 0x80000000u) != 0u ? 0xffffffffu : 0x80000000u);
}

/// Returns the float from which ordered_bits made `ordered`.
SHARED_FN float from_ordered_bits(uint ordered)
{
    return as_float(ordered ^ ((ordered & 0x80000000u) != 0u ? 0x80000000u : 0xffffffffu));
}

/// Returns the coordinate of `at` along `axis`.
SHARED_FN float coordinate(Point at, uint axis)
{
    return axis == 0u ? at.x : axis == 1u ? at.y : at.z;
}

/// Returns the sort key of a centre along an axis.
SHARED_FN uint split_key(Point centre, uint axis) { return ordered_bits(coordinate(centre, axis)); }

/// Returns the power of two that scales `side` to between 1 and 2, or the nearest such power in range.
SHARED_FN float scale_to_one(float side)
{
    const uint exponent = as_uint(side) >> 23u & 255u;
    return as_float((exponent < 253u ? 254u - exponent : 1u) << 23u);
}

/// Returns the cost of one half of a node: the half surface of the box around its `count` centres, with sides x, y and z, times
/// `count`. Sides are scaled first, so that the surfaces of small and large scenes stay in the range of floats.
SHARED_FN float cost_of_half(float x, float y, float z, float scale, uint count)
{
    x *= scale;
    y *= scale;
    z *= scale;
    return (x * y + y * z + z * x) * (float)count;
}

/// Returns the axis with the smallest cost, the first of equals.
SHARED_FN uint cheapest_axis(float x, float y, float z)
{
    return y < x ? (z < y ? 2u : 1u) : (z < x ? 2u : 0u);
}

/// Cut of a cell across its longest side into slabs of equal width. 16 bytes.
typedef struct {
    float low;
    float slabs_per_unit;
    uint axis;
    uint slab;  ///< slab of the last box that goes left; beyond all slabs if there is no cut
} CellCut;

/// Returns the number of slabs for a node of 2^height leaves on a level, such that few boxes share a slab. On the first levels,
/// the counters of all nodes together, at most 2^13, must fit a work-group's local memory.
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

/// Returns the slabs of a cell. `slab` is 0 until the median is known.
SHARED_FN CellCut cut_of_cell(Aabb cell, uint slabs)
{
    CellCut cut;
    cut.axis = widest_axis(cell);
    cut.low = low_side(cell, cut.axis);
    cut.slabs_per_unit = (float)slabs / (high_side(cell, cut.axis) - cut.low);
    cut.slab = 0u;
    return cut;
}

/// Returns the slab that holds a coordinate along the cut's axis. Never decreases as the coordinate rises; coordinates outside
/// the cell belong to its first or last slab. In a cell without extent, 0 * infinity is NaN, which fmax turns into 0.
SHARED_FN uint slab_of(CellCut cut, float at, uint slabs)
{
    return (uint)fmin(fmax((at - cut.low) * cut.slabs_per_unit, 0.0f), (float)(slabs - 1u));
}

/// Returns the lower edge of a slab.
SHARED_FN float slab_edge(Aabb cell, CellCut cut, uint slab, uint slabs)
{
    const float high = high_side(cell, cut.axis);
    return slab == 0u      ? cut.low
           : slab >= slabs ? high
                           : cut.low + (float)slab * ((high - cut.low) / (float)slabs);
}

/// Returns the left child's cell: all slabs up to `cut.slab`, inclusive. The right child's cell begins with `cut.slab`.
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

/// Returns how many of `count` boxes go left if the left subtree has room for 2^(height - 1) leaves: the split of a tree
/// without pointers, whose levels fill from the left.
SHARED_FN uint left_count(uint count, uint height)
{
    return count < 1u << (height - 1u) ? count : 1u << (height - 1u);
}

/// Returns `box` extended by a point.
SHARED_FN Aabb grown_to(Aabb box, Point at)
{
    const Aabb point = {at.x, at.y, at.z, at.x, at.y, at.z};
    return merged(box, point);
}

SHARED_END

#endif
