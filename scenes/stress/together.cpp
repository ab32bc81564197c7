// SPDX-License-Identifier: MIT
//
// Meshes that lie in each other, or all but, and one that is far away.
#include <cmath>

#include "scenes/generate/generators.h"
#include "scenes/generate/outlier.h"
#include "scenes/scene.h"
#include "scenes/stress/stress_scene.h"

namespace bvhbench {
namespace {

Mesh moved(Mesh mesh, Point by)
{
    for (Point& p : mesh.points)
        p = {p.x + by.x, p.y + by.y, p.z + by.z};
    return mesh;
}

/// Sheets of `each` triangles on top of each other, `gap` apart, from `lowest` on.
Mesh stack(uint sheets, uint each, float lowest, float gap)
{
    Mesh mesh;
    for (uint k = 0; k < sheets; ++k) {
        const auto base = static_cast<uint>(mesh.points.size());
        const Mesh sheet = moved(make_grid(each), {0, 0, lowest + static_cast<float>(k) * gap});
        mesh.points.insert(mesh.points.end(), sheet.points.begin(), sheet.points.end());
        for (const Face& face : sheet.faces)
            mesh.faces.push_back({face.a + base, face.b + base, face.c + base});
    }
    return mesh;
}

/// Two stacks with their sheets between each other's.
StressScene interleaved(const StressSize& size, float at, float gap)
{
    const bool is_one_plane = at + gap == at;  // then each triangle meets those of all sheets
    const uint sheets = size.quick || is_one_plane ? 4 : 16;
    // If quick, half as many as elsewhere, a quarter of the pairs: almost all of them want exact sums.
    const uint each = (size.quick ? size.triangles() / 2 : size.triangles()) / 2 / sheets;
    return together(stack(sheets, each, at, 2 * gap), stack(sheets, each, at + gap, 2 * gap));
}

/// Each triangle `times` times, the copies spread through the order.
Mesh repeated(const Mesh& mesh, uint times)
{
    Mesh copies{mesh.points, {}};
    for (uint k = 0; k < times; ++k)
        copies.faces.insert(copies.faces.end(), mesh.faces.begin(), mesh.faces.end());
    return copies;
}

StressScene with_far_triangle(uint triangles, double diameters)
{
    Mesh mesh = make_sphere(triangles);
    Scene scene;
    scene.name = "sphere";
    scene.faces = std::move(mesh.faces);
    scene.frames = {std::move(mesh.points)};
    scene = with_outlier(std::move(scene), triangles / 3, diameters);
    return single({std::move(scene.frames.front()), std::move(scene.faces)});
}

}  // namespace

std::vector<StressCase> coplanar_cases(const StressSize& size)
{
    return {{"one plane",
             [size] {
                 const uint half = size.triangles() / 2;
                 return together(make_grid(half), moved(make_grid(half), {0.3f, 0.2f, 0}));
             }},
            {"stacks 1e-12 apart", [size] { return interleaved(size, 0, 1e-12f); }},
            {"stacks 1e-12 apart at 1", [size] { return interleaved(size, 1, 1e-12f); }},
            {"touching stacks", [size] { return interleaved(size, 0, 0); }}};
}

std::vector<StressCase> coincident_cases(const StressSize& size)
{
    const uint half = size.triangles() / 2;
    return {{"a sphere twice", [=] { return together(make_sphere(half), make_sphere(half)); }},
            {"each triangle 4 times", [=] { return single(repeated(make_sphere(half / 2), 4)); }},
            {"a hairball twice", [=] {
                 const Mesh hair = make_hairball(size.quick ? half : half / 4);
                 return together(hair, hair);
             }}};
}

std::vector<StressCase> far_triangle_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    for (const auto& [name, diameters] : {std::pair{"10", 10.0}, {"1e3", 1e3}, {"1e6", 1e6}})
        cases.push_back(
            {name, [size, far = diameters] { return with_far_triangle(size.triangles(), far); }});
    return cases;
}

}  // namespace bvhbench
