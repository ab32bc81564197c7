// SPDX-License-Identifier: MIT
//
// Boxes as triangles: corners 2k and 2k + 1 are the least and the greatest of box k, and so is the box of the triangle that
// has the one of them once and the other twice.
#include "builders/stages/chunk.clh"
#include "geometry/triangle.h"

kernel void box_faces(global Face* restrict faces, const uint count)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Face face = {2u * k, 2u * k + 1u, 2u * k + 1u};
        faces[k] = face;
    }
}
