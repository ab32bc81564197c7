// SPDX-License-Identifier: MIT
//
// A closed triangulated sphere with V vertices has 2V - 4 triangles. Two vertices are the poles; the other S lie on rings, and
// stitching a ring of n vertices to one of m takes n + m triangles:
//
//        pole          n_1 triangles
//       * * *          n_1 + n_2
//      * * * * *       n_2 + n_3
//       * * * *        n_3
//        pole          sum: 2 S, for any sizes of the rings
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/generate/generators.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

struct Ring {
    uint first = 0;  ///< its first vertex
    uint count = 0;
};

/// Distributes `total` vertices among `rings` rings in proportion to their lengths, at least 3 each.
std::vector<Ring> share(std::size_t total, std::size_t rings)
{
    std::vector<double> length(rings);
    double whole = 0;
    for (std::size_t k = 0; k < rings; ++k)
        whole += length[k] = std::sin(std::numbers::pi * static_cast<double>(k + 1) /
                                      static_cast<double>(rings + 1));
    std::vector<Ring> result(rings);
    const auto spare = static_cast<double>(total - 3 * rings);
    double so_far = 0;
    std::size_t given = 0;
    uint next_vertex = 1;  // after the first pole
    for (std::size_t k = 0; k < rings; ++k) {
        so_far += length[k];
        const std::size_t until =
            k + 1 == rings ? total - 3 * rings
                           : static_cast<std::size_t>(std::llround(spare * so_far / whole));
        result[k] = {next_vertex, static_cast<uint>(3 + until - given)};
        given = until;
        next_vertex += result[k].count;
    }
    return result;
}

void place(Mesh& mesh, const std::vector<Ring>& rings)
{
    mesh.points.push_back({0, 0, 1});
    for (std::size_t k = 0; k < rings.size(); ++k) {
        const double theta =
            std::numbers::pi * static_cast<double>(k + 1) / static_cast<double>(rings.size() + 1);
        for (uint i = 0; i < rings[k].count; ++i) {
            const double phi = 2.0 * std::numbers::pi * i / rings[k].count;
            mesh.points.push_back(rounded({std::sin(theta) * std::cos(phi),
                                           std::sin(theta) * std::sin(phi), std::cos(theta)}));
        }
    }
    mesh.points.push_back({0, 0, -1});
}

/// Advances along both rings at once and always on the ring that is behind.
void stitch(Mesh& mesh, Ring upper, Ring lower)
{
    uint i = 0, j = 0;
    while (i < upper.count || j < lower.count) {
        const uint a = upper.first + i % upper.count;
        const uint b = lower.first + j % lower.count;
        const bool advance_upper =
            j == lower.count || (i < upper.count && std::uint64_t{i + 1} * lower.count <=
                                                        std::uint64_t{j + 1} * upper.count);
        if (advance_upper)
            mesh.faces.push_back({a, b, upper.first + (++i) % upper.count});
        else
            mesh.faces.push_back({a, b, lower.first + (++j) % lower.count});
    }
}

void cap(Mesh& mesh, uint pole, Ring ring, bool upper)
{
    for (uint i = 0; i < ring.count; ++i) {
        const uint a = ring.first + i;
        const uint b = ring.first + (i + 1) % ring.count;
        mesh.faces.push_back(upper ? Face{pole, a, b} : Face{pole, b, a});
    }
}

}  // namespace

Mesh make_sphere(uint triangles)
{
    const std::size_t on_rings = std::max<std::size_t>(3, (std::size_t{triangles} + 1) / 2);
    const auto wanted =
        std::llround(std::sqrt(std::numbers::pi * static_cast<double>(on_rings)) / 2);
    const std::size_t ring_count =
        std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, on_rings / 3);
    const std::vector<Ring> rings = share(on_rings, ring_count);

    Mesh mesh;
    mesh.points.reserve(on_rings + 2);
    mesh.faces.reserve(2 * on_rings);
    place(mesh, rings);
    cap(mesh, 0, rings.front(), true);
    for (std::size_t k = 0; k + 1 < rings.size(); ++k)
        stitch(mesh, rings[k], rings[k + 1]);
    cap(mesh, static_cast<uint>(mesh.points.size() - 1), rings.back(), false);
    mesh.faces.resize(triangles);  // one fewer if odd; the first few of six if below six
    return mesh;
}

}  // namespace bvhbench
