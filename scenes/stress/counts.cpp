// SPDX-License-Identifier: MIT
//
// How many triangles there are: at powers of two and beside them, where implicit layouts go wrong, and past 2^24, where
// a float no longer tells a number from the next.
#include "scenes/generate/generators.h"
#include "scenes/stress/stress_scene.h"

namespace bvhbench {
namespace {

/// Sixteen rows of degenerate triangles, each over the next two of its row: pairs can be counted, and a sweep along the rows
/// finds them soon however many there are. What is over goes into the last row: with a row more for it, the scene would have
/// other bounds and so other codes, and fronts three times as large, too large for one piece of memory on PoCL.
Mesh rows(uint triangles)
{
    static constexpr uint row = 1u << 20, last = 15;
    Mesh mesh;
    mesh.points.reserve(triangles + std::size_t{1});
    mesh.faces.reserve(triangles);
    const auto row_of = [](uint k) { return k / row < last ? k / row : last; };
    for (uint k = 0; k < triangles; ++k) {
        const auto x = static_cast<float>(k - row_of(k) * row),
                   y = static_cast<float>(4 * row_of(k));
        mesh.points.push_back({x, y, static_cast<float>(k % 3)});
        const uint next = k + 1 < triangles && row_of(k + 1) == row_of(k) ? k + 1 : k;
        mesh.faces.push_back({k, next, k});
    }
    return mesh;
}

}  // namespace

std::vector<StressCase> counted_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    const auto add = [&](uint triangles) {
        cases.push_back({std::to_string(triangles), [=] { return single(make_soup(triangles)); }});
    };
    for (const uint few : {1u, 2u, 3u})
        add(few);
    for (uint k = size.quick ? 3 : 2; k <= (size.quick ? 9u : 17u); k += 3)
        for (const uint beside : {(1u << k) - 1, 1u << k, (1u << k) + 1})
            if (beside > 3)
                add(beside);
    return cases;
}

std::vector<StressCase> large_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    if (!size.quick)
        for (const uint triangles : {(1u << 24) - 1, (1u << 24) + 1})
            cases.push_back(
                {std::to_string(triangles), [=] { return single(rows(triangles)); }, true});
    return cases;
}

}  // namespace bvhbench
