// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "builders/input.h"
#include "collide/pairs.h"

namespace bvhbench {

/// Returns the runs of triangles that are tested against themselves: the objects if only pairs within them are asked for, else one of all.
inline std::vector<FaceRange> tested_objects(const Input& input, uint among)
{
    if (among == static_cast<uint>(Among::within_objects))
        return input.objects;
    return {{0, input.triangle_count()}};
}

/// Returns the first triangle of each object, and the number of triangles.
inline std::vector<uint> object_starts(const std::vector<FaceRange>& objects)
{
    std::vector<uint> starts = {0};
    for (const FaceRange& object : objects)
        starts.push_back(object.first + object.count);
    return starts;
}

}  // namespace bvhbench
