// SPDX-License-Identifier: MIT
#pragma once

#include "baselines/baselines.h"
#include "scenes/catalog.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {

inline Mesh mesh_of(const std::string& scene)
{
    Scene loaded = load_scene(scene, {});
    return {std::move(loaded.frames.front()), std::move(loaded.faces)};
}

/// Builds a tree over a mesh and returns it. Expects it to be valid.
inline HostTree tree_over(MakeBuilder make, const Mesh& mesh, const BuildOptions& options = {})
{
    const auto builder = make(bench().programs, options);
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    builder->reserve(mesh.faces.size());
    const HostTree tree = builder->build(input, bench().queue).to_host_tree();
    bench().queue.finish();
    EXPECT_EQ(invariant_violation(tree, mesh.points, mesh.faces), "") << builder->card().name;
    return tree;
}

/// Returns the number of edges on the longest path from the root to a leaf.
inline int depth_of(const HostTree& tree)
{
    std::vector<int> depth(tree.nodes.size(), 0);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)  // children come after their parent
        for (const int child : tree.nodes[i].child)
            if (child != HostTree::none)
                depth[static_cast<std::size_t>(child)] = depth[i] + 1;
    return *std::max_element(depth.begin(), depth.end());
}

/// Returns the summed surface area of all inner nodes, relative to the root's. For trees over the same leaves, SAH costs
/// [Aila2013] differ only in this term.
inline double inner_surface(const HostTree& tree)
{
    double sum = 0;
    for (const HostTree::Node& node : tree.nodes)
        if (node.primitive == HostTree::none)
            sum += half_surface(node.box);
    return sum / half_surface(tree.nodes.front().box);
}

}  // namespace bvhbench
