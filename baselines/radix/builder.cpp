// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <numeric>

#include "baselines/radix/hierarchy.h"
#include "builders/ordered/ordered_builder.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

class RadixTree final : public DeviceTree {
public:
    RadixLeaves leaves;
    std::unique_ptr<RadixHierarchy> hierarchy;
    Buffer<SceneCells> cells;  ///< one, of formats with cells
    uint code_bits = 0;

    uint leaf_count() const override { return leaves.count; }
    const BoxFormat& box_format() const override { return *leaves.format; }
    bool has_sorted_leaves() const override { return leaves.sorted; }
    std::string_view access_header() const override { return hierarchy->access_header(); }
    bool is_implicit() const override { return false; }

    /// From the root down every node splits at a lower bit of its leaves' keys than its parent.
    uint most_levels() const override
    {
        return std::min(leaves.count, code_bits + ceil_log2(leaves.count) + 1);
    }

    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override
    {
        return set_arguments_from(kernel, hierarchy->bind(kernel, first), leaves.boxes, leaves.ids,
                                  leaves.count, device_objects);
    }

    std::size_t node_count() const override { return 2 * std::size_t{leaves.count} - 1; }

    /// Breadth-first: a radix tree may be 95 levels deep, so nothing here recurses.
    HostTree spelled_out_object(uint object) const override
    {
        HostTree tree;
        tree.rounding = {leaves.format, leaves.format->has_cells()
                                            ? cells.download(queue->cl()).front()
                                            : SceneCells{}};
        const std::vector<Aabb> boxes =
            read_boxes(leaves.boxes.download(queue->cl()), tree.rounding);
        const std::vector<uint> ids = leaves.ids.download(queue->cl());
        uint root = 0;
        const std::vector<RadixNode> inner = hierarchy->download(queue->cl(), tree.rounding, root);

        if (objects.size() > 1)
            root = device_objects.download(queue->cl()).at(object).root;
        else
            root = radix_child(root, leaves.count == 1);
        std::vector<uint> order{root};
        for (std::size_t k = 0; k < order.size(); ++k) {
            HostTree::Node& node = tree.nodes.emplace_back();
            const uint index = radix_index(order[k]);
            if (radix_is_leaf(order[k])) {
                node.primitive = static_cast<int>(ids.at(index));
                node.box = boxes.at(leaves.sorted ? index : ids[index]);
                continue;
            }
            const RadixNode& from = inner.at(index);
            node.box = {from.min_x, from.min_y, from.min_z, from.max_x, from.max_y, from.max_z};
            if (order.size() >= node_count())
                continue;  // not a tree: leave children out rather than walk in circles
            node.child = {static_cast<int>(order.size()), static_cast<int>(order.size() + 1)};
            order.push_back(from.left);
            order.push_back(from.right);
        }
        return tree;
    }
};

/// Of keys whose highest part is the object, a radix tree's parts are the objects' own trees: those over an object's
/// leaves. An inner node is its last leaf if it is a left child, else its first (node.h); and it is a left child if
/// its object's number has more leading bits in common with the next one than with the one before.
std::vector<ForestObject> radix_objects(std::span<const uint> sizes)
{
    const auto common = [&](uint object, uint other) {
        return other < sizes.size() ? static_cast<int>(clz(object ^ other)) : -1;
    };
    std::vector<ForestObject> objects;
    uint first = 0;
    for (uint k = 0; k < sizes.size(); ++k) {
        const bool is_left = common(k, k + 1) > common(k, k - 1);
        const uint root = sizes.size() == 1 ? radix_child(0, sizes[k] == 1)
                          : sizes[k] == 1   ? radix_child(first, true)
                          : is_left         ? first + sizes[k] - 1
                                            : first;
        objects.push_back({first, sizes[k], 0, root});
        first += sizes[k];
    }
    return objects;
}

class RadixBuilder final : public OrderedBuilder {
public:
    RadixBuilder(Programs& programs, const BuilderCard& card, MakeRadixHierarchy make,
                 const BuildOptions& options)
        : OrderedBuilder(programs, card, options), make_(make)
    {
        tree_.leaves.sorted = options.sorted_leaves;
        tree_.leaves.format = &format();
        tree_.hierarchy = make({programs, RadixLaunch(programs.device(), options),
                                leaf_order_.code_bits(), options.sorted_leaves, format()});
    }

private:
    std::unique_ptr<OrderedBuilder> twin() const override
    {
        return std::make_unique<RadixBuilder>(programs_, card(), make_, options_);
    }

    void plan(Arena& arena, std::span<const uint> sizes) override
    {
        RadixLeaves& leaves = tree_.leaves;
        const uint primitives = std::accumulate(sizes.begin(), sizes.end(), 0u);
        leaves.count = primitives;
        tree_.objects = radix_objects(sizes);
        tree_.device_objects = arena.take<ForestObject>(sizes.size(), Use::tree);
        leaf_order_.plan(arena, sizes, leaves.sorted ? Use::scratch : Use::tree, true);
        tree_.code_bits = leaf_order_.code_bits();
        leaves.boxes = leaves.sorted
                           ? arena.take<std::byte>(primitives * format().box_bytes(), Use::tree)
                           : leaf_order_.boxes().as<std::byte>();
        leaves.ids = leaf_order_.ids();
        leaves.codes = leaf_order_.codes();
        tree_.cells = plan_gather(arena, {leaves.boxes});
        tree_.hierarchy->plan(arena, leaves);
    }

    void prepare(const cl::CommandQueue& queue) override
    {
        tree_.device_objects.upload(queue, tree_.objects);
        const std::array defines = {Define{"SORTED_LEAVES", tree_.leaves.sorted ? 1u : 0u},
                                    Define{"BOX_FORMAT", format().number}};
        if (!tree_.hierarchy->numbers_by_range())
            roots_ = programs_.kernel(tree_.access_header(), "baselines/radix/roots.cl",
                                      "find_roots", defines);
        tree_.hierarchy->prepare(queue);
    }

    void enqueue_hierarchy(Queue& queue) override
    {
        if (tree_.leaves.count > 1)  // one leaf is its own root
            tree_.hierarchy->build(queue);
        if (tree_.objects.size() > 1 && !tree_.hierarchy->numbers_by_range())
            find_roots(queue);
    }

    void enqueue_refit(Queue& queue) override
    {
        if (tree_.leaves.count > 1)
            tree_.hierarchy->refit(queue);
    }

    DeviceTree& tree() override { return tree_; }

    void find_roots(Queue& queue)
    {
        constexpr uint group_size = 32;
        const auto count = static_cast<uint>(tree_.objects.size());
        set_arguments_from(roots_, tree_.bind(roots_, 0), tree_.device_objects, count);
        queue.launch(roots_, std::size_t{divided_up(count, group_size)} * group_size, group_size,
                     static_cast<std::int64_t>(2 * tree_.device_objects.bytes()));
    }

    MakeRadixHierarchy make_;
    cl::Kernel roots_;
    RadixTree tree_;
};

}  // namespace

std::unique_ptr<Builder> make_radix_builder(Programs& programs, const BuilderCard& card,
                                            MakeRadixHierarchy make, const BuildOptions& options)
{
    return std::make_unique<RadixBuilder>(programs, card, make, options);
}

}  // namespace bvhbench
