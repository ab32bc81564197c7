// SPDX-License-Identifier: MIT
//
// From triangles to ordered leaves: the stages that all builders over sorted codes share.
//
//     triangles --bounds--> boxes (mesh order), bounds --codes--> codes --sort--> ids --order--> ids
//
// Several objects are sorted at once and stored one after the other: the object number forms the highest bits of a code, and
// the rest is computed in the object's own bounds (or in the scene's, see GridOver).
//
// Only orders with medians have the last stage; with medians everywhere it reads the boxes and there are no codes.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "builders/builder.h"
#include "builders/stages/bounds.h"
#include "builders/stages/codes.h"
#include "builders/stages/medians/cells.h"
#include "builders/stages/medians/medians.h"
#include "builders/stages/sort/sort.h"

namespace bvhbench {

/// The stages bounds, codes, sort and order on a device, as far as the order has them.
class LeafOrder {
public:
    /// Throws BadUsage if there is no order called `order`.
    LeafOrder(Programs& programs, std::string_view order, KernelForm form = KernelForm::of_device,
              GridOver grid = GridOver::object);

    /// Takes all buffers for objects of `sizes` triangles. Sorted ids are counted as tree memory, leaf boxes as `boxes`,
    /// everything else as scratch. Without `reads_codes`, orders with medians produce no codes. Throws BadUsage for several
    /// objects and an order with medians.
    void plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool reads_codes);

    /// Uploads the constant inputs of builds. Blocks until done.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueues all stages. Allocates nothing and does not block.
    void enqueue(const Input& input, Queue& queue);

    /// Enqueues the first stage only: new boxes, unchanged order; several objects keep their bounds unless it `joins` them, too. Does
    /// not block.
    void enqueue_boxes(const Input& input, Queue& queue, bool joins)
    {
        bounds_.enqueue(input, queue, "bounds", joins);
    }

    /// Takes the additional memory for updates of some of several objects.
    void plan_updates(Arena& arena);

    /// Plans the next updates: rebuilt objects get new boxes and a new leaf order, refitted objects new boxes only. Never
    /// timed. Blocks.
    void begin_update(const cl::CommandQueue& queue, std::span<const TreeUpdate> updates);

    /// Enqueues the stages of a planned update; other objects keep boxes and ids. Allocates nothing and does not block.
    void enqueue_update(const Input& input, Queue& queue);

    /// Returns the runs of triangles that the planned update processes.
    const ObjectRuns& updated() const { return updated_; }

    /// One per triangle, in mesh order.
    const Buffer<Aabb>& boxes() const { return bounds_.boxes(); }
    /// Bounds of the boxes and of their centres, one element per object.
    const Buffer<Bounds>& bounds() const { return bounds_.bounds(); }
    /// Ascending codes of the ordered leaves; above 32 bits, two words each, low word first. Codes do not ascend after medians,
    /// so with medians these are the leaves' positions, whose radix tree is the tree of the median splits.
    const Buffer<uint>& codes() const;
    const Buffer<uint>& ids() const { return ids_; }  ///< Triangle ids in leaf order.

    unsigned code_bits() const;  ///< Bits of `codes`.

private:
    void plan_at_once();
    void enqueue_stages(const Input& input, Queue& queue);
    void enqueue_at_once(const Input& input, Queue& queue);

    /// Returns the bounds that codes are computed in.
    const Buffer<Bounds>& grid_bounds() const
    {
        return grid_ == GridOver::scene ? bounds_.bounds_of_all() : bounds_.bounds();
    }

    Programs& programs_;
    const OrderEntry& order_;
    KernelForm form_;
    GridOver grid_;
    std::vector<uint> sizes_;  ///< Triangles of each object.
    BoundsStage bounds_;
    std::optional<CodesStage> codes_;  ///< Absent, with the sort, if medians are everywhere.
    std::optional<RadixSort> sort_;
    cl::Kernel at_once_;  ///< Boxes, codes and sort in one launch, if `is_at_once_`.
    bool is_at_once_ = false;
    std::optional<CellMedians> cells_;  ///< If medians are everywhere.
    std::optional<BlockMedians> blocks_;
    std::optional<NumberAll> number_;
    Buffer<uint> positions_;  ///< Codes of orders with medians, if they are read.
    Buffer<uint> ids_;
    ObjectRuns updated_;
    cl::Kernel put_runs_;
};

/// Leaf order computed on the host: the oracle of the kernels, equal bit for bit.
struct HostLeafOrder {
    std::vector<Aabb> boxes;   ///< One per triangle, in mesh order.
    std::vector<ulong> codes;  ///< Ascending; with medians, positions.
    std::vector<uint> ids;     ///< Triangle ids in leaf order.
};
HostLeafOrder host_leaf_order(std::vector<Aabb> boxes, std::string_view order);

}  // namespace bvhbench
