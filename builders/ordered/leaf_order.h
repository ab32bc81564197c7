// SPDX-License-Identifier: MIT
//
// From triangles to a line of leaves: what every builder that starts from sorted codes shares.
//
//     triangles --bounds--> boxes (mesh order), bounds --codes--> codes --sort--> ids --order--> ids
//
// Several objects are lined up at once, one after the other: the object is the highest part of a code, and the rest
// is measured against the object's own bounds.
//
// The last stage belongs to orders with medians only; with medians everywhere it starts from the boxes.
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

/// The stages bounds, codes, sort and order on a device, those of them that the order has.
class LeafOrder {
public:
    /// Throws BadUsage if no order is called `order`.
    LeafOrder(Programs& programs, std::string_view order, KernelForm form = KernelForm::of_device,
              GridOver grid = GridOver::object);

    /// Take every buffer the stages need for objects of so many triangles each. The sorted ids are tree memory;
    /// the leaf boxes are what `boxes` says; everything else is scratch. Without `reads_codes`, orders with
    /// medians leave none. Throws BadUsage for several objects and an order with medians.
    void plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool reads_codes);

    /// Write down what builds expect. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueue the stages. Allocates nothing and does not wait.
    void enqueue(const Input& input, Queue& queue);

    /// Enqueue the first stage only: new boxes, and the order that was. Does not wait.
    void enqueue_boxes(const Input& input, Queue& queue);

    /// Takes the memory that updates of some of several objects need besides.
    void plan_updates(Arena& arena);

    /// Plans the next updates: of objects that are rebuilt, leaves are lined up anew; of those that are refitted, boxes are
    /// made. Never timed. Waits.
    void begin_update(const cl::CommandQueue& queue, std::span<const TreeUpdate> updates);

    /// Enqueues the stages of such an update; other objects' boxes and ids stay. Allocates nothing and does not wait.
    void enqueue_update(const Input& input, Queue& queue);

    /// The triangles that an update of some of several objects is about.
    const ObjectRuns& updated() const { return updated_; }

    const Buffer<Aabb>& boxes() const
    {
        return bounds_.boxes();
    }  ///< one a triangle, in mesh order
    /// One an object: of its boxes and of their centres.
    const Buffer<Bounds>& bounds() const { return bounds_.bounds(); }
    /// Ascending, of the leaves in their order; over 32 bits, two words each, low word first. Medians leave
    /// codes that do not ascend, so with them the codes are the leaves' positions: their radix tree is the
    /// tree whose splits the medians are.
    const Buffer<uint>& codes() const;
    const Buffer<uint>& ids() const { return ids_; }  ///< triangle ids in leaf order

    unsigned code_bits() const;  ///< of `codes`

private:
    /// What boxes' codes are measured against.
    const Buffer<Bounds>& grid_bounds() const
    {
        return grid_ == GridOver::scene ? bounds_.bounds_of_all() : bounds_.bounds();
    }

    Programs& programs_;
    const OrderEntry& order_;
    KernelForm form_;
    GridOver grid_;
    std::vector<uint> sizes_;  ///< of the objects
    BoundsStage bounds_;
    std::optional<CodesStage> codes_;  ///< these two unless medians are everywhere
    std::optional<RadixSort> sort_;
    std::optional<CellMedians> cells_;  ///< if they are
    std::optional<BlockMedians> blocks_;
    std::optional<NumberAll> number_;
    Buffer<uint> positions_;  ///< what codes are with medians, if anyone reads them
    Buffer<uint> ids_;
    ObjectRuns updated_;
    cl::Kernel put_runs_;
};

/// The same on the host, slowly and obviously: the oracle for the kernels, equal bit for bit.
struct HostLeafOrder {
    std::vector<Aabb> boxes;   ///< one a triangle, in mesh order
    std::vector<ulong> codes;  ///< ascending; with medians, positions
    std::vector<uint> ids;     ///< triangle ids in leaf order
};
HostLeafOrder host_leaf_order(std::vector<Aabb> boxes, std::string_view order);

}  // namespace bvhbench
