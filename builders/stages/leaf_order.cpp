// SPDX-License-Identifier: MIT
#include "builders/stages/leaf_order.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "builders/stages/bounds.h"
#include "builders/stages/cells.h"
#include "builders/stages/codes.h"
#include "builders/stages/medians.h"
#include "builders/stages/number.h"
#include "builders/stages/sort.h"

namespace bvhbench {

struct LeafOrder::Stages {
    const OrderEntry& order;
    BoundsStage bounds;
    NumberAll number;
    std::optional<CodesStage> codes;  ///< these two unless the order does without codes
    std::optional<RadixSort> sort;
    std::optional<CellMedians> cells;  ///< with medians everywhere
    std::optional<BlockMedians> blocks;
    Buffer<uint> positions;  ///< what codes are with medians, if anyone reads them
    Buffer<uint> ids;

    Stages(Programs& programs, const OrderEntry& entry, KernelForm form)
        : order(entry), bounds(programs, form), number(programs)
    {
        if (entry.medians == Medians::everywhere) {
            cells.emplace(programs, MedianShape{.form = form});
        } else {
            codes.emplace(programs, entry);
            sort.emplace(programs, entry.code_bits, SortShape{.form = form});
        }
        if (entry.medians != Medians::nowhere)
            blocks.emplace(programs, MedianShape{.form = form});
    }
};

LeafOrder::LeafOrder(Programs& programs, std::string_view order, KernelForm form)
    : stages_(std::make_unique<Stages>(programs, find_order(order), form))
{}

LeafOrder::~LeafOrder() = default;

void LeafOrder::plan(Arena& arena, std::size_t primitives, Use boxes, bool reads_codes)
{
    Stages& stages = *stages_;
    stages.bounds.plan(arena, primitives, boxes);
    if (stages.sort) {
        stages.sort->plan(arena, primitives);
        stages.ids = stages.sort->ids();
    } else {
        stages.ids = arena.take<uint>(primitives, Use::tree);
    }
    if (stages.cells)
        stages.cells->plan(arena, primitives);
    if (stages.blocks)
        stages.blocks->plan(arena, primitives);
    stages.positions =
        arena.take<uint>(stages.blocks && reads_codes ? primitives : 0, Use::scratch);
}

void LeafOrder::enqueue(const Input& input, Queue& queue)
{
    Stages& stages = *stages_;
    enqueue_boxes(input, queue);
    if (stages.codes) {
        stages.codes->enqueue(boxes(), bounds(), stages.sort->unsorted_codes(), queue);
        stages.sort->enqueue(queue);
    }
    if (!stages.blocks)
        return;
    queue.begin("order");
    if (stages.cells)
        stages.cells->enqueue(boxes(), bounds(), ids(), queue);
    stages.blocks->enqueue(boxes(), ids(), queue);
    stages.number.enqueue(stages.positions, queue);
}

void LeafOrder::enqueue_boxes(const Input& input, Queue& queue)
{
    stages_->bounds.enqueue(input, queue);
}

const Buffer<Aabb>& LeafOrder::boxes() const { return stages_->bounds.boxes(); }
const Buffer<Bounds>& LeafOrder::bounds() const { return stages_->bounds.bounds(); }
const Buffer<uint>& LeafOrder::codes() const
{
    return stages_->blocks ? stages_->positions : stages_->sort->codes();
}
const Buffer<uint>& LeafOrder::ids() const { return stages_->ids; }
unsigned LeafOrder::code_bits() const { return stages_->blocks ? 32 : stages_->order.code_bits; }

HostLeafOrder host_leaf_order(std::span<const Point> points, std::span<const Face> faces,
                              std::string_view order)
{
    const OrderEntry& entry = find_order(order);
    HostLeafOrder result;
    for (const Face& face : faces)
        result.boxes.push_back(face_box(points, face));
    result.ids.resize(faces.size());
    std::iota(result.ids.begin(), result.ids.end(), 0u);
    if (entry.medians == Medians::everywhere) {
        host_cell_medians(result.boxes, result.ids, median_block_height);
    } else {
        const Bounds bounds = host_bounds(result.boxes);
        std::vector<ulong> codes;
        for (const Aabb& box : result.boxes)
            codes.push_back(entry.code(box, bounds));
        std::stable_sort(result.ids.begin(), result.ids.end(),
                         [&](uint a, uint b) { return codes[a] < codes[b]; });
        for (const uint id : result.ids)
            result.codes.push_back(codes[id]);
    }
    if (entry.medians != Medians::nowhere) {
        host_block_medians(result.boxes, result.ids, median_block_height);
        result.codes.resize(faces.size());
        std::iota(result.codes.begin(), result.codes.end(), ulong{0});
    }
    return result;
}

}  // namespace bvhbench
