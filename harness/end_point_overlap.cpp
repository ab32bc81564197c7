// SPDX-License-Identifier: MIT
#include "harness/end_point_overlap.h"

#include <vector>

#include "harness/clip.h"
#include "harness/compensated_sum.h"

namespace bvhbench {
namespace {

/// Leaves from left to right have numbers; below a node are those from `first` to before `last`.
struct Leaves {
    std::vector<std::uint32_t> first, last;  ///< by node
    std::vector<std::uint32_t> number;       ///< by triangle

    Leaves(const HostTree& tree, std::size_t triangles)
        : first(tree.nodes.size()), last(tree.nodes.size()), number(triangles)
    {
        std::uint32_t met = 0;
        std::vector<int> stack = {0};
        while (!stack.empty()) {
            const int index = stack.back();
            stack.pop_back();
            if (index < 0) {  // the way back out of a node
                last[static_cast<std::size_t>(~index)] = met;
                continue;
            }
            const HostTree::Node& node = tree.nodes[static_cast<std::size_t>(index)];
            first[static_cast<std::size_t>(index)] = met;
            if (node.primitive != HostTree::none)
                number[static_cast<std::size_t>(node.primitive)] = met++;
            stack.push_back(~index);
            for (std::size_t side = 2; side-- > 0;)
                if (node.child[side] != HostTree::none)
                    stack.push_back(node.child[side]);
        }
    }

    bool is_below(std::size_t node, std::uint32_t leaf) const
    {
        return first[node] <= leaf && leaf < last[node];
    }
};

bool contains(const Aabb& outer, const Aabb& inner)
{
    return outer.min_x <= inner.min_x && inner.max_x <= outer.max_x && outer.min_y <= inner.min_y &&
           inner.max_y <= outer.max_y && outer.min_z <= inner.min_z && inner.max_z <= outer.max_z;
}

}  // namespace

std::optional<AreaSums> end_point_overlap(const HostTree& tree, std::span<const Point> points,
                                          std::span<const Face> faces)
{
    if (tree.nodes.empty())
        return std::nullopt;
    const Leaves leaves(tree, faces.size());
    CompensatedSum surface, inner, leaf;
    std::vector<int> stack;
    for (std::size_t triangle = 0; triangle < faces.size(); ++triangle) {
        const Polygon polygon = polygon_of(points, faces[triangle]);
        const double whole = area(polygon);
        if (!(whole > 0))
            continue;
        surface.add(whole);
        const Aabb box = face_box(points, faces[triangle]);
        stack.assign(1, 0);
        while (!stack.empty()) {
            const auto index = static_cast<std::size_t>(stack.back());
            stack.pop_back();
            const HostTree::Node& node = tree.nodes[index];
            if (!overlap(node.box, box))
                continue;
            if (!leaves.is_below(index, leaves.number[triangle])) {
                const double inside =
                    contains(node.box, box) ? whole : area(clipped(polygon, node.box));
                if (!(inside > 0))
                    continue;
                (node.primitive != HostTree::none ? leaf : inner).add(inside);
            }
            for (const int child : node.child)
                if (child != HostTree::none)
                    stack.push_back(child);
        }
    }
    if (!(surface.value() > 0))
        return std::nullopt;
    return AreaSums{inner.value() / surface.value(), leaf.value() / surface.value()};
}

}  // namespace bvhbench
