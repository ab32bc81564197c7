// SPDX-License-Identifier: MIT
//
// Second filter of the narrow phase: decides in doubles whether two triangles meet, unless a sign that it uses is in doubt.
//
// It uses signs of orientations alone, as [Guigue2003] does, but different ones. Suppose that no corner lies in the other plane
// and that each triangle crosses the other's plane. Then each triangle has one corner alone on its side, and two edges from it
// cross the plane: p -> q, p -> r and p' -> q', p' -> r'. They cross on the common line of both planes, at I, J and K, M. The
// sign of orient3d(p, q, p', q') gives the order of I and K on that line, up to a sign that is the same for all four
// combinations, since all edges cross to the far side. So the triangles are apart if the four signs are equal, else they meet.
//
// With a shared corner v as origin, the far edges cross the line, n x n', at y and z. With n the normal of a, n' that of b,
//     y ~ a1 (n'.a2) - a2 (n'.a1) = n' x (a1 x a2) = n' x n   up to the sign of n'.a1, and z ~ n x n' up to that of n.b1,
// so y and z lie on one side of v if n'.a1 and n.b1 have different signs.
//
// The error bounds are those of geometry/orient.h, with one origin for all differences and the largest of them throughout.
#ifndef BVHBENCH_COLLIDE_DOUBLE_FILTER_H
#define BVHBENCH_COLLIDE_DOUBLE_FILTER_H

#include "collide/narrow/exact_contact.h"
#include "collide/narrow/narrow_words.h"

#if HAS_DOUBLES
SHARED_BEGIN

/// Heights of three corners over a plane, scaled by twice the area of the triangle in the plane; and their error bound.
typedef struct {
    double of[3];
    double bound;
} Heights;

/// Returns the heights of the corners of `b` over the plane of `a`.
SHARED_FN_INLINED Heights heights_over(Corners a, Corners b)
{
    const Vector u = difference(a.at[1], a.at[0]), v = difference(a.at[2], a.at[0]);
    const Vector p = difference(b.at[0], a.at[0]), q = difference(b.at[1], a.at[0]);
    const Vector r = difference(b.at[2], a.at[0]);
    const Vector normal = cross_product(u, v);
    const Vector most = larger(larger(larger(magnitude(u), magnitude(v)), magnitude(p)),
                               larger(magnitude(q), magnitude(r)));
    const Heights heights = {{dot(normal, p), dot(normal, q), dot(normal, r)},
                             orient3d_bound(most)};
    return heights;
}

/// As sides_to_plane, but a side in doubt is UNSURE.
SHARED_FN_INLINED Sides likely_sides(Corners a, Corners b)
{
    const Heights heights = heights_over(a, b);
    const Sides sides = {{sign_beyond(heights.of[0], heights.bound),
                          sign_beyond(heights.of[1], heights.bound),
                          sign_beyond(heights.of[2], heights.bound)}};
    return sides;
}

SHARED_FN_INLINED bool strictly_parted(Sides sides)
{
    return sides.of[0] != UNSURE && strictly_beyond(sides);
}

SHARED_FN_INLINED bool any_unsure(Sides sides)
{
    return sides.of[0] == UNSURE || sides.of[1] == UNSURE || sides.of[2] == UNSURE;
}

/// Returns `a`, rotated so that the corner alone on its side comes first.
SHARED_FN_INLINED Corners led_by_lone(Corners a, Sides sides)
{
    const Corners second = {{a.at[1], a.at[2], a.at[0]}};
    const Corners third = {{a.at[2], a.at[0], a.at[1]}};
    if (sides.of[0] == sides.of[1])
        return third;
    return sides.of[0] == sides.of[2] ? second : a;
}

/// Verdict for two triangles, each with its first corner alone on one side of the other's plane.
SHARED_FN_INLINED uint lone_corners_verdict(Corners a, Corners b)
{
    const Vector q = difference(a.at[1], a.at[0]), r = difference(a.at[2], a.at[0]);
    const Vector lone = difference(b.at[0], a.at[0]);
    const Vector s = difference(b.at[1], a.at[0]), t = difference(b.at[2], a.at[0]);
    const Vector to_s = cross_product(lone, s), to_t = cross_product(lone, t);
    const Vector most = larger(larger(larger(magnitude(q), magnitude(r)), magnitude(lone)),
                               larger(magnitude(s), magnitude(t)));
    const double bound = orient3d_bound(most);
    const double qs = dot(q, to_s), qt = dot(q, to_t), rs = dot(r, to_s), rt = dot(r, to_t);
    const double low = fmin(fmin(qs, qt), fmin(rs, rt)), high = fmax(fmax(qs, qt), fmax(rs, rt));
    if (low < -bound && high > bound)
        return VERDICT_MEET;
    return low > bound || high < -bound ? VERDICT_APART : VERDICT_UNSURE;
}

