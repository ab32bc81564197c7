// SPDX-License-Identifier: MIT
#include "harness/judge/query_bytes.h"

#include <algorithm>

namespace bvhbench {

std::int64_t corner_bytes(std::span<const Pair> pairs, const Input& input)
{
    std::vector<bool> faces(input.faces.size()), points(input.points.size());
    const auto see = [&](uint triangle) {
        if (faces[triangle])
            return;
        faces[triangle] = true;
        const Face face = input.faces[triangle];
        points[face.a] = points[face.b] = points[face.c] = true;
    };
    for (const Pair pair : pairs) {
        see(pair.a);
        see(pair.b);
    }
    return std::count(faces.begin(), faces.end(), true) * std::int64_t{sizeof(Face)} +
           std::count(points.begin(), points.end(), true) * std::int64_t{sizeof(Point)};
}

void add_moved_bytes(std::vector<StageTime>& stages, std::string_view stage, std::int64_t bytes)
{
    for (StageTime& time : stages)
        if (time.stage == stage && time.launches > 0)
            time.moved_bytes += bytes;
}

}  // namespace bvhbench
