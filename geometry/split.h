// SPDX-License-Identifier: MIT
//
// Where a set of boxes is cut in two: across the axis along which its centres reach furthest, in the order of
// the keys below, equal keys in the order of ids. So which boxes go left depends on the set alone, and not on
// the order they are found in.
#ifndef BVHBENCH_GEOMETRY_SPLIT_H
#define BVHBENCH_GEOMETRY_SPLIT_H

#include "geometry/bounds.h"

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

/// The key of a centre along an axis.
SHARED_FN uint split_key(Point centre, uint axis)
{
    return ordered_bits(axis == 0u ? centre.x : axis == 1u ? centre.y : centre.z);
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
