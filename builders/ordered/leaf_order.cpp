// SPDX-License-Identifier: MIT
#include "builders/ordered/leaf_order.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>

#include "builders/stages/bounds.h"
#include "builders/stages/codes.h"
#include "builders/stages/medians/cells.h"
#include "builders/stages/medians/medians.h"
#include "builders/stages/number.h"
#include "builders/stages/object_bounds.h"
#include "builders/stages/sort/sort.h"
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
        cl::Kernel put_runs;
    };
    std::optional<Several> several;
    std::vector<uint> sizes;  ///< of the objects

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
                    order.code_bits - kept, kept, ObjectRuns(programs.device(), form),
                    programs.kernel("builders/stages/put_runs.cl", "put_runs")});
    }

    /// What follows the boxes, of all objects.
    void line_up_all(const Input& input, Queue& queue);
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
    stages_->line_up_all(input, queue);
}

void LeafOrder::Stages::line_up_all(const Input& input, Queue& queue)
{
    if (several)
        codes->enqueue(several->bounds.boxes(), grid_bounds(), input.device_owners,
                       several->sort.unsorted_codes(), several->dropped, several->object_shift,
                       queue);
    else if (codes)
        codes->enqueue(bounds.boxes(), bounds.bounds(), sort->unsorted_codes(), queue);
    if (sort)
        sorting().enqueue(queue);
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
    codes->enqueue(several->bounds.boxes(), grid_bounds(), runs, several->sort.unsorted_codes(),
                   several->dropped, several->object_shift, queue);
    several->sort.enqueue_aside(queue, runs.lined_up_triangles());
    set_arguments(several->put_runs, several->sort.ids_aside(), runs.runs(), ids);
    queue.launch(several->put_runs, runs.lined_up_count() * runs.group(), runs.group(),
                 2 * std::int64_t{sizeof(uint)} * runs.lined_up_triangles());
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
    stages_->several->updated.plan(arena, stages_->sizes);
    stages_->several->sort.plan_aside(arena);
}

void LeafOrder::begin_update(const cl::CommandQueue& queue, std::span<const TreeUpdate> updates)
{
    std::vector<uint> rebuilt, refitted;
    for (uint object = 0; object < updates.size(); ++object) {
        if (updates[object] == TreeUpdate::rebuild)
            rebuilt.push_back(object);
        else if (updates[object] == TreeUpdate::refit)
            refitted.push_back(object);
    }
    stages_->several->updated.choose(queue, rebuilt, refitted);
}

void LeafOrder::enqueue_update(const Input& input, Queue& queue)
{
    LeafOrder::Stages::Several& several = *stages_->several;
    several.bounds.enqueue(input, several.updated, queue);
    if (several.updated.lined_up_count() > 0)
        stages_->line_up_some(queue);
}

const ObjectRuns& LeafOrder::updated() const { return stages_->several->updated; }

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
