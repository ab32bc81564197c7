// SPDX-License-Identifier: MIT
//
// Pads boxes by a reach to each side (within.h). Ends are rounded outward: a sum errs by less than 2^-23 of it, and by 2^-124 on a
// device that flushes denormals, so that 2^-22 and 2^-120 more cover it. Ends beyond 2^60, where areas of boxes would overflow, are moved
// there, but never inside of the vertex.
//
// Proof that boxes of triangles within the distance overlap. Points a and b of the two are at most two reaches apart along each axis. So
// the lower end of the box of a is at most a - reach, that of b's at least b + reach, and a - reach <= b + reach; the other way round as
// well. Moving ends into a range is monotone, so it leaves that order.
#include "builders/stages/chunk.clh"
#include "geometry/triangle.h"

#define FARTHEST 0x1p60f

static inline float3 padded(const float3 p, const float reach)
{
    const float3 end = p + reach;
    const float3 outside = end + (fabs(end) * 0x1p-22f + 0x1p-120f);
    return reach == 0.0f ? p : max(p, max(min(outside, FARTHEST), -FARTHEST));
}

/// Writes to `low` and `high` the ends of each vertex's room.
kernel void pad_points(global const Point* restrict points, const float reach,
                       global Point* restrict low, global Point* restrict high, const uint count)
{
    const Chunk part = own_chunk(count);
    for (uint k = part.first; k < part.end; ++k) {
        const float3 p = vload3(k, (global const float*)points);
        vstore3(-padded(-p, reach), k, (global float*)low);
        vstore3(padded(p, reach), k, (global float*)high);
    }
}
