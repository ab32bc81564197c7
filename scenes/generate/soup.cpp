// SPDX-License-Identifier: MIT
#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

/// The smallest k with k^3 >= count: 1/k is the side of a cube that holds one triangle on average.
uint cells_per_side(uint count)
{
    std::uint64_t side = 1;
    while (side * side * side < count)
        ++side;
    return static_cast<uint>(side);
}

}  // namespace

// A triangle's size shrinks with the cube root of their number, so each meets about as many others
// whatever N is.
Mesh make_soup(uint triangles)
{
    const float size = 0.5f / static_cast<float>(cells_per_side(triangles));
    const float room = 1.0f - 2.0f * size;  // centres keep corners inside the unit cube
    Random random(triangles);
    Mesh mesh;
    mesh.points.reserve(std::size_t{3} * triangles);
    mesh.faces.reserve(triangles);
    for (uint k = 0; k < triangles; ++k) {
        const float x = size + room * random.unit();
        const float y = size + room * random.unit();
        const float z = size + room * random.unit();
        for (int corner = 0; corner < 3; ++corner) {
            const Point offset = random.in_ball();
            mesh.points.push_back({x + size * offset.x, y + size * offset.y, z + size * offset.z});
        }
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

}  // namespace bvhbench
