// SPDX-License-Identifier: MIT
#include "harness/judge/pair_counts.h"

#include <algorithm>

namespace bvhbench {

Differences differences(const PairList& found, const PairList& right)
{
    Differences counts{0, found.surplus()};
    auto one = found.pairs().begin();
    auto other = right.pairs().begin();
    while (one != found.pairs().end() && other != right.pairs().end()) {
        counts.false_ones += *one < *other ? 1 : 0;
        counts.missed += *other < *one ? 1 : 0;
        const bool step = *one <= *other, step_other = *other <= *one;
        one += step ? 1 : 0;
        other += step_other ? 1 : 0;
    }
    counts.false_ones += static_cast<std::uint64_t>(found.pairs().end() - one);
    counts.missed += static_cast<std::uint64_t>(right.pairs().end() - other);
    return counts;
}

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
    const std::int64_t frames = input.is_swept() ? 2 : 1;
    return std::count(faces.begin(), faces.end(), true) * std::int64_t{sizeof(Face)} +
           std::count(points.begin(), points.end(), true) * frames * std::int64_t{sizeof(Point)};
}

void add_moved_bytes(std::vector<StageTime>& stages, std::string_view stage, std::int64_t bytes)
{
    for (StageTime& time : stages)
        if (time.stage == stage && time.launches > 0)
            time.moved_bytes += bytes;
}

}  // namespace bvhbench
