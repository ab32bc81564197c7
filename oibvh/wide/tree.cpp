// SPDX-License-Identifier: MIT
#include "oibvh/wide/tree.h"

#include <cstring>
#include <span>

namespace bvhbench {
namespace {

/// Returns the stored box of a node's child, as child_box in floats.clh.
Aabb child_box(const WideFormat& format, std::span<const NodeWord> node, uint child)
{
    const uint lanes = format.children();
    std::array<float, 6 * HostTree::most_children> sides;
    std::memcpy(sides.data(), node.data(), 6 * sizeof(float) * lanes);
    const auto side = [&](uint which) { return sides[which * lanes + child]; };
    return {side(0), side(1), side(2), side(3), side(4), side(5)};
}

}  // namespace

std::size_t WideTree::node_count() const
{
    std::size_t count = leaves;
    for (const ForestObject& object : objects)
        count += wide_inner_count(object.leaves, format.child_bits);
    return count;
}

std::vector<Aabb> WideTree::stored_boxes(uint object) const
{
    const ForestObject& own = objects.at(object);
    const std::vector<NodeWord> words = nodes.download(queue->cl());
    std::vector<Aabb> boxes;
    for (std::size_t slot = 0; slot < wide_inner_count(own.leaves, format.child_bits); ++slot)
        for (uint k = 0; k < format.children(); ++k)
            boxes.push_back(
                child_box(format,
                          std::span(words).subspan((own.nodes + slot) * format.node_words(),
                                                   format.node_words()),
                          k));
    return boxes;
}

HostTree WideTree::object_to_host_tree(uint object) const
{
    const ForestObject& own = objects.at(object);
    const uint bits = format.child_bits, leaf_level = wide_leaf_level(own.leaves, bits);
    const std::vector<Aabb> stored = stored_boxes(object);
    const std::vector<uint> primitives = ids.download(queue->cl());

    HostTree tree;
    const std::size_t inner = wide_inner_count(own.leaves, bits);
    tree.nodes.resize(inner + own.leaves);
    HostTree::Node& root =
        tree.nodes.front();  // no node stores the root's box: it is the union of its children's
    root.box = empty_box();
    for (uint level = 0; level < leaf_level; ++level)
        for (uint p = 0; p < wide_real_on(own.leaves, bits, level); ++p) {
            const std::size_t slot = wide_first_slot(own.leaves, bits, level) + p;
            const std::size_t below = wide_first_slot(own.leaves, bits, level + 1);
            const uint first = p << bits, real = wide_real_on(own.leaves, bits, level + 1);
            for (uint k = 0; k < format.children() && first + k < real; ++k) {
                const std::size_t child = below + first + k;
                tree.nodes[slot].child[k] = static_cast<int>(child);
                tree.nodes[child].box = stored[slot * format.children() + k];
                if (level == 0)
                    root.box = merged(root.box, tree.nodes[child].box);
            }
        }
    for (uint place = 0; place < own.leaves; ++place) {
        HostTree::Node& leaf = tree.nodes[inner + place];
        leaf.primitive = static_cast<int>(primitives[own.first + place]);
    }
    return tree;
}

}  // namespace bvhbench
