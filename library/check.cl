// SPDX-License-Identifier: MIT
//
// Whether there is anything in an input that no tree can be built over. *is_bad is 0 before; 1 after if there is. Which one
// it is, the host finds out.
#include "builders/stages/chunk.clh"
#include "geometry/triangle.h"

/// Neither infinite nor no number: an exponent with a bit that is 0.
static inline bool is_finite(const Point point)
{
    const uint exponent = 0x7f800000u;
    return (as_uint(point.x) & exponent) != exponent && (as_uint(point.y) & exponent) != exponent &&
           (as_uint(point.z) & exponent) != exponent;
}

/// Corners of all `count` faces: there up to `last`, and finite.
kernel void check_triangles(global const Point* restrict points, const uint last,
                            global const Face* restrict faces, const uint count,
                            global uint* is_bad)
{
    const Chunk chunk = own_chunk(count);
    bool is_good = true;
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Face face = faces[k];
        const bool is_there = face.a <= last && face.b <= last && face.c <= last;
        is_good = is_good && is_there && is_finite(points[face.a]) && is_finite(points[face.b]) &&
                  is_finite(points[face.c]);
    }
    if (!is_good)
        *is_bad = 1u;
}

/// Boxes as pairs of corners: finite, and none ends before it begins.
kernel void check_boxes(global const Point* restrict corners, const uint count, global uint* is_bad)
{
    const Chunk chunk = own_chunk(count);
    bool is_good = true;
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Point low = corners[2ul * k], high = corners[2ul * k + 1ul];
        is_good = is_good && is_finite(low) && is_finite(high) && low.x <= high.x &&
                  low.y <= high.y && low.z <= high.z;
    }
    if (!is_good)
        *is_bad = 1u;
}
