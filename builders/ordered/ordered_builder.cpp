// SPDX-License-Identifier: MIT
#include "builders/ordered/ordered_builder.h"

#include <algorithm>
#include <cassert>

namespace bvhbench {

OrderedBuilder::OrderedBuilder(Programs& programs, const BuilderCard& card,
                               const BuildOptions& options)
    : programs_(programs)
    , options_(options)
    , leaf_order_(programs, options.order, KernelForm::of_device, options.grid)
    , card_(card)
    , format_(find_box_format(options.boxes))
{
    if (format_.number != BOX_F32 && !options.sorted_leaves)
        throw BadUsage("boxes of " + std::string(format_.name) +
                       " are made where leaves are lined up, so leaves must be sorted");
    if (options.sorted_leaves)
        gather_.emplace(programs, KernelForm::of_device, 0, format_);
}

void OrderedBuilder::require_floats() const
{
    if (format_.number != BOX_F32)
        throw BadUsage(std::string(card_.name) + " keeps its boxes in its own way, not as " +
                       std::string(format_.name));
}

Buffer<SceneCells> OrderedBuilder::plan_gather(Arena& arena, const GatherPlace& place)
{
    if (!gather_)
        return {};
    gather_->plan(arena, place, leaf_order_.bounds());
    return gather_->cells();
}

Footprint OrderedBuilder::footprint(std::size_t primitives) const
{
    const auto size = static_cast<uint>(primitives);
    return planned({&size, 1});
}

Footprint OrderedBuilder::planned(std::span<const uint> sizes) const
{
    // Plans on a twin, so that the memory of this builder is kept.
    const std::unique_ptr<OrderedBuilder> planner = twin();
    Arena arena = Arena::measuring(programs_.device());
    planner->plan(arena, sizes);
    return arena.used();
}

Footprint OrderedBuilder::reserved() const
{
    Footprint all;
    for (const std::optional<Arena>* arena : {&arena_, &update_arena_})
        if (*arena) {
            all.tree_bytes += (*arena)->used().tree_bytes;
            all.scratch_bytes += (*arena)->used().scratch_bytes;
        }
    return all;
}

void OrderedBuilder::reserve(std::size_t primitives)
{
    const auto size = static_cast<uint>(primitives);
    reserve_objects({&size, 1});
}

void OrderedBuilder::reserve_objects(std::span<const uint> sizes)
{
    const Footprint wanted = planned(sizes);
    const Device& device = programs_.device();
    update_arena_.reset();
    arena_.reset();  // frees the old memory before new memory is taken
    arena_ = Arena::reserved(device, wanted);
    sizes_.assign(sizes.begin(), sizes.end());
    plan(*arena_, sizes_);
    const cl::CommandQueue queue(device.context, device.cl);
    leaf_order_.prepare(queue);
    prepare(queue);
}

const Tree& OrderedBuilder::build(const Input& input, Queue& queue, Start start)
{
    assert(object_sizes(input) == sizes_);
    tree().queue = &queue;
    if (start == Start::from_triangles) {
        leaf_order_.enqueue(input, queue);
        gather_if_sorted(input, queue);
    }
    queue.begin("hierarchy");
    if (start == Start::from_triangles && lines_up())
        enqueue_lining_up(queue);
    else
        enqueue_hierarchy(queue);
    return tree();
}

const Tree& OrderedBuilder::refit(const Input& input, Queue& queue)
{
    assert(object_sizes(input) == sizes_);
    tree().queue = &queue;
    leaf_order_.enqueue_boxes(input, queue,
                              format_.has_cells() || options_.grid == GridOver::scene);
    gather_if_sorted(input, queue);
    queue.begin("refit");
    if (lines_up())
        enqueue_lining_up(queue);
    else
        enqueue_refit(queue);
    return tree();
}

void OrderedBuilder::reserve_updates()
{
    const auto plan_all = [&](Arena& arena) {
        leaf_order_.plan_updates(arena);
        plan_updates(arena);
    };
    Arena measuring = Arena::measuring(programs_.device());
    plan_all(measuring);
    update_arena_ = Arena::reserved(programs_.device(), measuring.used());
    plan_all(*update_arena_);
}

std::vector<TreeUpdate> OrderedBuilder::plan_update(std::span<const TreeUpdate> wanted,
                                                    Queue& queue)
{
    assert(wanted.size() == sizes_.size());
    queue.finish();
    update_ = update_of_all(wanted, can_refit());
    of_some_ = can_update_some() && std::any_of(wanted.begin(), wanted.end(),
                                                [&](TreeUpdate one) { return one != update_; });
    if (!of_some_)  // one update for all objects, by build or refit, or none
        return std::vector<TreeUpdate>(wanted.size(), update_);
    if (!update_arena_)
        reserve_updates();
    std::vector<uint> moved;
    for (uint object = 0; object < wanted.size(); ++object)
        if (wanted[object] != TreeUpdate::keep)
            moved.push_back(object);
    leaf_order_.begin_update(queue.cl(), wanted);
    begin_update(queue.cl(), moved);
    return {wanted.begin(), wanted.end()};
}

const Tree& OrderedBuilder::update(const Input& input, Queue& queue)
{
    assert(object_sizes(input) == sizes_);
    if (of_some_)
        return update_some(input, queue);
    if (update_ == TreeUpdate::refit)
        return refit(input, queue);
    if (update_ == TreeUpdate::keep)
        return tree();
    return build(input, queue, Start::from_triangles);
}

const Tree& OrderedBuilder::update_some(const Input& input, Queue& queue)
{
    tree().queue = &queue;
    leaf_order_.enqueue_update(input, queue);
    if (gather_ && !lines_up())
        gather_->enqueue(leaf_order_.boxes(), leaf_order_.ids(), leaf_order_.updated(), queue);
    queue.begin(update_ == TreeUpdate::refit ? "refit" : "hierarchy");
    enqueue_update(queue);
    return tree();
}

void OrderedBuilder::gather_if_sorted(const Input& input, Queue& queue)
{
    if (gather_ && !lines_up())
        gather_->enqueue(leaf_order_.boxes(), leaf_order_.ids(), input.device_owners, queue);
}

}  // namespace bvhbench
