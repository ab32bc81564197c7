// SPDX-License-Identifier: MIT
#include "builders/ordered_builder.h"

#include <cassert>

namespace bvhbench {

OrderedBuilder::OrderedBuilder(Programs& programs, const BuilderCard& card,
                               const BuildOptions& options)
    : programs_(programs)
    , options_(options)
    , leaf_order_(programs, options.order)
    , card_(card)
    , gather_(programs)
{
    options_.order = find_order(options.order).name;  // outlives the caller's text
}

Footprint OrderedBuilder::footprint(std::size_t primitives) const
{
    const auto size = static_cast<uint>(primitives);
    return planned({&size, 1});
}

Footprint OrderedBuilder::planned(std::span<const uint> sizes) const
{
    // A twin plans, so that a builder that has memory keeps it.
    const std::unique_ptr<OrderedBuilder> planner = twin();
    Arena arena = Arena::measuring(programs_.device());
    planner->plan(arena, sizes);
    return arena.used();
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
    arena_.reset();  // the old memory goes before the new comes
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
    enqueue_hierarchy(queue);
    return tree();
}

const Tree& OrderedBuilder::refit(const Input& input, Queue& queue)
{
    assert(object_sizes(input) == sizes_);
    tree().queue = &queue;
    leaf_order_.enqueue_boxes(input, queue);
    gather_if_sorted(input, queue);
    queue.begin("refit");
    enqueue_refit(queue);
    return tree();
}

void OrderedBuilder::gather_if_sorted(const Input& input, Queue& queue)
{
    if (!options_.sorted_leaves)
        return;
    if (gathered_.slots.size() > 0)
        gather_.enqueue(leaf_order_.boxes(), leaf_order_.ids(), input.device_owners,
                        gathered_.slots, gathered_.boxes, queue);
    else
        gather_.enqueue(leaf_order_.boxes(), leaf_order_.ids(), gathered_.boxes, gathered_.first,
                        queue);
}

}  // namespace bvhbench
