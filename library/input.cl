// SPDX-License-Identifier: MIT
//
// Checks input values, and makes faces for boxes. A check sets *is_bad, 0 before the launch, to 1 if any value is invalid; the
// host then searches for the first one.
#include "builders/stages/chunk.clh"
#include "geometry/triangle.h"

/// True if no coordinate is infinite or NaN: each exponent has a zero bit.
static inline bool is_finite(const Point point)
{
    const uint exponent = 0x7f800000u;
    return (as_uint(point.x) & exponent) != exponent && (as_uint(point.y) & exponent) != exponent &&
           (as_uint(point.z) & exponent) != exponent;
}

/// Checks that the corner indices of all `count` faces are at most `last` and that the corners are finite.
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

/// Checks that both corners of each box are finite and that no minimum exceeds its maximum.
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

/// Writes one face per box. Points 2k and 2k + 1 are the minimum and maximum corners of box k, so the bounding box of face
/// (2k, 2k + 1, 2k + 1) is box k.
kernel void box_faces(global Face* restrict faces, const uint count)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Face face = {2u * k, 2u * k + 1u, 2u * k + 1u};
        faces[k] = face;
    }
}
