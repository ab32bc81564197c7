// SPDX-License-Identifier: MIT
//
// One entry point an order: codes[k] is afterwards the code of boxes[k], given the bounds of all centres.
// The code itself is a function shared with the host.
#include "geometry/box_words.clh"
#include "geometry/morton.h"

kernel void morton30(global const float2* restrict boxes, global const Bounds* restrict bounds,
                     global uint* restrict codes, const uint count)
{
    const uint k = (uint)get_global_id(0);
    if (k < count)
        codes[k] = morton_30(load_box(boxes, k), bounds->centres);
}

kernel void morton63(global const float2* restrict boxes, global const Bounds* restrict bounds,
                     global ulong* restrict codes, const uint count)
{
    const uint k = (uint)get_global_id(0);
    if (k < count)
        codes[k] = morton_63(load_box(boxes, k), bounds->centres);
}
