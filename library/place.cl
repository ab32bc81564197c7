// SPDX-License-Identifier: MIT
//
// Moves the points of one object of a scene by a pose.
#include "builders/stages/chunk.clh"
#include "geometry/dialect.h"
#include "geometry/triangle.h"

/// Returns the sum of the products of a row of a pose and (x, y, z, 1), from left to right.
static inline float along(const float4 row, const Point at)
{
    return row.x * at.x + row.y * at.y + row.z * at.z + row.w;
}

/// For all k < count, writes the point given[first + k] in the pose, whose rows are x, y and z, to points[first + k].
kernel void place_points(global const Point* restrict given, global Point* restrict points,
                         const uint first, const uint count, const float4 x, const float4 y,
                         const float4 z)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Point at = given[first + k];
        const Point placed = {along(x, at), along(y, at), along(z, at)};
        points[first + k] = placed;
    }
}
