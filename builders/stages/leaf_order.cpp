// SPDX-License-Identifier: MIT
#include "builders/stages/leaf_order.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>

#include "builders/stages/bounds.h"
#include "builders/stages/cells.h"
#include "builders/stages/codes.h"
#include "builders/stages/medians.h"
#include "builders/stages/number.h"
#include "builders/stages/object_bounds.h"
#include "builders/stages/sort.h"
#include "builders/stages/standing_order.h"
#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {

struct LeafOrder::Stages {
    const OrderEntry& order;
    BoundsStage bounds;
    std::optional<CodesStage> codes;  ///< these two unless the order does without codes
    std::optional<RadixSort> sort;
    std::optional<NumberAll> number;   ///< with medians anywhere
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
        ObjectRuns updated;
    };
    std::optional<Several> several;
    std::optional<StandingOrder> standing;  ///< once there are updates, unless there are medians
    std::vector<uint> sizes;                ///< of the objects
    bool reads_codes = false;

    /// What updates do.
    bool is_whole = true;  ///< all objects are lined up
    bool tries_order = false;
    bool lines_up = true;  ///< any at all
    Programs& programs;
    KernelForm form;
    GridOver grid;

    Stages(Programs& on, const OrderEntry& entry, KernelForm chosen, GridOver over)
        : order(entry), bounds(on, chosen), programs(on), form(chosen), grid(over)
    {
        if (entry.medians == Medians::everywhere) {
            cells.emplace(programs, median_shape(programs.device(), form));
        } else {
            codes.emplace(programs, entry, form);
            sort.emplace(programs, entry.code_bits, sort_shape(programs.device(), form));
        }
        if (entry.medians != Medians::nowhere) {
            blocks.emplace(programs, median_shape(programs.device(), form));
            number.emplace(programs);
        }
    }

    /// The line begins with what sorts for as many objects. Codes keep their words: what does not fit is dropped.
    void prepare_for(std::size_t objects)
    {
        several.reset();
        if (objects == 1)
            return;
        if (order.medians != Medians::nowhere)
            throw BadUsage("order " + std::string(order.name) + " lines up one object, not " +
                           std::to_string(objects) + "; orders without medians take any number");
        const uint object_bits = ceil_log2(static_cast<uint>(objects));
        const uint kept = kept_code_bits(order.code_bits, objects);
        several.emplace(
            Several{ObjectBounds(programs, form),
                    RadixSort(programs, kept + object_bits, sort_shape(programs.device(), form)),
                    order.code_bits - kept, kept, ObjectRuns(programs.device(), form)});
    }

    /// What follows the boxes, of all objects.
    void line_up_all(const Input& input, Queue& queue, bool tries);
    /// The same of those that are updated.
    void line_up_some(Queue& queue);

    /// Of several objects: what their boxes' codes are measured against.
    const Buffer<Bounds>& grid_bounds() const
    {
        return grid == GridOver::scene ? several->bounds.bounds_of_all() : several->bounds.bounds();
    }

    RadixSort& sorting() { return several ? several->sort : *sort; }
};

LeafOrder::LeafOrder(Programs& programs, std::string_view order, KernelForm form, GridOver grid)
    : stages_(std::make_unique<Stages>(programs, find_order(order), form, grid))
{}

LeafOrder::~LeafOrder() = default;

void LeafOrder::plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool reads_codes)
{
    Stages& stages = *stages_;
    const std::size_t primitives = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    stages.prepare_for(sizes.size());
    stages.sizes.assign(sizes.begin(), sizes.end());
    stages.reads_codes = reads_codes;
    if (stages.several)
        stages.several->bounds.plan(arena, sizes, boxes, stages.grid == GridOver::scene);
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
    enqueue_boxes(input, queue);
    stages_->line_up_all(input, queue, false);
}

