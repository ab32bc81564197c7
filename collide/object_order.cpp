// SPDX-License-Identifier: MIT
#include "collide/object_order.h"

#include <algorithm>
#include <array>
#include <utility>

#include "builders/stages/sort/sort.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

std::array<double, 3> sides(const Aabb& box)
{
    return {double{box.max_x} - box.min_x, double{box.max_y} - box.min_y,
            double{box.max_z} - box.min_z};
}

/// Returns the axis along which objects are shortest, compared with the scene.
uint best_axis(const Input& input)
{
    Aabb scene = empty_box();
    std::array<double, 3> lengths{};  // of all objects together
    if (input.points.empty() || input.faces.empty())
        return 0;
    for (const FaceRange& object : input.objects) {
        Aabb box = empty_box();
        for (const Face& face : input.faces.subspan(object.first, object.count))
            box = merged(box, leaf_box(input, face));
        scene = merged(scene, box);
        for (std::size_t axis = 0; axis < 3; ++axis)
            lengths[axis] += sides(box)[axis];
    }
    uint best = 0;
    for (uint axis = 1; axis < 3; ++axis)
        if (sides(scene)[axis] * lengths[best] > sides(scene)[best] * lengths[axis])
            best = axis;
    return best;
}

}  // namespace

ObjectOrder::ObjectOrder(Programs& programs, KernelForm form, cl::Kernel begin, cl::Kernel place,
                         const Input& input, FilterTables tables)
    : axis_(best_axis(input))
    , sort_(std::make_unique<RadixSort>(programs, 32, sort_shape(programs.device(), form)))
    , begin_(std::move(begin))
    , place_(std::move(place))
    , tables_(std::move(tables))
{}

ObjectOrder::~ObjectOrder() = default;

void ObjectOrder::plan(Arena& arena, const DeviceTree& tree)
{
    objects_ = static_cast<uint>(tree.objects.size());
    sort_->plan(arena, objects_, false);
    lined_up_ = sort_->ids();
    ranks_ = arena.take<uint>(objects_, Use::scratch);
    boxes_ = arena.take<std::byte>(objects_ * tree.box_format().box_bytes(), Use::scratch);
    if (tables_.rules.empty())
        return;
    rules_ = arena.take<FilterRule>(objects_, Use::scratch);
    excluded_ = arena.take<uint>(std::max<std::size_t>(1, tables_.excluded.size()), Use::scratch);
}

void ObjectOrder::prepare(const cl::CommandQueue& queue)
{
    sort_->prepare(queue);
    if (tables_.rules.empty())
        return;
    rules_.upload(queue, tables_.rules);
    if (!tables_.excluded.empty())
        excluded_.upload(queue, tables_.excluded);
}

void ObjectOrder::enqueue(const DeviceTree& tree, Queue& queue)
{
    const std::size_t items = divided_up(objects_, 64u) * std::size_t{64};
    set_arguments_from(begin_, tree.bind(begin_, 0), objects_, axis_, sort_->unsorted_codes());
    queue.launch(begin_, items, 64, static_cast<std::int64_t>(boxes_.bytes() + ranks_.bytes()));
    sort_->enqueue_in_stage(queue);
    set_arguments_from(place_, tree.bind(place_, 0), objects_, lined_up_, ranks_, boxes_);
    queue.launch(place_, items, 64,
                 static_cast<std::int64_t>(2 * boxes_.bytes() + 2 * ranks_.bytes()));
}

}  // namespace bvhbench
