// SPDX-License-Identifier: MIT
#include "baselines/radix/builder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>

#include "baselines/hploc/clusters.h"
#include "builders/stages/codes.h"
#include "builders/stages/kernel_form.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

using Children = std::array<uint, 2>;

/// Returns the objects with their roots. The object number is the highest part of a key, so each object's leaves are exactly
/// those of one subtree of the radix tree. An inner node's index is its last leaf if it is a left child, else its first leaf
/// (node.h). A root is a left child if its object's number shares more leading bits with the next number than with the previous.
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

}  // namespace

std::size_t RadixTree::inner_bytes() const
{
    if (in_arrays)
        return format->box_bytes();
    constexpr std::size_t word = sizeof(uint);
    return format->number == BOX_F32
               ? sizeof(RadixNode)
               : sizeof(Children) + (format->box_bytes() + word - 1) / word * word;
}

/// Returns an upper bound: each node of a radix tree splits at a lower bit of its leaves' keys than its parent. A range of the
/// clustered tree adds as many levels as it joins clusters. Together that is at most RANGE_CLUSTERS for each level of the radix
/// tree, for the clusters that come in from the side, and those of the lowest range.
uint RadixTree::most_levels() const
{
    const uint levels = code_bits + ceil_log2(leaves) + 1;
    return std::min(leaves, is_clustered ? RANGE_CLUSTERS * (levels + 1) : levels);
}

std::string_view RadixTree::access_header() const
{
    return in_arrays      ? "baselines/radix/access_apetrei.clh"
           : is_clustered ? "baselines/hploc/access.clh"
                          : "baselines/radix/access.clh";
}

cl_uint RadixTree::bind(cl::Kernel& kernel, cl_uint first) const
{
    first = set_arguments_from(kernel, first, nodes);
    if (in_arrays)
        first = set_arguments_from(kernel, first, children);
    if (root_is_stored)
        first = set_arguments_from(kernel, first, root);
    return set_arguments_from(kernel, first, leaf_boxes, ids, leaves, device_objects);
}

/// Lists the nodes in breadth-first order, without recursion, since a radix tree may be 95 levels deep.
HostTree RadixTree::object_to_host_tree(uint object) const
{
    HostTree tree;
    tree.rounding = {format,
                     format->has_cells() ? cells.download(queue->cl()).front() : SceneCells{}};
    const auto box_in = [&](std::span<const std::byte> stored, std::size_t from) {
        return tree.rounding.read(stored.subspan(from, format->box_bytes()));
    };
    const std::vector<std::byte> of_leaves = leaf_boxes.download(queue->cl());
    const std::vector<std::byte> of_inner = nodes.download(queue->cl());
    const std::vector<uint> primitives = ids.download(queue->cl());
    const std::vector<uint> linked = children.download(queue->cl());
    const auto inner_node = [&](std::size_t k) -> RadixNode {
        const auto stored = std::span(of_inner).subspan(k * inner_bytes(), inner_bytes());
        if (in_arrays)
            return radix_node(box_in(stored, 0), linked[2 * k], linked[2 * k + 1]);
        if (format->number == BOX_F32) {
            RadixNode node;
            std::memcpy(&node, stored.data(), sizeof node);
            return node;
        }
        Children own;
        std::memcpy(own.data(), stored.data(), sizeof own);
        return radix_node(box_in(stored, sizeof own), own[0], own[1]);
    };

    uint top = radix_child(root_is_stored ? root.download(queue->cl()).at(0) : 0, leaves == 1);
    if (objects.size() > 1)
        top = device_objects.download(queue->cl()).at(object).root;
    std::vector<uint> order{top};
    for (std::size_t k = 0; k < order.size(); ++k) {
        HostTree::Node& node = tree.nodes.emplace_back();
        const uint index = radix_index(order[k]);
        if (radix_is_leaf(order[k])) {
            node.primitive = static_cast<int>(primitives.at(index));
            node.box =
                box_in(of_leaves, (sorted ? index : primitives[index]) * format->box_bytes());
            continue;
        }
        const RadixNode from = inner_node(index);
        node.box = {from.min_x, from.min_y, from.min_z, from.max_x, from.max_y, from.max_z};
        if (order.size() >= node_count())
            continue;  // not a tree; stops instead of following a cycle
        node.child = {static_cast<int>(order.size()), static_cast<int>(order.size() + 1)};
        order.push_back(from.left);
        order.push_back(from.right);
    }
    return tree;
}

