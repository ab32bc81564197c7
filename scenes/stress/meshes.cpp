// SPDX-License-Identifier: MIT
#include "scenes/generate/derived.h"
#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/generate/vector.h"
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

/// Returns triangles along one line, each overlapping the next two.
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

/// Returns triangles with corners on few lattice points, so that points, segments and triangles meet exactly.
Mesh lattice(uint triangles, std::uint64_t seed)
{
    Random random(seed);
    Mesh mesh = with_corners_of(triangles);
    const auto place = [&] { return static_cast<float>(random.bits() % 24); };
    for (uint k = 0; k < triangles; ++k) {
        Point* const corner = &mesh.points[3 * k];
        corner[0] = {place(), place(), place()};
        const auto step = [&] { return static_cast<float>(random.bits() % 3); };
        corner[1] = corner[0] + Point{step(), step(), step()};
        corner[2] = corner[0] + Point{step(), step(), step()};
        if (k % 4 == 1)
            corner[2] = corner[0];  // a segment: a repeated vertex index
        if (k % 4 == 2)
            corner[1] = corner[2] = corner[0];
        if (k % 4 == 3)  // three collinear corners
            corner[2] = 2 * corner[1] - corner[0];
    }
    return mesh;
}

/// Returns random triangles whose second and third corners nearly coincide.
Mesh needles(uint triangles, std::uint64_t seed, float width)
{
    Random random(seed);
    Mesh mesh = with_corners_of(triangles);
    for (uint k = 0; k < triangles; ++k) {
        Point* const corner = &mesh.points[3 * k];
        corner[0] = {random.unit(), random.unit(), random.unit()};
        const Point along = random.in_ball(), aside = random.in_ball();
        corner[1] = corner[0] + 0.3f * along;
        corner[2] = corner[1] + width * aside;
    }
    return mesh;
}

Mesh moved(Mesh mesh, Point by)
{
    for (Point& p : mesh.points)
        p = p + by;
    return mesh;
}

/// Returns a stack of sheets with `each` triangles each, `gap` apart, the first at `lowest`.
Mesh stack(uint sheets, uint each, float lowest, float gap)
{
    Mesh mesh;
    for (uint k = 0; k < sheets; ++k)
        append(mesh, moved(make_grid(each), {0, 0, lowest + static_cast<float>(k) * gap}));
    return mesh;
}

/// Returns two stacks whose sheets alternate.
StressScene interleaved(const StressSize& size, float at, float gap)
{
    const bool is_one_plane = at + gap == at;  // then all sheets overlap
    const uint sheets = size.quick || is_one_plane ? 4 : 16;
    // In quick mode half as many triangles as elsewhere, for a quarter of the pairs: almost all pairs need exact sums.
    const uint each = (size.quick ? size.triangles() / 2 : size.triangles()) / 2 / sheets;
    return together(stack(sheets, each, at, 2 * gap), stack(sheets, each, at + gap, 2 * gap));
}

/// Returns each triangle `times` times, with the copies distributed over the order.
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

// Families of triangles with no area or almost none.

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

// Families of coplanar and coincident meshes, and of meshes with one triangle that is far away.

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
