// SPDX-License-Identifier: MIT
#include <cmath>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/stress/stress_scene.h"

namespace bvhbench {
namespace {

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

void append(StressScene& scene, const Mesh& part)
{
    const auto base = static_cast<uint>(scene.mesh.points.size());
    scene.objects.push_back(
        {static_cast<uint>(scene.mesh.faces.size()), static_cast<uint>(part.faces.size())});
    scene.mesh.points.insert(scene.mesh.points.end(), part.points.begin(), part.points.end());
    for (const Face& face : part.faces)
        scene.mesh.faces.push_back({face.a + base, face.b + base, face.c + base});
}

}  // namespace

std::span<const StressFamily> stress_families() { return families; }

StressScene single(Mesh mesh)
{
    const auto faces = static_cast<uint>(mesh.faces.size());
    return {std::move(mesh), {{0, faces}}};
}

StressScene together(const Mesh& first, const Mesh& second)
{
    StressScene scene;
    append(scene, first);
    append(scene, second);
    return scene;
}

StressScene crossed_spheres(uint triangles, std::uint64_t seed)
{
    const Mesh first = make_sphere(triangles / 2);
    Mesh second = make_sphere(triangles - triangles / 2);
    Random random(seed);
    const Point by = random.in_ball();
    for (Point& p : second.points)
        p = {p.x + 0.5f * by.x, p.y + 0.5f * by.y, p.z + 0.5f * by.z};
    return together(first, second);
}

}  // namespace bvhbench
