// SPDX-License-Identifier: MIT
//
// Triangles without area, and triangles with hardly any.
#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/stress/stress_scene.h"

namespace bvhbench {
namespace {

Mesh with_corners_of(uint triangles)
{
    Mesh mesh;
    mesh.points.resize(3 * std::size_t{triangles});
    for (uint k = 0; k < triangles; ++k)
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    return mesh;
}

/// All along one line, each over the next two.
Mesh collinear(uint triangles)
{
    Mesh mesh = with_corners_of(triangles);
    for (uint k = 0; k < triangles; ++k) {
        const auto x = static_cast<float>(k);
        mesh.points[3 * k] = {x, 2 * x, -x};
        mesh.points[3 * k + 1] = {x + 2.5f, 2 * x + 5, -x - 2.5f};
        mesh.points[3 * k + 2] = {x + 1, 2 * x + 2, -x - 1};
    }
    return mesh;
}

/// On few places, so that points, segments and triangles meet each other exactly.
Mesh lattice(uint triangles, std::uint64_t seed)
{
    Random random(seed);
    Mesh mesh = with_corners_of(triangles);
    const auto place = [&] { return static_cast<float>(random.bits() % 24); };
    for (uint k = 0; k < triangles; ++k) {
        Point* const corner = &mesh.points[3 * k];
        corner[0] = {place(), place(), place()};
        const auto step = [&] { return static_cast<float>(random.bits() % 3); };
        corner[1] = {corner[0].x + step(), corner[0].y + step(), corner[0].z + step()};
        corner[2] = {corner[0].x + step(), corner[0].y + step(), corner[0].z + step()};
        if (k % 4 == 1)
            corner[2] = corner[0];  // a segment with a name twice
        if (k % 4 == 2)
            corner[1] = corner[2] = corner[0];
        if (k % 4 == 3)  // three in a line
            corner[2] = {2 * corner[1].x - corner[0].x, 2 * corner[1].y - corner[0].y,
                         2 * corner[1].z - corner[0].z};
    }
    return mesh;
}

/// Triangles of a soup whose second and third corners all but coincide.
Mesh needles(uint triangles, std::uint64_t seed, float width)
{
    Random random(seed);
    Mesh mesh = with_corners_of(triangles);
    for (uint k = 0; k < triangles; ++k) {
        Point* const corner = &mesh.points[3 * k];
        corner[0] = {random.unit(), random.unit(), random.unit()};
        const Point along = random.in_ball(), aside = random.in_ball();
        const float length = 0.3f;
        corner[1] = {corner[0].x + length * along.x, corner[0].y + length * along.y,
                     corner[0].z + length * along.z};
        corner[2] = {corner[1].x + width * aside.x, corner[1].y + width * aside.y,
                     corner[1].z + width * aside.z};
    }
    return mesh;
}

}  // namespace

std::vector<StressCase> degenerate_cases(const StressSize& size)
{
    return {{"collinear", [size] { return single(collinear(size.triangles())); }},
            {"lattice", [size] { return single(lattice(size.triangles(), size.seed)); }},
            {"collinear, two objects",
             [size] {
                 return together(collinear(size.triangles() / 2), collinear(size.triangles() / 3));
             }},
            {"one point", [size] {
                 Mesh mesh = with_corners_of(size.crowded_triangles());
                 for (Point& p : mesh.points)
                     p = {0.1f, -0.2f, 0.3f};
                 return single(std::move(mesh));
             }}};
}

std::vector<StressCase> needle_cases(const StressSize& size)
{
    const uint half = (size.quick ? size.triangles() : 4000) / 2;
    return {
        {"1e-3",
         [=] {
             return together(needles(half, size.seed, 3e-4f), needles(half, size.seed + 1, 3e-4f));
         }},
        {"1e-6", [=] {
             return together(needles(half, size.seed, 3e-7f), needles(half, size.seed + 1, 3e-7f));
         }}};
}

}  // namespace bvhbench
