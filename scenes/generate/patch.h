// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "geometry/mesh.h"

namespace bvhbench {

/// A sheet of w x h quads cut in two triangles each, stopped at exactly `triangles`:
///
///     C---D    triangles A B D and A D C, quads row by row
///     | / |
///     A---B    vertex (i, j) of 0..w x 0..h is at position(i / w, j / h)
template <class Position>
Mesh make_patch(uint triangles, Position position)
{
    const std::size_t quads = (std::size_t{triangles} + 1) / 2;
    const auto width = static_cast<std::size_t>(std::sqrt(static_cast<double>(quads))) + 1;
    const std::size_t height = (quads + width - 1) / width;

    Mesh mesh;
    mesh.points.reserve((width + 1) * (height + 1));
    for (std::size_t j = 0; j <= height; ++j)
        for (std::size_t i = 0; i <= width; ++i)
            mesh.points.push_back(position(i, width, j, height));

    mesh.faces.reserve(triangles + std::size_t{1});
    for (std::size_t quad = 0; quad < quads; ++quad) {
        const auto a = static_cast<uint>((quad / width) * (width + 1) + quad % width);
        const uint b = a + 1;
        const uint c = a + static_cast<uint>(width) + 1;
        const uint d = c + 1;
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({a, d, c});
    }
    mesh.faces.resize(triangles);
    return mesh;
}

}  // namespace bvhbench
