// SPDX-License-Identifier: MIT
#include "builders/stages/leaf_order.h"

#include <algorithm>
#include <numeric>

#include "builders/stages/bounds.h"
#include "builders/stages/codes.h"
#include "builders/stages/medians.h"
#include "builders/stages/number.h"
#include "builders/stages/sort.h"

namespace bvhbench {

struct LeafOrder::Stages {
    const OrderEntry& order;
    BoundsStage bounds;
    CodesStage codes;
    RadixSort sort;
    BlockMedians medians;
    NumberAll number;

    Stages(Programs& programs, const OrderEntry& entry, KernelForm form)
        : order(entry)
        , bounds(programs, form)
        , codes(programs, entry)
        , sort(programs, entry.code_bits, {.form = form})
        , medians(programs, {.form = form})
        , number(programs)
    {}

    bool in_blocks() const { return order.medians == Medians::in_blocks; }
};

LeafOrder::LeafOrder(Programs& programs, std::string_view order, KernelForm form)
    : stages_(std::make_unique<Stages>(programs, find_order(order), form))
{}

LeafOrder::~LeafOrder() = default;

void LeafOrder::plan(Arena& arena, std::size_t primitives, Use boxes)
{
    stages_->bounds.plan(arena, primitives, boxes);
    stages_->sort.plan(arena, primitives);
    if (stages_->in_blocks())
        stages_->medians.plan(arena, primitives);
}

void LeafOrder::enqueue(const Input& input, Queue& queue)
{
    enqueue_boxes(input, queue);
    stages_->codes.enqueue(boxes(), bounds(), stages_->sort.unsorted_codes(), queue);
    stages_->sort.enqueue(queue);
    if (stages_->in_blocks()) {
        queue.begin("order");
        stages_->medians.enqueue(boxes(), ids(), queue);
        stages_->number.enqueue(codes(), queue);
    }
}

void LeafOrder::enqueue_boxes(const Input& input, Queue& queue)
{
    stages_->bounds.enqueue(input, queue);
}

const Buffer<Aabb>& LeafOrder::boxes() const { return stages_->bounds.boxes(); }
const Buffer<Bounds>& LeafOrder::bounds() const { return stages_->bounds.bounds(); }
const Buffer<uint>& LeafOrder::codes() const { return stages_->sort.codes(); }
const Buffer<uint>& LeafOrder::ids() const { return stages_->sort.ids(); }
unsigned LeafOrder::code_bits() const
{
    return stages_->order.medians == Medians::nowhere ? stages_->order.code_bits : 32;
}

HostLeafOrder host_leaf_order(std::span<const Point> points, std::span<const Face> faces,
                              std::string_view order)
{
    const OrderEntry& entry = find_order(order);
    HostLeafOrder result;
    for (const Face& face : faces)
        result.boxes.push_back(face_box(points, face));
    const Bounds bounds = host_bounds(result.boxes);

    std::vector<ulong> codes;
    for (const Aabb& box : result.boxes)
        codes.push_back(entry.code(box, bounds));
    result.ids.resize(faces.size());
    std::iota(result.ids.begin(), result.ids.end(), 0u);
    std::stable_sort(result.ids.begin(), result.ids.end(),
                     [&](uint a, uint b) { return codes[a] < codes[b]; });
    for (const uint id : result.ids)
        result.codes.push_back(codes[id]);
    if (entry.medians != Medians::nowhere) {
        host_medians(result.boxes, result.ids, median_block_height);
        std::iota(result.codes.begin(), result.codes.end(), ulong{0});
    }
    return result;
}

}  // namespace bvhbench
