// SPDX-License-Identifier: MIT
//
// Base of the builders of radix trees: the leaf order before the hierarchy, and the tree after it.
#pragma once

#include "baselines/parameters.h"
#include "baselines/radix/node.h"
#include "builders/ordered/ordered_builder.h"

namespace bvhbench {

/// A radix tree over the leaves of all objects. Each object's tree is a subtree of it.
class RadixTree final : public DeviceTree {
public:
    uint leaves = 0;
    bool sorted = false;
    const BoxFormat* format = &float_boxes();
    uint code_bits = 0;
    Buffer<std::byte> leaf_boxes;  ///< in `format`; in leaf order if sorted, else in mesh order
    Buffer<uint> ids;              ///< the triangle of each leaf
    Buffer<uint> codes;            ///< ascending
    Buffer<SceneCells> cells;      ///< one entry, for formats with cells only

    /// Inner nodes as node_words.clh stores them. If `in_arrays`, `nodes` holds only their boxes, `children` the left and right
    /// child of each, and `root` the root's index.
    Buffer<std::byte> nodes;
    Buffer<uint> children, root;
    bool in_arrays = false;

    /// True if the number of the root, and those of the objects' roots, are known on the device only: in `root` and
    /// `device_objects`.
    bool root_is_stored = false;

    /// True if the tree is that of baselines/hploc, whose leaves are not in the order of their places.
    bool is_clustered = false;

    bool numbered_by_range = false;  ///< whether inner nodes are numbered as in node.h

    std::size_t inner() const { return std::size_t{leaves} - 1; }  ///< number of inner nodes
    std::size_t inner_bytes() const;  ///< bytes of one entry of `nodes`

    uint leaf_count() const override { return leaves; }
    const BoxFormat& box_format() const override { return *format; }
    bool has_sorted_leaves() const override { return sorted; }
    bool is_implicit() const override { return false; }
    bool is_in_order() const override { return !is_clustered; }
    bool is_numbered_by_range() const override { return numbered_by_range; }
    std::size_t node_count() const override { return 2 * std::size_t{leaves} - 1; }
    uint most_levels() const override;
    std::string_view access_header() const override;
    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override;
    HostTree object_to_host_tree(uint object) const override;
};

/// Everything of a radix tree builder but the hierarchy, which derived classes add.
class RadixBuilder : public OrderedBuilder {
public:
    /// `make` creates another builder of the same kind; `group_size` applies outside CPUs if no group size is chosen. Throws
    /// BadUsage for a group size that the device does not support.
    RadixBuilder(Programs& programs, std::string_view name, std::string_view method,
                 MakeBuilder make, const BuildOptions& options,
                 const Parameter& group_size = radix_group_size);

protected:
    /// Returns a kernel compiled with the defines of leaves.clh and `more`.
    cl::Kernel kernel(std::string_view path, const char* name,
                      std::initializer_list<Define> more = {}) const;

    /// Enqueues a kernel over `count` leaves or nodes with one work-item for each, but at most `most_items_` work-items unless
    /// that is 0. own_chunk gives each work-item its share, so the kernels are the same in both cases.
    void launch(Queue& queue, const cl::Kernel& kernel, uint count, std::size_t moved_bytes) const;

    /// Takes memory for the entries of RadixTree::nodes.
    Buffer<std::byte> take_nodes(Arena& arena) const;

    /// Takes all memory besides that of the leaves, including the tree's nodes.
    virtual void plan_nodes(Arena& arena) = 0;

    /// Uploads the initial values that `build_nodes` expects and restores. Waits.
    virtual void prepare_nodes(const cl::CommandQueue& queue);

    /// Enqueue topology and boxes, or only boxes over the current topology, for at least two leaves. Do not wait.
    virtual void build_nodes(Queue& queue) = 0;
    virtual void refit_nodes(Queue& queue) = 0;

    /// Return the bytes that reading all leaf boxes, or the indices of all children, moves at least.
    std::size_t box_bytes() const;
    std::size_t child_bytes() const { return tree_.inner() * 2 * sizeof(uint); }

    std::size_t group_size_;      ///< work-items in a group of a launch
    std::size_t most_items_ = 0;  ///< most work-items of a launch; 0: no limit
    RadixTree tree_;
    Buffer<uint> arrivals_;  ///< one per inner node; zero before and after a build

    /// True if the objects' roots must be searched after a build. Otherwise they are known in advance, as inner nodes are
    /// numbered as in node.h, or `build_nodes` stores them.
    bool searches_roots_ = false;

private:
    std::unique_ptr<OrderedBuilder> twin() const final;
    void plan(Arena& arena, std::span<const uint> sizes) final;
    void prepare(const cl::CommandQueue& queue) final;
    void enqueue_hierarchy(Queue& queue) final;
    void enqueue_refit(Queue& queue) final;
    DeviceTree& tree() final { return tree_; }
    void find_roots(Queue& queue);

    MakeBuilder make_;
    cl::Kernel roots_;
};

}  // namespace bvhbench
