// SPDX-License-Identifier: MIT
#include "builders/ordered/leaf_order.h"

#include <algorithm>
#include <numeric>

#include "builders/device_tree.h"
#include "geometry/error.h"

namespace bvhbench {

LeafOrder::LeafOrder(Programs& programs, std::string_view order, KernelForm form, GridOver grid)
    : programs_(programs)
    , order_(find_order(order))
    , form_(form)
    , grid_(grid)
    , bounds_(programs, form)
    , updated_(programs.device(), form)
{
    if (order_.medians == Medians::nowhere)
        return;
    const MedianShape shape = median_shape(programs.device(), form);
    if (order_.medians == Medians::everywhere)
        cells_.emplace(programs, shape);
    blocks_.emplace(programs, shape);
    number_.emplace(programs);
}

void LeafOrder::plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool reads_codes)
{
    sizes_.assign(sizes.begin(), sizes.end());
    if (blocks_ && sizes.size() > 1)
        throw BadUsage("order " + std::string(order_.name) + " lines up one object, not " +
                       std::to_string(sizes.size()) + "; orders without medians take any number");
    const std::size_t primitives = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    bounds_.plan(arena, sizes, boxes, grid_ == GridOver::scene);
    if (cells_) {
        ids_ = arena.take<uint>(primitives, Use::tree);
        cells_->plan(arena, primitives);
    } else {
        // Codes include the object number. They keep their number of words, so bits of a box's code that do not fit are
        // dropped.
        const uint object_bits = ceil_log2(static_cast<uint>(sizes.size()));
        codes_.emplace(programs_, order_, form_, sizes.size());
        sort_.emplace(programs_, kept_code_bits(order_.code_bits, sizes.size()) + object_bits,
                      sort_shape(programs_.device(), form_));
        sort_->plan(arena, primitives, reads_codes && !blocks_);
        if (sort_->takes_counts())
            codes_->plan_counting();
        ids_ = sort_->ids();
        plan_at_once();
    }
    positions_ = arena.take<uint>(blocks_ && reads_codes ? primitives : 0, Use::scratch);
}

void LeafOrder::prepare(const cl::CommandQueue& queue)
{
    bounds_.prepare(queue);
    if (sort_)
        sort_->prepare(queue);
}

/// Plans one launch for boxes, codes and sort, if the sort is one launch and the device's parameter says so.
void LeafOrder::plan_at_once()
{
    is_at_once_ = sizes_.size() == 1 && sort_->is_at_once() &&
                  programs_.device().tuned(sort_at_once) == sort_at_once_with_boxes;
    if (!is_at_once_)
        return;
    std::vector<Define> defines = codes_->defines();
    defines.push_back({"SWEPT", 0});
    at_once_ = sort_->beginning_with("builders/ordered/order_at_once.cl", "order_at_once", defines);
}

void LeafOrder::enqueue(const Input& input, Queue& queue)
{
    const bool in_one_launch = is_at_once_ && !input.is_swept();
    if (in_one_launch)
        enqueue_at_once(input, queue);
    else
        enqueue_stages(input, queue);
    if (!blocks_)
        return;
    if (!in_one_launch)
        queue.begin("order");
    if (cells_)
        cells_->enqueue(boxes(), bounds(), ids_, queue);
    blocks_->enqueue(boxes(), ids_, queue);
    number_->enqueue(positions_, queue);
}

void LeafOrder::enqueue_at_once(const Input& input, Queue& queue)
{
    queue.begin("order");
    const cl_uint next = set_arguments_from(at_once_, 0, input.device_points, input.device_faces,
                                            bounds_.boxes(), bounds_.bounds());
    sort_->enqueue_beginning(
        at_once_, next,
        static_cast<std::int64_t>(input.point_bytes() + input.device_faces.bytes() +
                                  boxes().bytes()),
        queue);
}

void LeafOrder::enqueue_stages(const Input& input, Queue& queue)
{
    bounds_.enqueue(input, queue);
    if (!codes_)
        return;
    const bool counts = sort_->takes_counts();
    if (counts)
        codes_->enqueue_counted(boxes(), grid_bounds(), input.device_owners,
                                sort_->unsorted_codes(), sort_->counters(), sort_->code_bits(),
                                queue);
    else
        codes_->enqueue(boxes(), grid_bounds(), input.device_owners, sort_->unsorted_codes(),
                        queue);
    sort_->enqueue(queue, counts);
}

void LeafOrder::plan_updates(Arena& arena)
{
    updated_.plan(arena, sizes_);
    sort_->plan_aside(arena);
    put_runs_ = programs_.kernel("builders/stages/ids.cl", "put_runs");
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
    updated_.choose(queue, rebuilt, refitted);
}

void LeafOrder::enqueue_update(const Input& input, Queue& queue)
{
    bounds_.enqueue(input, updated_, queue);
    if (updated_.lined_up_count() == 0)
        return;
    codes_->enqueue(boxes(), grid_bounds(), updated_, sort_->unsorted_codes_aside(), queue);
    sort_->enqueue_aside(queue, updated_.lined_up_triangles());
    set_arguments(put_runs_, sort_->ids_aside(), updated_.runs(), ids_);
    queue.launch(put_runs_, updated_.lined_up_count() * updated_.group(), updated_.group(),
                 2 * std::int64_t{sizeof(uint)} * updated_.lined_up_triangles());
}

const Buffer<uint>& LeafOrder::codes() const { return blocks_ ? positions_ : sort_->codes(); }

unsigned LeafOrder::code_bits() const
{
    if (blocks_)
        return 32;
    return sizes_.size() > 1 ? 32 * code_words(order_.code_bits) : order_.code_bits;
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
        std::ranges::stable_sort(result.ids, {}, [&](uint id) { return codes[id]; });
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
