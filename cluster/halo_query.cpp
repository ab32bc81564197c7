// SPDX-License-Identifier: MIT
#include "cluster/halo_query.h"

#include "collide/device_lists.h"
#include "collide/parameters.h"

namespace bvhbench {
namespace {

constexpr std::size_t first_capacity = std::size_t{1} << 16;  // pairs; grows

}  // namespace

HaloQuery::HaloQuery(Programs& programs, bool keep_adjacent)
    : DeviceCollider(programs, {"halo", "Boxes of other ranks against tree, without a stack"},
                     {.keep_adjacent = keep_adjacent, .capacity = first_capacity}, leaf_group_size,
                     Wants::tree_with_ropes)
{}

void HaloQuery::bring(std::span<const HaloTriangle> halo, Queue& queue)
{
    const bool keeps_adjacent = options_.keep_adjacent;
    halo_boxes_.clear();
    halo_faces_.clear();
    for (const HaloTriangle& one : halo) {
        halo_boxes_.push_back(one.box);
        if (!keeps_adjacent)
            halo_faces_.push_back(one.vertices);
    }
    if (boxes_.size() < halo.size()) {
        const std::size_t room = halo.size() + halo.size() / 8;
        take_memory(halo_arena_, device(), [&](Arena& arena) {
            boxes_ = arena.take<Aabb>(room, Use::scratch);
            faces_ = arena.take<Face>(keeps_adjacent ? 1 : own_faces_.size() + room, Use::scratch);
        });
        if (!keeps_adjacent)
            faces_.upload(queue.cl(), own_faces_);
    }
    boxes_.upload(queue.cl(), halo_boxes_);
    if (!keeps_adjacent)
        queue.cl().enqueueWriteBuffer(faces_.cl(), CL_TRUE, own_faces_.size() * sizeof(Face),
                                      halo_faces_.size() * sizeof(Face), halo_faces_.data());
    halo_count_ = static_cast<uint>(halo.size());
}

void HaloQuery::compile(const Input&)
{
    halo_arena_.reset();  // other triangles: nothing uploaded before holds
    boxes_ = {};
    kernel_ = kernel("cluster/halo_pairs.cl", "halo_pairs", {{"GROUP_SIZE", group_size_}});
}

void HaloQuery::enqueue(const Input& input, Queue& queue)
{
    Input numbered = input;
    numbered.device_faces = faces_;
    bind(kernel_, numbered, boxes_, halo_count_, triangles_);
    launch(kernel_, halo_count_, group_size_, queue);
}

}  // namespace bvhbench