void LeafOrder::Stages::line_up_all(const Input& input, Queue& queue, bool tries)
{
    if (several)
        codes->enqueue(several->bounds.boxes(), grid_bounds(), input.device_owners,
                       several->sort.unsorted_codes(), several->dropped, several->object_shift,
                       queue);
    else if (codes)
        codes->enqueue(bounds.boxes(), bounds.bounds(), sort->unsorted_codes(), queue);
    if (sort) {
        RadixSort& all = sorting();
        all.enqueue(queue,
                    tries ? standing->enqueue_try(all.unsorted_codes(), queue) : SortUnlessIdle{});
        if (tries && reads_codes)
            standing->enqueue_codes(all.unsorted_codes(), all.codes(), all.other_codes(), queue);
    }
    if (!blocks)
        return;
    queue.begin("order");
    const Buffer<Aabb>& boxes = bounds.boxes();
    if (cells)
        cells->enqueue(boxes, bounds.bounds(), ids, queue);
    blocks->enqueue(boxes, ids, queue);
    number->enqueue(positions, queue);
}

void LeafOrder::Stages::line_up_some(Queue& queue)
{
    const ObjectRuns& runs = several->updated;
    const Buffer<uint>& unsorted = several->sort.unsorted_codes();
    codes->enqueue(several->bounds.boxes(), grid_bounds(), runs, unsorted, several->dropped,
                   several->object_shift, queue);
    const SortUnlessIdle unless =
        tries_order ? standing->enqueue_try(unsorted, queue) : SortUnlessIdle{};
    several->sort.enqueue_aside(queue, runs.lined_up_triangles(), unless);
    standing->enqueue_put(several->sort.ids_aside(), ids, runs, unless, queue);
}

void LeafOrder::enqueue_boxes(const Input& input, Queue& queue)
{
    if (stages_->several)
        stages_->several->bounds.enqueue(input, queue);
    else
        stages_->bounds.enqueue(input, queue);
}

void LeafOrder::plan_updates(Arena& arena)
{
    Stages& stages = *stages_;
    if (!stages.standing && stages.order.medians == Medians::nowhere)
        stages.standing.emplace(stages.programs, stages.order.code_bits, stages.form);
    if (stages.standing)
        stages.standing->plan(arena, stages.ids.size());
    if (!stages.several)
        return;
    stages.several->updated.plan(arena, stages.sizes);
    stages.several->sort.plan_aside(arena);
}

void LeafOrder::prepare_updates(const cl::CommandQueue& queue)
{
    if (stages_->standing)
        stages_->standing->prepare(queue);
}

void LeafOrder::begin_update(const cl::CommandQueue& queue, std::span<const TreeUpdate> updates,
                             bool try_order)
{
    Stages& stages = *stages_;
    std::vector<uint> rebuilt, refitted;
    for (uint object = 0; object < updates.size(); ++object) {
        if (updates[object] == TreeUpdate::rebuild)
            rebuilt.push_back(object);
        else if (updates[object] == TreeUpdate::refit)
            refitted.push_back(object);
    }
    stages.lines_up = !rebuilt.empty();
    stages.is_whole = rebuilt.size() == updates.size();
    stages.tries_order = try_order && stages.lines_up && stages.standing;
    assert(stages.is_whole || stages.several);
    if (!stages.is_whole)
        stages.several->updated.choose(queue, rebuilt, refitted);
    if (!stages.tries_order)
        return;
    if (stages.is_whole)
        stages.standing->take(queue, stages.ids, static_cast<uint>(stages.ids.size()));
    else
        stages.standing->take(queue, stages.ids, stages.several->updated);
}

void LeafOrder::enqueue_update(const Input& input, Queue& queue)
{
    Stages& stages = *stages_;
    if (stages.is_whole) {
        enqueue_boxes(input, queue);
        stages.line_up_all(input, queue, stages.tries_order);
        return;
    }
    stages.several->bounds.enqueue(input, stages.several->updated, queue);
    if (stages.lines_up)
        stages.line_up_some(queue);
}

const ObjectRuns& LeafOrder::updated() const { return stages_->several->updated; }

bool LeafOrder::sorted_anew(const cl::CommandQueue& queue) const
{
    return stages_->lines_up && !(stages_->tries_order && stages_->standing->held(queue));
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

HostLeafOrder host_leaf_order(std::vector<Aabb> boxes, std::string_view order)
{
    const OrderEntry& entry = find_order(order);
    HostLeafOrder result;
    result.boxes = std::move(boxes);
    result.ids.resize(result.boxes.size());
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
        result.codes.resize(result.boxes.size());
        std::iota(result.codes.begin(), result.codes.end(), ulong{0});
    }
    return result;
}

}  // namespace bvhbench
