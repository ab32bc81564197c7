// SPDX-License-Identifier: MIT
#include "scenes/generate/sheet_mesh.h"

#include <algorithm>
#include <cmath>

namespace bvhbench {
namespace {

/// Points in the order of their first use, and none that is not used.
void drop_unused(Mesh& mesh)
{
    constexpr uint none = 0xffffffffu;
    std::vector<uint> place(mesh.points.size(), none);
    std::vector<Point> used;
    for (Face& face : mesh.faces)
        for (uint* const corner : {&face.a, &face.b, &face.c}) {
            if (place[*corner] == none) {
                place[*corner] = static_cast<uint>(used.size());
                used.push_back(mesh.points[*corner]);
            }
            *corner = place[*corner];
        }
    mesh.points = std::move(used);
}

}  // namespace

Mesh make_sheet(uint triangles, double aspect, bool closed)
{
    const std::size_t quads = (std::size_t{triangles} + 1) / 2;
    const auto wanted =
        static_cast<std::size_t>(std::sqrt(static_cast<double>(quads) * aspect) + 0.5);
    const std::size_t least = closed ? 3 : 1;  // fewer round would name a point twice
    const std::size_t wide = std::max(least, std::min(wanted, quads));
    const std::size_t high = (quads + wide - 1) / wide;
    const std::size_t stride = closed ? wide : wide + 1;

    Mesh mesh;
    for (std::size_t j = 0; j <= high; ++j)
        for (std::size_t i = 0; i < stride; ++i)
            mesh.points.push_back({static_cast<float>(i) / static_cast<float>(wide),
                                   static_cast<float>(j) / static_cast<float>(high), 0});
    for (std::size_t quad = 0; quad < quads; ++quad) {
        const std::size_t row = quad / wide * stride, i = quad % wide;
        const auto a = static_cast<uint>(row + i);
        const auto b = static_cast<uint>(row + (i + 1) % stride);
        const auto up = static_cast<uint>(stride);
        mesh.faces.push_back({a, b, b + up});
        mesh.faces.push_back({a, b + up, a + up});
    }
    mesh.faces.resize(triangles);
    drop_unused(mesh);
    return mesh;
}

}  // namespace bvhbench
