// SPDX-License-Identifier: MIT
#include "baselines/radix/uploaded.h"

#include <algorithm>
#include <array>

#include "baselines/radix/builder.h"
#include "collide/device_lists.h"

namespace bvhbench {
namespace {

/// Gives RadixTree::most_levels() of a tree over 64-bit codes.
constexpr uint code_bits = 64;

/// A host tree's nodes as a radix tree has them.
class Lined {
public:
    /// Throws Unavailable for what is no binary tree of `triangles` leaves, each another triangle.
    Lined(const HostTree& tree, uint triangles)
        : tree_(tree), places_(tree.nodes.size()), is_taken_(triangles)
    {
        std::vector<std::size_t> waiting{below_support(0)};
        while (!waiting.empty()) {
            const std::size_t node = waiting.back();
            waiting.pop_back();
            Place& own = places_[node];
            own.first = own.last = static_cast<uint>(ids.size());
            levels = std::max(levels, own.level);
            if (is_leaf(node)) {
                take(node);
                continue;
            }
            if (inner.size() + 1 >= triangles)
                throw Unavailable(malformed + "it has more inner nodes than its leaves allow");
            inner.push_back(node);
            const auto [left, right] = children_of(node);
            places_[left] = {.level = own.level + 1, .is_left = true};
            places_[right] = {.level = own.level + 1};
            waiting.push_back(right);
            waiting.push_back(left);
        }
        if (ids.size() != triangles)
            throw Unavailable(malformed + "it has " + std::to_string(ids.size()) + " of " +
                              std::to_string(triangles) + " triangles");
        for (std::size_t k = inner.size(); k-- > 0;)
            places_[inner[k]].last = places_[children_of(inner[k])[1]].last;
    }

    /// Returns both children of an inner node.
    std::array<std::size_t, 2> children_of(std::size_t node) const
    {
        const HostTree::Children& child = tree_.nodes[node].child;
        if (child[2] != HostTree::none)
            throw Unavailable(
                "it has a node of more than two children, and colliders on a device "
                "query binary trees of the host");
        return {below_support(child[0]), below_support(child[1])};
    }

    /// Returns the reference to a node (node.h).
    uint reference_to(std::size_t node) const
    {
        const Place& own = places_[node];
        return radix_child(own.is_left ? own.last : own.first, is_leaf(node));
    }

    std::vector<uint> ids;           ///< triangles of the leaves in depth-first order
    std::vector<std::size_t> inner;  ///< inner nodes, parents first
    uint levels = 0;

private:
    struct Place {
        uint first = 0, last = 0;  ///< leaves
        uint level = 1;
        bool is_left = false;
    };

    bool is_leaf(std::size_t node) const { return tree_.nodes[node].primitive != HostTree::none; }

    void take(std::size_t leaf)
    {
        const auto triangle = static_cast<std::size_t>(tree_.nodes[leaf].primitive);
        if (triangle >= is_taken_.size() || is_taken_[triangle])
            throw Unavailable(malformed + "triangle " + std::to_string(triangle) +
                              " is in two leaves, or is none");
        is_taken_[triangle] = true;
        ids.push_back(static_cast<uint>(triangle));
    }

    /// Returns the node itself, or the first below it that has two children or none. Support nodes have one child.
    std::size_t below_support(int child) const
    {
        auto node = static_cast<std::size_t>(child);
        while (!is_leaf(node) && tree_.nodes[node].child[1] == HostTree::none)
            node = static_cast<std::size_t>(tree_.nodes[node].child[0]);
        return node;
    }

    inline static const std::string malformed = "it is malformed: ";

    const HostTree& tree_;
    std::vector<Place> places_;
    std::vector<bool> is_taken_;
};

}  // namespace

UploadedTree::UploadedTree(const Device& device)
    : device_(device), tree_(std::make_unique<RadixTree>())
{}

UploadedTree::~UploadedTree() = default;

const DeviceTree& UploadedTree::copy(const Tree& tree, const Input& input, const Queue& queue)
{
    if (tree_->leaves != input.triangle_count()) {
        tree_->leaves = input.triangle_count();
        tree_->sorted = tree_->numbered_by_range = true;
        tree_->code_bits = code_bits;
        tree_->objects = {{0, tree_->leaves, 0, radix_child(0, tree_->leaves == 1)}};
        take_memory(arena_, device_, [&](Arena& arena) {
            tree_->nodes = arena.take<std::byte>(tree_->inner() * tree_->inner_bytes(), Use::tree);
            tree_->leaf_boxes = arena.take<std::byte>(tree_->leaves * sizeof(Aabb), Use::tree);
            tree_->ids = arena.take<uint>(tree_->leaves, Use::tree);
            tree_->device_objects = arena.take<ForestObject>(1, Use::tree);
        });
    }
    tree_->queue = &queue;
    try {
        write(tree.to_host_tree(), input, queue.cl());
    } catch (const Unavailable& why) {
        throw Unavailable(std::string("the tree was not copied to the device: ") + why.what());
    }
    return *tree_;
}

void UploadedTree::write(const HostTree& from, const Input& input, const cl::CommandQueue& queue)
{
    const Lined lined(from, tree_->leaves);
    if (lined.levels > tree_->most_levels())
        throw Unavailable("it has " + std::to_string(lined.levels) +
                          " levels, and colliders on a device query at most " +
                          std::to_string(tree_->most_levels()));
    std::vector<RadixNode> nodes(tree_->inner());
    for (const std::size_t node : lined.inner) {
        const auto [left, right] = lined.children_of(node);
        nodes[lined.reference_to(node)] =
            radix_node(from.nodes[node].box, lined.reference_to(left), lined.reference_to(right));
    }
    std::vector<Aabb> boxes;
    for (const uint triangle : lined.ids)
        boxes.push_back(leaf_box(input, input.faces[triangle]));
    tree_->nodes.as<RadixNode>().upload(queue, nodes);
    tree_->leaf_boxes.as<Aabb>().upload(queue, boxes);
    tree_->ids.upload(queue, lined.ids);
    tree_->device_objects.upload(queue, tree_->objects);
}

}  // namespace bvhbench
