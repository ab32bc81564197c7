// SPDX-License-Identifier: MIT
//
// Exact test whether two closed triangles have a point in common, by signs of orientations alone.
//
// In space: compute the sides of each triangle's corners to the other's plane. If all are strictly on one side, the triangles are
// apart. Otherwise, unless both are in one plane, they meet if and only if an edge of one meets the other. Edges that lie in the
// other's plane need no test: what they touch there, another edge touches too. An edge that crosses the plane of a triangle meets
// the triangle if the triangle's edges all turn the same way around it, or not at all.
//
// In one plane: project along an axis that the plane is not parallel to. Two convex sets are then apart if their boxes are, or if
// the line of an edge of one has the other strictly beyond it. A triangle without area, a segment or a point, is such a set too.
// But two triangles without area determine no common plane: they are apart if the line of an edge of one passes an edge of the
// other in space; otherwise they meet if they do in the projections along all three axes, at least one of which loses nothing.
//
// docs/contacts.md gives the proofs.
#ifndef BVHBENCH_COLLIDE_EXACT_CONTACT_H
#define BVHBENCH_COLLIDE_EXACT_CONTACT_H

#include "geometry/orient.h"

#if HAS_DOUBLES
SHARED_BEGIN

typedef struct {
    Point at[3];
} Corners;

#ifdef __OPENCL_C_VERSION__
static inline Corners corners_of(global const Point* points, const Face face)
{
    const Corners corners = {{points[face.a], points[face.b], points[face.c]}};
    return corners;
}
#endif

/// Sides of three corners relative to a plane or line: -1, 0 or 1 each.
typedef struct {
    int of[3];
} Sides;

SHARED_FN bool strictly_beyond(Sides sides)
{
    return sides.of[0] != 0 && sides.of[0] == sides.of[1] && sides.of[1] == sides.of[2];
}

SHARED_FN bool all_within(Sides sides)
{
    return sides.of[0] == 0 && sides.of[1] == 0 && sides.of[2] == 0;
}

/// Returns the sides of the corners of `b` relative to the plane of `a`.
SHARED_FN Sides sides_to_plane(Corners a, Corners b)
{
    const Point p = a.at[0], q = a.at[1], r = a.at[2];
    const Sides sides = {
        {orient3d(p, q, r, b.at[0]), orient3d(p, q, r, b.at[1]), orient3d(p, q, r, b.at[2])}};
    return sides;
}

/// True if an edge of `a` that is not in the plane of `b` meets `b`. `sides` are those of `a`.
SHARED_FN bool pierces(Corners a, Corners b, Sides sides)
{
    for (uint i = 0u; i < 3u; ++i) {
        const uint next = (i + 1u) % 3u;
        if (sides.of[i] * sides.of[next] > 0 || (sides.of[i] == 0 && sides.of[next] == 0))
            continue;
        bool left = false, right = false;
        for (uint j = 0u; j < 3u && !(left && right); ++j) {
            const int turn = orient3d(a.at[i], a.at[next], b.at[j], b.at[(j + 1u) % 3u]);
            left = left || turn > 0;
            right = right || turn < 0;
        }
        if (!(left && right))
            return true;
    }
    return false;
}

SHARED_FN int turn_of(Corners a, uint axis) { return orient2d(a.at[0], a.at[1], a.at[2], axis); }

/// True if the triangle has no area.
SHARED_FN bool is_thin(Corners a)
{
    return turn_of(a, 0u) == 0 && turn_of(a, 1u) == 0 && turn_of(a, 2u) == 0;
}

/// True if, projected along `axis`, the line of an edge of `a` (of orientation `turn`) has `b` strictly beyond it.
SHARED_FN bool edge_parts(Corners a, Corners b, int turn, uint axis)
{
    for (uint i = 0u; i < 3u; ++i) {
        Sides sides = {{0, 0, 0}};
        for (uint j = 0u; j < 3u; ++j)
            sides.of[j] = orient2d(a.at[i], a.at[(i + 1u) % 3u], b.at[j], axis);
        if (strictly_beyond(sides) && sides.of[0] != turn)
            return true;
    }
    return false;
}

/// For two triangles without area: true if an edge of one passes an edge of the other without meeting its line.
SHARED_FN bool pass_in_space(Corners a, Corners b)
{
    for (uint k = 0u; k < 9u; ++k) {
        const uint i = k / 3u, j = k % 3u;
        if (orient3d(a.at[i], a.at[(i + 1u) % 3u], b.at[j], b.at[(j + 1u) % 3u]) != 0)
            return true;
    }
    return false;
}

/// True if two triangles in one plane, or both without area, meet.
SHARED_FN bool meet_in_plane(Corners a, Corners b)
{
    if (!overlap(triangle_box(a.at[0], a.at[1], a.at[2]), triangle_box(b.at[0], b.at[1], b.at[2])))
        return false;
    bool parted = false, both_thin = true;
    for (uint axis = 0u; axis < 3u && both_thin; ++axis) {
        const int turn_a = turn_of(a, axis), turn_b = turn_of(b, axis);
        both_thin = turn_a == 0 && turn_b == 0;
        const bool parted_here = edge_parts(a, b, turn_a, axis) || edge_parts(b, a, turn_b, axis);
        parted = both_thin ? parted || parted_here : parted_here;
    }
    return !parted && !(both_thin && pass_in_space(a, b));
}

SHARED_FN bool same_place(Point p, Point q) { return p.x == q.x && p.y == q.y && p.z == q.z; }

/// True if a corner of one is where one of the other is: so equal triangles need no sums, nor neighbours that name no corner alike.
SHARED_FN bool have_common_place(Corners a, Corners b)
{
    bool is_found = false;
    for (uint k = 0u; k < 3u; ++k)
        is_found = is_found || same_place(a.at[k], b.at[0]) || same_place(a.at[k], b.at[1]) ||
                   same_place(a.at[k], b.at[2]);
    return is_found;
}

SHARED_FN bool triangles_meet(Corners a, Corners b)
{
    if (have_common_place(a, b))
        return true;
    const Sides of_a = sides_to_plane(b, a);
    if (strictly_beyond(of_a))
        return false;
    // If `b` has no area, sides of 0 say nothing about its plane.
    if (all_within(of_a) && !is_thin(b))
        return meet_in_plane(a, b);
    const Sides of_b = sides_to_plane(a, b);
    if (strictly_beyond(of_b))
        return false;
    if (all_within(of_a) && all_within(of_b))
        return meet_in_plane(a, b);
    return pierces(a, b, of_a) || pierces(b, a, of_b);
}

SHARED_END
#endif

#endif
