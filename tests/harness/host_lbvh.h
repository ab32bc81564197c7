// SPDX-License-Identifier: MIT
//
// Trees built on the host, as references for the metrics: one leaf order, with the triangles' boxes.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "builders/tree.h"
#include "geometry/aabb.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// Returns 30-bit Morton codes on a grid over the scene's box, 1024 cells along each side whatever its length.
std::vector<std::uint32_t> per_axis_codes(const Mesh& mesh);

/// Returns the triangles sorted by code; equal codes keep their order.
inline std::vector<int> sorted_ids(std::span<const std::uint32_t> codes)
{
    std::vector<int> ids(codes.size());
    std::iota(ids.begin(), ids.end(), 0);
    std::stable_sort(ids.begin(), ids.end(), [&](int a, int b) {
        return codes[static_cast<std::size_t>(a)] < codes[static_cast<std::size_t>(b)];
    });
    return ids;
}

/// Returns a tree over `ids`, built top down. A range [first, last) is split at split(first, last, depth); `first` makes it a
/// leaf, and `last` a node with one child.
template <class Split>
HostTree tree_by(const Mesh& mesh, std::span<const int> ids, const Split& split)
{
    struct Range {
        std::size_t first, last, node, depth;
    };
    HostTree tree;
    tree.nodes.emplace_back();
    std::vector<Range> stack = {{0, ids.size(), 0, 0}};
    while (!stack.empty()) {
        const Range range = stack.back();
        stack.pop_back();
        const std::size_t middle = split(range.first, range.last, range.depth);
        if (middle == range.first) {
            tree.nodes[range.node].primitive = ids[range.first];
            continue;
        }
        const std::size_t cuts[] = {range.first, middle, range.last};
        for (std::size_t side = 0; side < 2 && cuts[side] < cuts[side + 1]; ++side) {
            tree.nodes[range.node].child[side] = static_cast<int>(tree.nodes.size());
            stack.push_back({cuts[side], cuts[side + 1], tree.nodes.size(), range.depth + 1});
            tree.nodes.emplace_back();
        }
    }
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        HostTree::Node& node = tree.nodes[i];
        node.box = empty_box();
        if (node.primitive != HostTree::none)
            node.box = face_box(mesh.points, mesh.faces[static_cast<std::size_t>(node.primitive)]);
        else
            for (const int child : node.child)
                if (child != HostTree::none)
                    node.box = merged(node.box, tree.nodes[static_cast<std::size_t>(child)].box);
    }
    return tree;
}

/// Returns a tree as deep as it has leaves: each inner node has a leaf as its left child.
inline HostTree host_chain(const Mesh& mesh)
{
    std::vector<int> ids(mesh.faces.size());
    std::iota(ids.begin(), ids.end(), 0);
    return tree_by(mesh, ids, [](std::size_t first, std::size_t last, std::size_t) {
        return last - first == 1 ? first : first + 1;
    });
}

/// Returns the linear BVH: ranges are split at the highest bit in which codes differ, or positions if the codes are equal.
inline HostTree host_lbvh(const Mesh& mesh)
{
    const std::vector<std::uint32_t> codes = per_axis_codes(mesh);
    const std::vector<int> ids = sorted_ids(codes);
    const auto key = [&](std::size_t i) {
        return std::uint64_t{codes[static_cast<std::size_t>(ids[i])]} << 32 | i;
    };
    return tree_by(mesh, ids, [&](std::size_t first, std::size_t last, std::size_t) {
        if (last - first == 1)
            return first;
        const int bit = 63 - std::countl_zero(key(first) ^ key(last - 1));
        std::size_t low = first, high = last;  // the first index with the bit set is in (low, high]
        while (high - low > 1) {
            const std::size_t middle = (low + high) / 2;
            (key(middle) >> bit & 1 ? high : low) = middle;
        }
        return high;
    });
}

/// Returns the Oi-BVH: all leaves are on one level, and each node's left subtree is full before it has a right one.
inline HostTree host_oi_tree(const Mesh& mesh)
{
    const std::vector<int> ids = sorted_ids(per_axis_codes(mesh));
    const auto leaf_level = static_cast<std::size_t>(std::bit_width(ids.size() - 1));
    return tree_by(mesh, ids, [&](std::size_t first, std::size_t last, std::size_t depth) {
        if (depth == leaf_level)
            return first;
        return std::min(last, first + (std::size_t{1} << (leaf_level - depth - 1)));
    });
}

}  // namespace bvhbench
