// SPDX-License-Identifier: MIT
//
// Shared by the tests of the cluster's library: how ranks get their parts of a mesh, and what they must find.
#pragma once

#include <mpi.h>

#include <functional>
#include <numeric>

#include "device/device.h"  // first: it sets what OpenCL declares
#include "library_cluster/include/bvhbench/oibvh_cluster.h"
#include "tests/cluster/rank_tests.h"
#include "tests/library/testing.h"

namespace bvhbench {

/// Triangles of a rank, which own their arrays.
struct OwnTriangles {
    std::vector<oibvh::Point> points;
    std::vector<oibvh::Face> faces;
    std::vector<std::uint32_t> triangles, vertices;

    oibvh::RankTriangles view() const { return {points, faces, triangles, vertices}; }

    /// Takes the points from where they are in another frame of the mesh.
    void move_to(const LibraryMesh& mesh)
    {
        for (std::size_t k = 0; k < points.size(); ++k)
            points[k] = mesh.points[vertices[k]];
    }
};

/// Returns the triangles k of the mesh for which `is_own` is true, the last first, with the points that they use.
inline OwnTriangles own_part(const LibraryMesh& mesh,
                             const std::function<bool(std::uint32_t)>& is_own)
{
    OwnTriangles own;
    std::vector<std::uint32_t> place(mesh.points.size(), 0xffffffffu);
    const auto placed = [&](std::uint32_t vertex) {
        if (place[vertex] == 0xffffffffu) {
            place[vertex] = static_cast<std::uint32_t>(own.points.size());
            own.points.push_back(mesh.points[vertex]);
            own.vertices.push_back(vertex);
        }
        return place[vertex];
    };
    for (auto k = static_cast<std::uint32_t>(mesh.faces.size()); k-- > 0;)
        if (is_own(k)) {
            const oibvh::Face face = mesh.faces[k];
            own.faces.push_back({placed(face.a), placed(face.b), placed(face.c)});
            own.triangles.push_back(k);
        }
    return own;
}

/// Returns every n-th triangle of n ranks.
inline OwnTriangles scattered_part(const LibraryMesh& mesh)
{
    return own_part(mesh, [](std::uint32_t k) { return k % ranks->count() == ranks->rank(); });
}

/// Returns what one device finds in the mesh, sorted: pairs, or those within a distance.
inline std::vector<oibvh::Pair> pairs_of_one(const Caller& caller, const LibraryMesh& mesh,
                                             bool adjacent_pairs, std::optional<double> within = {})
{
    oibvh::Tree tree(caller.queue, {.adjacent_pairs = adjacent_pairs});
    tree.build(mesh.on_host());
    within ? tree.find_within(*within) : tree.find_pairs();
    std::vector<oibvh::Pair> pairs = tree.read_pairs();
    std::ranges::sort(pairs);
    return pairs;
}

/// Returns the sum of a number over all ranks.
inline std::uint64_t sum_of_ranks(std::uint64_t own)
{
    std::uint64_t sum[] = {own};
    ranks->sum(sum);
    return sum[0];
}

}  // namespace bvhbench
