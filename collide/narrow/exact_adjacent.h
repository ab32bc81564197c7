// SPDX-License-Identifier: MIT
//
// Exact test whether two triangles that share corners by index meet anywhere else.
//
// Shared corner v: a ray from v through another common point leaves each triangle at the edge opposite v. Where it leaves the
// first one, that point of the edge is in the other triangle. So they meet beyond v if and only if the far edge of one meets the
// other. This requires v off its far edge: a triangle without area is replaced by its two sides at v, their ends as far edges.
//
// Shared edge: they meet beyond it if they are in one plane and on one side of the edge; without area, if both reach beyond the
// same end of the edge.
#ifndef BVHBENCH_COLLIDE_EXACT_ADJACENT_H
#define BVHBENCH_COLLIDE_EXACT_ADJACENT_H

#include "collide/narrow/exact_contact.h"

#if HAS_DOUBLES
SHARED_BEGIN

/// Orders points along any line: by x, then y, then z.
SHARED_FN bool comes_before(Point p, Point q)
{
    if (p.x != q.x)
        return p.x < q.x;
    return p.y != q.y ? p.y < q.y : p.z < q.z;
}

/// Returns the segment from corner 0 to corner k, as a triangle without area.
SHARED_FN Corners side_to(Corners a, uint k)
{
    const Corners side = {{a.at[0], a.at[k], a.at[k]}};
    return side;
}

SHARED_FN Corners far_edge(Corners a)
{
    const Corners edge = {{a.at[1], a.at[2], a.at[2]}};
    return edge;
}

/// True if they meet beyond their shared corner 0.
SHARED_FN bool meet_beyond_corner(Corners a, Corners b)
{
    const bool thin_a = is_thin(a), thin_b = is_thin(b);
    // A thin triangle is replaced by its two sides; a side of length zero has no point beyond the corner.
    for (uint k = 0u; k < 4u; ++k) {
        const uint i = 1u + k / 2u, j = 1u + k % 2u;
        if ((!thin_a && i == 2u) || (!thin_b && j == 2u))
            continue;
        if ((thin_a && same_place(a.at[0], a.at[i])) || (thin_b && same_place(b.at[0], b.at[j])))
            continue;
        const Corners part_a = thin_a ? side_to(a, i) : a, part_b = thin_b ? side_to(b, j) : b;
        for (uint turn = 0u; turn < 2u; ++turn)
            if (triangles_meet(far_edge(turn == 0u ? part_a : part_b),
                               turn == 0u ? part_b : part_a))
                return true;
    }
    return false;
}

/// True if they meet beyond their shared edge, corners 0 and 1.
SHARED_FN bool meet_beyond_edge(Corners a, Corners b)
{
    const Point u = a.at[0], v = a.at[1], p = a.at[2], q = b.at[2];
    if (orient3d(u, v, p, q) != 0)
        return false;
    const Corners ends = {{u, p, q}};
    bool in_a_line = true;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const int turn_a = turn_of(a, axis), turn_b = turn_of(b, axis);
        if (turn_a != 0 || turn_b != 0)
            return turn_a == turn_b;
        in_a_line = in_a_line && turn_of(ends, axis) == 0;
    }
    // If u and v coincide, p and q may still lie in different directions from them.
    if (!in_a_line)
        return false;
    const Point low = comes_before(u, v) ? u : v, high = comes_before(u, v) ? v : u;
    return (comes_before(high, p) && comes_before(high, q)) ||
           (comes_before(p, low) && comes_before(q, low));
}

/// True if two triangles meet beyond the corners that they share, which are the first `shared` corners of each.
SHARED_FN bool corners_meet(Corners a, Corners b, uint shared)
{
    if (shared == 0u)
        return triangles_meet(a, b);
    if (shared == 1u)
        return meet_beyond_corner(a, b);
    return shared == 2u ? meet_beyond_edge(a, b) : true;
}

SHARED_END
#endif

#endif
