// SPDX-License-Identifier: MIT
//
// Inputs: whether there is anything in one that no tree can be built over, and boxes as triangles. *is_bad is 0 before; 1
// after if there is something. Which one it is, the host finds out.
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

/// Corners 2k and 2k + 1 are the least and the greatest of box k, and so is the box of the triangle that has the one of them
/// once and the other twice.
kernel void box_faces(global Face* restrict faces, const uint count)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Face face = {2u * k, 2u * k + 1u, 2u * k + 1u};
        faces[k] = face;
    }
}
