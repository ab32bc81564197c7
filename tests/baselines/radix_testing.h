// SPDX-License-Identifier: MIT
//
// Meshes whose radix trees are hard, and the comparison of device trees over ordered leaves with their oracle.
#pragma once

#include <cmath>
#include <span>

#include "tests/baselines/testing.h"

namespace bvhbench {

/// Returns small triangles at `places` random places, or fewer if there are fewer triangles. Codes repeat if places < triangles.
inline Mesh soup(uint triangles, uint places)
{
    std::mt19937 random(triangles);
    const auto next = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
    Mesh mesh;
    std::vector<Point> at;
    for (uint k = 0; k < std::min(triangles, places); ++k)
        at.push_back({next(), next(), next()});
    for (uint k = 0; k < triangles; ++k) {
        const Point centre = at[random() % at.size()];
        for (int corner = 0; corner < 3; ++corner)
            mesh.points.push_back({centre.x + (places < triangles ? 0 : next() / 16),
                                   centre.y + static_cast<float>(corner) / 32, centre.z});
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

/// Returns point-like triangles in cells whose codes are 0 (`copies` times) and every power of two. Their radix tree is a chain
/// with one level per bit of the code, which ends in a balanced tree over the copies.
inline Mesh ladder(int bits_an_axis, uint copies)
{
    std::vector<Point> at(copies, Point{0, 0, 0});
    for (int bit = 0; bit < bits_an_axis; ++bit) {
        const float offset = std::ldexp(1.0f, bit - bits_an_axis);
        at.insert(at.end(), {{offset, 0, 0}, {0, offset, 0}, {0, 0, offset}});
    }
    at.push_back({1, 1, 1});
    Mesh mesh;
    for (const Point& point : at) {
        const auto first = static_cast<uint>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), 3, point);
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

/// Returns group sizes, orders and storage of leaves.
inline std::vector<BuildOptions> ways()
{
    std::vector<BuildOptions> all;
    for (const bool sorted : {false, true})
        for (const unsigned group_size : {2u, 64u, 0u, 256u})
            if (!takes_few_cases() || group_size == 2 || group_size == 64)
                all.push_back({.group_size = group_size, .sorted_leaves = sorted});
    if (!takes_few_cases())
        all.push_back({.order = "morton63"});
    all.push_back({.order = "morton63", .group_size = 64, .sorted_leaves = true});
    return all;
}

/// Expects the tree of each builder to be the reference's.
inline void expect_the_trees_of(MakeBuilder make_reference, std::span<const MakeBuilder> makers,
                                const Mesh& mesh, const std::vector<BuildOptions>& ways)
{
    const auto triangles = mesh.faces.size();
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    for (const BuildOptions& options : ways) {
        const HostTree expected = tree_over(make_reference, mesh, options);
        for (const MakeBuilder make : makers) {
            const auto builder = make(bench().programs, options);
            SCOPED_TRACE(std::string(builder->card().name) + ", " + std::to_string(triangles) +
                         " triangles, " + std::string(options.order) + ", groups of " +
                         std::to_string(options.group_size));
            builder->reserve(triangles);
            ASSERT_EQ(builder->footprint(triangles), builder->reserved());
            const Tree& tree = builder->build(input, bench().queue);
            ASSERT_EQ(tree.node_count(), 2 * triangles - 1);
            ASSERT_EQ(tree_hash(tree.to_host_tree()), tree_hash(expected));
            builder->build(input, bench().queue, Start::from_sorted_leaves);
            ASSERT_EQ(tree_hash(tree.to_host_tree()), tree_hash(expected)) << "the second time";
            bench().queue.finish();
        }
    }
}

}  // namespace bvhbench
