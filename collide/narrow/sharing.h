// SPDX-License-Identifier: MIT
//
// Finds the corners that two triangles share by index.
#ifndef BVHBENCH_COLLIDE_SHARING_H
#define BVHBENCH_COLLIDE_SHARING_H

#include "geometry/triangle.h"

SHARED_BEGIN

/// Number of distinct indices that two faces have in common, 0 to 3, and both faces with the shared corners first, in the same
/// order. A face that names an index twice shares it once.
typedef struct {
    uint count;
    Face a, b;
} Shared;

SHARED_FN bool names(Face f, uint index) { return f.a == index || f.b == index || f.c == index; }

SHARED_FN Face turned(Face f)
{
    const Face t = {f.b, f.c, f.a};
    return t;
}

/// Returns `f`, rotated so that `index`, one of its corners, comes first.
SHARED_FN Face led_by(Face f, uint index)
{
    if (f.a != index)
        f = turned(f);
    if (f.a != index)
        f = turned(f);
    return f;
}

/// Returns `f` with `index`, one of its last two corners, second.
SHARED_FN Face followed_by(Face f, uint index)
{
    const Face swapped = {f.a, f.c, f.b};
    return f.b != index ? swapped : f;
}

SHARED_FN Shared sharing(Face a, Face b)
{
    Shared shared = {0u, a, b};
    if (!share_a_vertex(a, b))
        return shared;
    const uint first = names(b, a.a) ? a.a : (names(b, a.b) ? a.b : a.c);
    a = led_by(a, first);
    b = led_by(b, first);
    const bool has_b = a.b != first && names(b, a.b), has_c = a.c != first && names(b, a.c);
    const uint second = has_b ? a.b : a.c;
    if (has_b || has_c) {
        a = followed_by(a, second);
        b = followed_by(b, second);
    }
    shared.count = 1u + (has_b ? 1u : 0u) + (has_c && (!has_b || a.b != a.c) ? 1u : 0u);
    shared.a = a;
    shared.b = b;
    return shared;
}

SHARED_END

#endif
