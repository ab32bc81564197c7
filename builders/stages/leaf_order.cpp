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
#include "builders/stages/object_bounds.h"
#include "builders/stages/sort.h"
#include "geometry/bits.h"
#include "geometry/error.h"

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

    /// What takes the place of `bounds` and `sort` while there are several objects.
    struct Several {
        ObjectBounds bounds;
        RadixSort sort;
        uint dropped;       ///< bits of a box's code for which objects leave no room
        uint object_shift;  ///< where they begin
    };
    std::optional<Several> several;
    Programs& programs;
    KernelForm form;

    Stages(Programs& programs, const OrderEntry& entry, KernelForm form)
        : order(entry), bounds(programs, form), number(programs), programs(programs), form(form)
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

    /// The line begins with what sorts for as many objects. Codes keep their words: what does not fit is dropped.
    void prepare_for(std::size_t objects)
    {
        several.reset();
        if (objects == 1)
            return;
        if (order.medians != Medians::nowhere)
            throw BadUsage("order " + std::string(order.name) +
                           " lines up one object, not " + std::to_string(objects) +
                           "; orders without medians take any number");
        const uint most = 32 * code_words(order.code_bits);
        const uint object_bits = ceil_log2(static_cast<uint>(objects));
        const uint kept = std::min(order.code_bits, most - object_bits);
        several.emplace(Several{ObjectBounds(programs, form),
                                RadixSort(programs, kept + object_bits, SortShape{.form = form}),
                                order.code_bits - kept, kept});
    }

    RadixSort& sorting() { return several ? several->sort : *sort; }
};

LeafOrder::LeafOrder(Programs& programs, std::string_view order, KernelForm form)
    : stages_(std::make_unique<Stages>(programs, find_order(order), form))
{}

LeafOrder::~LeafOrder() = default;

void LeafOrder::plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool reads_codes)
{
    Stages& stages = *stages_;
    const std::size_t primitives = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    stages.prepare_for(sizes.size());
    if (stages.several)
        stages.several->bounds.plan(arena, sizes, boxes);
    else
        stages.bounds.plan(arena, primitives, boxes);
    if (stages.sort) {
        stages.sorting().plan(arena, primitives);
        stages.ids = stages.sorting().ids();
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

void LeafOrder::prepare(const cl::CommandQueue& queue)
{
    if (stages_->several)
        stages_->several->bounds.prepare(queue);
    else
        stages_->bounds.prepare(queue);
    if (stages_->sort)
        stages_->sorting().prepare(queue);
}

void LeafOrder::enqueue(const Input& input, Queue& queue)
{
    Stages& stages = *stages_;
    enqueue_boxes(input, queue);
    if (stages.several) {
        auto& [bounds, sort, dropped, object_shift] = *stages.several;
        stages.codes->enqueue(bounds.boxes(), bounds.bounds(), input.device_owners,
                              sort.unsorted_codes(), dropped, object_shift, queue);
        sort.enqueue(queue);
        return;
    }
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
    if (stages_->several)
        stages_->several->bounds.enqueue(input, queue);
    else
        stages_->bounds.enqueue(input, queue);
}

const Buffer<Aabb>& LeafOrder::boxes() const
{
    return stages_->several ? stages_->several->bounds.boxes() : stages_->bounds.boxes();
}
const Buffer<Bounds>& LeafOrder::bounds() const
{
    return stages_->several ? stages_->several->bounds.bounds() : stages_->bounds.bounds();
}
const Buffer<uint>& LeafOrder::codes() const
{
    return stages_->blocks ? stages_->positions : stages_->sorting().codes();
}
const Buffer<uint>& LeafOrder::ids() const { return stages_->ids; }
unsigned LeafOrder::code_bits() const
{
    if (stages_->blocks)
        return 32;
    const unsigned own = stages_->order.code_bits;
    return stages_->several ? 32 * code_words(own) : own;
}

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