RadixBuilder::RadixBuilder(Programs& programs, std::string_view name, std::string_view method,
                           MakeBuilder make, const BuildOptions& options,
                           const Parameter& group_size)
    : OrderedBuilder(programs, {name, method, BuilderCard::Runs::on_device}, options)
    , group_size_(options.group_size)
    , make_(make)
{
    tree_.sorted = options.sorted_leaves;
    tree_.format = &format();
    const Device& device = programs.device();
    const auto most = device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    if (group_size_ == 0 && device.is_cpu()) {
        group_size_ = 1;
        most_items_ = chunk_count(device);
    } else if (group_size_ == 0) {
        group_size_ = std::min<std::size_t>(device.tuned(group_size), std::bit_floor(most));
    } else if (!std::has_single_bit(group_size_) || group_size_ > most) {
        throw BadUsage("a group size is a power of two up to " + std::to_string(most) + " on " +
                       device.name() + ", not " + std::to_string(group_size_));
    }
}

cl::Kernel RadixBuilder::kernel(std::string_view path, const char* name,
                                std::initializer_list<Define> more) const
{
    std::vector<Define> defines = {{"CODE_WORDS", code_words(leaf_order_.code_bits())},
                                   {"SORTED_LEAVES", tree_.sorted ? 1u : 0u},
                                   {"BOX_FORMAT", format().number}};
    defines.insert(defines.end(), more);
    return programs_.kernel(path, name, defines);
}

void RadixBuilder::launch(Queue& queue, const cl::Kernel& kernel, uint count,
                          std::size_t moved_bytes) const
{
    const std::size_t items = most_items_ != 0 ? std::min<std::size_t>(count, most_items_) : count;
    const std::size_t groups = (items + group_size_ - 1) / group_size_;
    queue.launch(kernel, groups * group_size_, group_size_, static_cast<std::int64_t>(moved_bytes));
}

Buffer<std::byte> RadixBuilder::take_nodes(Arena& arena) const
{
    return arena.take<std::byte>(tree_.inner() * tree_.inner_bytes(), Use::tree);
}

void RadixBuilder::prepare_nodes(const cl::CommandQueue& queue)
{
    arrivals_.upload(queue, std::vector<uint>(arrivals_.size(), 0u));
}

std::size_t RadixBuilder::box_bytes() const
{
    return tree_.leaf_boxes.bytes() + (tree_.sorted ? 0 : tree_.ids.bytes());
}

std::unique_ptr<OrderedBuilder> RadixBuilder::twin() const
{
    return std::unique_ptr<OrderedBuilder>(
        static_cast<OrderedBuilder*>(make_(programs_, options_).release()));
}

void RadixBuilder::plan(Arena& arena, std::span<const uint> sizes)
{
    tree_.leaves = std::accumulate(sizes.begin(), sizes.end(), 0u);
    tree_.objects = radix_objects(sizes);
    tree_.numbered_by_range = !searches_roots_ && !tree_.is_clustered;
    tree_.device_objects = arena.take<ForestObject>(sizes.size(), Use::tree);
    leaf_order_.plan(arena, sizes, tree_.sorted ? Use::scratch : Use::tree, true);
    tree_.code_bits = leaf_order_.code_bits();
    tree_.leaf_boxes = tree_.sorted
                           ? arena.take<std::byte>(tree_.leaves * format().box_bytes(), Use::tree)
                           : leaf_order_.boxes().as<std::byte>();
    tree_.ids = leaf_order_.ids();
    tree_.codes = leaf_order_.codes();
    tree_.cells = plan_gather(arena, {tree_.leaf_boxes});
    plan_nodes(arena);
}

void RadixBuilder::prepare(const cl::CommandQueue& queue)
{
    tree_.device_objects.upload(queue, tree_.objects);
    const std::array defines = {Define{"SORTED_LEAVES", tree_.sorted ? 1u : 0u},
                                Define{"BOX_FORMAT", format().number}};
    if (searches_roots_)
        roots_ = programs_.kernel(tree_.access_header(), "baselines/radix/roots.cl", "find_roots",
                                  defines);
    prepare_nodes(queue);
}

void RadixBuilder::enqueue_hierarchy(Queue& queue)
{
    if (tree_.leaves > 1)  // a single leaf is the root
        build_nodes(queue);
    if (tree_.objects.size() > 1 && searches_roots_)
        find_roots(queue);
}

void RadixBuilder::enqueue_refit(Queue& queue)
{
    if (tree_.leaves > 1)
        refit_nodes(queue);
}

void RadixBuilder::find_roots(Queue& queue)
{
    constexpr uint group_size = 32;
    const auto count = static_cast<uint>(tree_.objects.size());
    set_arguments_from(roots_, tree_.bind(roots_, 0), tree_.device_objects, count);
    queue.launch(roots_, std::size_t{divided_up(count, group_size)} * group_size, group_size,
                 static_cast<std::int64_t>(2 * tree_.device_objects.bytes()));
}

}  // namespace bvhbench
