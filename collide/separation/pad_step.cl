// SPDX-License-Identifier: MIT
//
// Pads the boxes of vertices that move by a reach to each side (collide/within/pad.cl): features that come as near as two reaches between
// two frames have swept boxes that overlap. At a time t each corner is at (1 - t) p + t q, so that the features lie within the swept boxes
// of p and q, and with them points at most two reaches apart: the proof of pad.cl holds for these.
#include "collide/within/pad.cl"

/// Writes to `low` and `high` the ends of each vertex's room in the step.
kernel void pad_step(global const Point* restrict points, global const Point* restrict end_points,
                     const float reach, global Point* restrict low, global Point* restrict high,
                     const uint count)
{
    const Chunk part = own_chunk(count);
    for (uint k = part.first; k < part.end; ++k) {
        const float3 p = vload3(k, (global const float*)points);
        const float3 q = vload3(k, (global const float*)end_points);
        vstore3(-padded(-min(p, q), reach), k, (global float*)low);
        vstore3(padded(max(p, q), reach), k, (global float*)high);
    }
}