/// Verdict for two triangles that share no corner.
SHARED_FN_INLINED uint likely_meet(Corners a, Corners b)
{
    const Sides of_b = likely_sides(a, b);
    if (strictly_parted(of_b))
        return VERDICT_APART;
    const Sides of_a = likely_sides(b, a);
    if (strictly_parted(of_a))
        return VERDICT_APART;
    if (any_unsure(of_a) || any_unsure(of_b))
        return VERDICT_UNSURE;
    return lone_corners_verdict(led_by_lone(a, of_a), led_by_lone(b, of_b));
}

SHARED_FN_INLINED bool all_beyond(Heights h)
{
    const double low = fmin(fmin(h.of[0], h.of[1]), h.of[2]);
    const double high = fmax(fmax(h.of[0], h.of[1]), h.of[2]);
    return low > h.bound || high < -h.bound;
}

SHARED_FN_INLINED bool any_in_doubt(Heights h)
{
    return fmin(fmin(fabs(h.of[0]), fabs(h.of[1])), fabs(h.of[2])) <= h.bound;
}

SHARED_FN_INLINED Point chosen(bool first, Point a, Point b)
{
    const Point p = {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
    return p;
}

/// As led_by_lone, from heights whose signs are all certain.
SHARED_FN_INLINED Corners turned_to_lone(Corners a, Heights h)
{
    const bool last = (h.of[0] > 0.0) == (h.of[1] > 0.0);
    const bool second = (h.of[0] > 0.0) == (h.of[2] > 0.0);
    const Corners turned = {{chosen(last, a.at[2], chosen(second, a.at[1], a.at[0])),
                             chosen(last, a.at[0], chosen(second, a.at[2], a.at[1])),
                             chosen(last, a.at[1], chosen(second, a.at[0], a.at[2]))}};
    return turned;
}

/// As likely_meet, but branch-free: every pair takes all steps, so that the compiler can process many pairs in wide registers.
SHARED_FN_INLINED uint likely_meet_unbranched(Corners a, Corners b)
{
    const Heights of_b = heights_over(a, b), of_a = heights_over(b, a);
    const uint verdict = lone_corners_verdict(turned_to_lone(a, of_a), turned_to_lone(b, of_b));
    const bool in_doubt = any_in_doubt(of_a) || any_in_doubt(of_b);
    const bool parted = all_beyond(of_a) || all_beyond(of_b);
    return parted ? VERDICT_APART : (in_doubt ? VERDICT_UNSURE : verdict);
}

/// Verdict for two triangles that share their first corner: whether they meet beyond it.
SHARED_FN_INLINED uint likely_meet_beyond_corner(Corners a, Corners b)
{
    // The shared corner has height 0, computed without rounding, so its side is UNSURE.
    const Sides of_b = likely_sides(a, b), of_a = likely_sides(b, a);
    const bool b_known = of_b.of[1] != UNSURE && of_b.of[2] != UNSURE;
    const bool a_known = of_a.of[1] != UNSURE && of_a.of[2] != UNSURE;
    if ((b_known && of_b.of[1] == of_b.of[2]) || (a_known && of_a.of[1] == of_a.of[2]))
        return VERDICT_APART;
    if (!a_known || !b_known)
        return VERDICT_UNSURE;
    return of_a.of[1] != of_b.of[1] ? VERDICT_MEET : VERDICT_APART;
}

/// Verdict for two triangles that share their first two corners: whether they meet beyond that edge.
SHARED_FN_INLINED uint likely_meet_beyond_edge(Corners a, Corners b)
{
    return likely_sides(a, b).of[2] != UNSURE ? VERDICT_APART : VERDICT_UNSURE;
}

/// Verdict for two triangles that share their first `shared` corners.
SHARED_FN_INLINED uint likely_verdict(Corners a, Corners b, uint shared)
{
    if (shared == 0u)
        return likely_meet(a, b);
    if (shared == 1u)
        return likely_meet_beyond_corner(a, b);
    return shared == 2u ? likely_meet_beyond_edge(a, b) : VERDICT_MEET;
}

SHARED_END
#endif

#endif
