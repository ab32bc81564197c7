// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/generate/vector.h"
#include "scenes/stress/stress_scene.h"

namespace bvhbench {
namespace {

struct Named {
    const char* name;
    double value;
};

// Families that vary coordinates: far from the origin, and of any size that floats represent. Pairs are exact for floats as
// stored.

std::vector<StressCase> translated_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    for (const auto& [name, by] :
         {Named{"1", 1}, {"1e3", 1e3}, {"1e6", 1e6}, {"1e9", 1e9}, {"1e12", 1e12}}) {
        const bool is_one_place = by > 1e7;  // floats are at least one unit apart
        const uint triangles = is_one_place ? size.crowded_triangles() : size.triangles();
        cases.push_back({name, [=, seed = size.seed, by = by] {
                             return changed(crossed_spheres(triangles, seed),
                                            [by](double x) { return x + by; });
                         }});
    }
    return cases;
}

std::vector<StressCase> scaled_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    for (const auto& [name, by] : {Named{"denormal", 0x1p-140},
                                   {"1e-38", 1e-38},
                                   {"1e-30", 1e-30},
                                   {"1e-20", 1e-20},
                                   {"1e-10", 1e-10},
                                   {"1e10", 1e10},
                                   {"1e17", 1e17},
                                   {"1e20", 1e20},
                                   {"1e30", 1e30}})
        cases.push_back({name, [size, by = by] {
                             return changed(crossed_spheres(size.triangles(), size.seed),
                                            [by](double x) { return x * by; });
                         }});
    return cases;
}

// Two spheres with some non-finite vertices. Loaded scenes never have any, because `finished` refuses them.

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

StressScene with(const StressSize& size, std::initializer_list<Point> places)
{
    StressScene scene = crossed_spheres(size.triangles(), size.seed);
    std::size_t at = scene.mesh.points.size() / 3;
    for (const Point& place : places) {
        scene.mesh.points[at] = place;
        at += 7;
    }
    return scene;
}

std::vector<StressCase> not_finite_cases(const StressSize& size)
{
    return {{"one NaN",
             [=] {
                 return with(size, {{nan, nan, nan}});
             }},
            {"one NaN coordinate",
             [=] {
                 return with(size, {{0, nan, 0}});
             }},
            {"one infinite",
             [=] {
                 return with(size, {{infinity, infinity, infinity}});
             }},
            {"infinite both ways", [=] {
                 return with(size, {{infinity, 0, 0}, {-infinity, 0, 0}, {0, infinity, -infinity}});
             }}};
}

// Families that vary the number of triangles: powers of two and their neighbours, where implicit layouts may fail, and more
// than 2^24, where floats no longer represent every integer.

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

/// Returns sixteen rows of degenerate triangles, each overlapping the next two of its row: pairs can be counted, and a sweep
/// along the rows finds them quickly for any number of triangles. The remainder is added to the last row: an additional row
/// would change the bounds and so the codes, and fronts would be three times as large, too large for one allocation on PoCL.
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

std::vector<StressCase> large_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    if (!size.quick)
        for (const uint triangles : {(1u << 24) - 1, (1u << 24) + 1})
            cases.push_back(
                {std::to_string(triangles), [=] { return single(rows(triangles)); }, true});
    return cases;
}

// To add a family, add its line here.
constexpr StressFamily families[] = {
    {"translate", "two spheres far from the origin: 1 to 1e12 units", translated_cases},
    {"scale", "two spheres from denormals to 1e30", scaled_cases},
    {"degenerate", "triangles that are segments or points, alone and among others",
     degenerate_cases},
    {"needles", "triangles a million times as long as wide", needle_cases},
    {"coplanar", "sheets in one plane, and stacks of them hardly apart", coplanar_cases},
    {"coincident", "a mesh twice, and a mesh with each triangle several times", coincident_cases},
    {"far-triangle", "one triangle at 10 to 1e6 diameters", far_triangle_cases},
    {"not-finite", "NaN and infinite vertices among others", not_finite_cases},
    {"sizes", "1, 2, 3, 2^k and 2^k +- 1 triangles", counted_cases},
    {"large", "past 2^24 leaves, where floats no longer count", large_cases},
};

}  // namespace

std::span<const StressFamily> stress_families() { return families; }

StressScene single(Mesh mesh)
{
    const auto faces = static_cast<uint>(mesh.faces.size());
    return {std::move(mesh), {{0, faces}}};
}

StressScene together(const Mesh& first, const Mesh& second)
{
    const auto faces = static_cast<uint>(first.faces.size());
    Mesh both = first;
    append(both, second);
    return {std::move(both), {{0, faces}, {faces, static_cast<uint>(second.faces.size())}}};
}

StressScene crossed_spheres(uint triangles, std::uint64_t seed)
{
    const Mesh first = make_sphere(triangles / 2);
    Mesh second = make_sphere(triangles - triangles / 2);
    Random random(seed);
    const Point by = random.in_ball();
    for (Point& p : second.points)
        p = p + 0.5f * by;
    return together(first, second);
}

}  // namespace bvhbench
