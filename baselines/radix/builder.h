// SPDX-License-Identifier: MIT
//
// What the builders of radix trees share: leaf order before the hierarchy, a tree after it.
#pragma once

#include "baselines/radix/node.h"
#include "builders/ordered/ordered_builder.h"

namespace bvhbench {

/// A radix tree over the leaves of all objects, of whose trees it consists.
class RadixTree final : public DeviceTree {
public:
    uint leaves = 0;
    bool sorted = false;
    const BoxFormat* format = &float_boxes();
    uint code_bits = 0;
    Buffer<std::byte> leaf_boxes;  ///< in the format; in leaf order if sorted, else in mesh order
    Buffer<uint> ids;              ///< the triangle of each leaf
    Buffer<uint> codes;            ///< ascending
    Buffer<SceneCells> cells;      ///< one, of formats with cells

    /// Inner nodes as node_words.clh stores them; or their boxes alone, and beside them `children`, left and right, and
    /// `root`, one: where the root is.
    Buffer<std::byte> nodes;
    Buffer<uint> children, root;
    bool in_arrays = false;

    std::size_t inner() const { return std::size_t{leaves} - 1; }  ///< nodes over the leaves
    std::size_t inner_bytes() const;                               ///< of one of them

    uint leaf_count() const override { return leaves; }
    const BoxFormat& box_format() const override { return *format; }
    bool has_sorted_leaves() const override { return sorted; }
    bool is_implicit() const override { return false; }
    std::size_t node_count() const override { return 2 * std::size_t{leaves} - 1; }
    uint most_levels() const override;
    std::string_view access_header() const override;
    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override;
    HostTree spelled_out_object(uint object) const override;
};

/// All but the hierarchy, which is left to who derives from it.
class RadixBuilder : public OrderedBuilder {
public:
    /// `make` makes another one like this. Throws BadUsage for a group that the device does not have.
    RadixBuilder(Programs& programs, std::string_view name, std::string_view method,
                 MakeBuilder make, const BuildOptions& options);

protected:
    cl::Kernel kernel(std::string_view path, const char* name) const;

    /// Enqueue a kernel over `count` leaves or nodes: a work-item each in groups, or a run of them a work-item where no more
    /// than `most_items_` work-items are to share the work; 0 is no such bound. The kernels are the same: own_chunk gives
    /// a work-item its one or its run.
    void launch(Queue& queue, const cl::Kernel& kernel, uint count, std::size_t moved_bytes) const;

    /// Memory for inner nodes as node_words.clh stores them.
    Buffer<std::byte> take_nodes(Arena& arena) const;

    /// Take all memory besides the leaves', the tree's nodes among it.
    virtual void plan_nodes(Arena& arena) = 0;

    /// Fill what `build_nodes` expects and leaves as it was. Waits.
    virtual void prepare_nodes(const cl::CommandQueue& queue);

    /// Enqueue topology and boxes, for two leaves at least; or boxes only, over the topology that stands. Does not wait.
    virtual void build_nodes(Queue& queue) = 0;
    virtual void refit_nodes(Queue& queue) = 0;

    /// The least that reading all leaves' boxes, or all children's indices, moves.
    std::size_t box_bytes() const;
    std::size_t child_bytes() const { return tree_.inner() * 2 * sizeof(uint); }

    std::size_t most_items_ = 0;
    RadixTree tree_;
    Buffer<uint> arrivals_;  ///< one a meeting of two children, zero before and after a build

    /// Whether inner nodes have the numbers that node.h says, which tell where each object's root is.
    bool numbers_by_range_ = true;

private:
    std::unique_ptr<OrderedBuilder> twin() const final;
    void plan(Arena& arena, std::span<const uint> sizes) final;
    void prepare(const cl::CommandQueue& queue) final;
    void enqueue_hierarchy(Queue& queue) final;
    void enqueue_refit(Queue& queue) final;
    DeviceTree& tree() final { return tree_; }
    void find_roots(Queue& queue);

    MakeBuilder make_;
    std::size_t group_size_;
    cl::Kernel roots_;
};

}  // namespace bvhbench
