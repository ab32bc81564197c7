// SPDX-License-Identifier: MIT
#include "builders/host_tree.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "geometry/hash.h"

namespace bvhbench {
namespace {

using enum Violation::Of;

bool same_bits(const Aabb& a, const Aabb& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::string node_text(std::size_t index) { return "node " + std::to_string(index); }

bool is_node(const HostTree& tree, int index)
{
    return index >= 0 && static_cast<std::size_t>(index) < tree.nodes.size();
}

/// Visits every node once from the root, children in order. Returns false if a child is not a node or was visited before.
template <class Visit>
bool depth_first(const HostTree& tree, const Visit& visit)
{
    std::vector<bool> met(tree.nodes.size(), false);
    std::vector<int> stack;
    if (!tree.nodes.empty())
        stack.push_back(0);
    while (!stack.empty()) {
        const int index = stack.back();
        stack.pop_back();
        if (!is_node(tree, index) || met[static_cast<std::size_t>(index)])
            return false;
        met[static_cast<std::size_t>(index)] = true;
        const HostTree::Node& node = tree.nodes[static_cast<std::size_t>(index)];
        visit(node, static_cast<std::size_t>(index));
        for (std::size_t side = HostTree::most_children; side-- > 0;)
            if (node.child[side] != HostTree::none)
                stack.push_back(node.child[side]);
    }
    return true;
}

/// Returns what is wrong with a leaf, if anything. Marks its triangle in `seen`.
Violation leaf_violation(const HostTree& tree, const HostTree::Node& node, std::size_t index,
                         std::span<const Point> points, std::span<const Face> faces,
                         std::vector<bool>& seen)
{
    const auto triangle = static_cast<std::size_t>(node.primitive);
    if (triangle >= faces.size())
        return {leaves, node_text(index) + " holds triangle " + std::to_string(node.primitive) +
                            " of " + std::to_string(faces.size())};
    if (seen[triangle])
        return {leaves, "triangle " + std::to_string(triangle) + " is in two leaves"};
    seen[triangle] = true;
    const Aabb box = face_box(points, faces[triangle]);
    if (!tree.boxes_may_be_larger && !same_bits(node.box, tree.rounding(box)))
        return {boxes, "the box of leaf " + node_text(index) + " is not that of its triangle " +
                           std::to_string(triangle)};
    if (tree.boxes_may_be_larger ? !contains(node.box, box)
                                 : !same_bits(node.box, merged(node.box, box)))
        return {boxes, "the box of leaf " + node_text(index) + " does not contain its triangle " +
                           std::to_string(triangle)};
    return {};
}

Violation inner_violation(const HostTree& tree, const HostTree::Node& node, std::size_t index)
{
    Aabb box = empty_box();
    for (const int child : node.child)
        if (child != HostTree::none) {
            if (!is_node(tree, child))
                return {leaves, node_text(index) + " has a child that is no node"};
            box = merged(box, tree.nodes[static_cast<std::size_t>(child)].box);
        }
    if (node.child[0] == HostTree::none)
        return {leaves, "inner " + node_text(index) + " has no left child"};
    if (tree.boxes_may_be_larger) {
        if (!contains(node.box, box))
            return {boxes, "the box of " + node_text(index) + " does not contain its children's"};
    } else if (!same_bits(node.box, box)) {
        return {boxes, "the box of " + node_text(index) + " is not the union of its children's"};
    }
    return {};
}

}  // namespace

std::uint64_t tree_hash(const HostTree& tree)
{
    // Positions in memory differ between layouts, so the hash includes which children a node has, not where they are.
    Hash hash;
    depth_first(tree, [&](const HostTree::Node& node, std::size_t) {
        hash.value(node.box);
        hash.value(node.primitive);
        int which = 0;  // one bit per child
        for (std::size_t side = 0; side < HostTree::most_children; ++side)
            which |= node.child[side] != HostTree::none ? 1 << side : 0;
        hash.value(which);
    });
    return hash.get();
}

HostTree refitted(HostTree tree, std::span<const Point> points, std::span<const Face> faces)
{
    for (std::size_t k = tree.nodes.size(); k-- > 0;) {  // children come after their parent
        HostTree::Node& node = tree.nodes[k];
        if (node.primitive != HostTree::none) {
            node.box = face_box(points, faces[static_cast<std::size_t>(node.primitive)]);
            continue;
        }
        node.box = empty_box();
        for (const int child : node.child)
            if (child != HostTree::none)
                node.box = merged(node.box, tree.nodes[static_cast<std::size_t>(child)].box);
    }
    const BoxFormat& format = *tree.rounding.format;
    return rounded_to(std::move(tree), format);
}

HostTree rounded_to(HostTree tree, const BoxFormat& format)
{
    tree.rounding = BoxRounding::of_scene(format, tree.nodes.front().box);
    if (format.has_cells())
        for (HostTree::Node& node : tree.nodes)
            node.box = tree.rounding(node.box);
    return tree;
}

Violation first_violation(const HostTree& tree, std::span<const Point> points,
                          std::span<const Face> faces)
{
    Violation violation;
    std::size_t reached = 0;
    std::vector<bool> seen(faces.size(), false);
    const bool is_tree = depth_first(tree, [&](const HostTree::Node& node, std::size_t index) {
        ++reached;
        if (violation.of != nothing)
            return;
        violation = node.primitive != HostTree::none
                        ? leaf_violation(tree, node, index, points, faces, seen)
                        : inner_violation(tree, node, index);
    });
    if (violation.of != nothing)
        return violation;
    if (!is_tree)
        return {leaves, "a node is reached twice or is not there"};
    if (reached != tree.nodes.size())
        return {leaves, std::to_string(tree.nodes.size() - reached) +
                            " nodes are not reached from the root"};
    for (std::size_t triangle = 0; triangle < seen.size(); ++triangle)
        if (!seen[triangle])
            return {leaves, "triangle " + std::to_string(triangle) + " is in no leaf"};
    return {};
}

std::string invariant_violation(const HostTree& tree, std::span<const Point> points,
                                std::span<const Face> faces)
{
    return first_violation(tree, points, faces).sentence;
}

}  // namespace bvhbench
