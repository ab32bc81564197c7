// SPDX-License-Identifier: MIT
//
// The point clouds of ArborX's benchmark drivers, with boxes of side 2 around the points: in a cube of 8 units of volume for each
// point, or on its surface. A box is that of one triangle, which has three of its corners.
#include <cmath>
#include <numeric>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

Point in_cube(Random& random, float half)
{
    const float x = half * random.symmetric(), y = half * random.symmetric();
    return {x, y, half * random.symmetric()};
}

Point on_cube(Random& random, float half)
{
    Point at = in_cube(random, half);
    const auto face = static_cast<uint>(random.unit() * 6.0f);
    float& side = face / 2 == 0 ? at.x : face / 2 == 1 ? at.y : at.z;
    side = face % 2 == 0 ? half : -half;
    return at;
}

template <Point (*place)(Random& random, float half)>
MeshRun boxes_run(uint triangles, FaceRange run)
{
    const auto half = static_cast<float>(std::cbrt(static_cast<double>(triangles)));
    MeshRun made;
    made.mesh_points = std::uint64_t{3} * triangles;
    made.points.reserve(std::size_t{3} * run.count);
    made.faces.reserve(run.count);
    for (uint k = run.first; k < run.first + run.count; ++k) {
        Random random(k);  // a box does not depend on those before it
        const Point at = place(random, half);
        made.points.push_back({at.x - 1, at.y - 1, at.z - 1});
        made.points.push_back({at.x + 1, at.y + 1, at.z - 1});
        made.points.push_back({at.x + 1, at.y - 1, at.z + 1});
        made.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    made.vertices.resize(made.points.size());
    std::iota(made.vertices.begin(), made.vertices.end(), 3 * run.first);
    return made;
}

}  // namespace

MeshRun filled_cube_run(uint triangles, FaceRange run)
{
    return boxes_run<in_cube>(triangles, run);
}

MeshRun hollow_cube_run(uint triangles, FaceRange run)
{
    return boxes_run<on_cube>(triangles, run);
}

}  // namespace bvhbench
