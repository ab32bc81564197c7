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
    // A twin plans, so that a builder that has memory keeps it.
    const std::unique_ptr<OrderedBuilder> planner = twin();
    Arena arena = Arena::measuring(programs_.device());
    planner->plan(arena, static_cast<uint>(primitives));
    return arena.used();
}

void OrderedBuilder::reserve(std::size_t primitives)
{
    const Footprint wanted = footprint(primitives);
    const Device& device = programs_.device();
    arena_.reset();  // the old memory goes before the new comes
    arena_ = Arena::reserved(device, wanted);
    primitives_ = static_cast<uint>(primitives);
    plan(*arena_, primitives_);
    prepare(cl::CommandQueue(device.context, device.cl));
}

const Tree& OrderedBuilder::build(const Input& input, Queue& queue, Start start)
{
    assert(input.triangle_count() == primitives_);
    tree().queue = &queue;
    if (start == Start::from_triangles) {
        leaf_order_.enqueue(input, queue);
        gather_if_sorted(queue);
    }
    queue.begin("hierarchy");
    enqueue_hierarchy(queue);
    return tree();
}

const Tree& OrderedBuilder::refit(const Input& input, Queue& queue)
{
    assert(input.triangle_count() == primitives_);
    tree().queue = &queue;
    leaf_order_.enqueue_boxes(input, queue);
    gather_if_sorted(queue);
    queue.begin("refit");
    enqueue_refit(queue);
    return tree();
}

void OrderedBuilder::gather_if_sorted(Queue& queue)
{
    if (options_.sorted_leaves)
        gather_.enqueue(leaf_order_.boxes(), leaf_order_.ids(), gathered_.boxes, gathered_.first,
                        queue);
}

}  // namespace bvhbench
