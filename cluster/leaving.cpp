// SPDX-License-Identifier: MIT
#include "cluster/leaving.h"

#include <cassert>

#include "collide/device_lists.h"
#include "collide/parameters.h"

namespace bvhbench {
namespace {

constexpr std::size_t leaving_at_first = 4096;  // triangles that leave; grows

}  // namespace

Leaving::Leaving(Programs& programs, bool with_vertices)
    : DeviceCollider(programs, {"leaving", "Triangles that meet boxes of other ranks"},
                     {.capacity = leaving_at_first}, leaf_group_size, Wants::no_tree)
    , with_vertices_(with_vertices)
{}

void Leaving::want(const WantedBoxes& wanted, Queue& queue)
{
    if (boxes_.size() < wanted.boxes.size() || ranks_.size() < wanted.ranks.size())
        take_memory(wanted_arena_, device(), [&](Arena& arena) {
            boxes_ = arena.take<Aabb>(wanted.boxes.size(), Use::scratch);
            ranks_ = arena.take<WantedBoxes::OfRank>(wanted.ranks.size(), Use::scratch);
        });
    boxes_.upload(queue.cl(), wanted.boxes);
    ranks_.upload(queue.cl(), wanted.ranks);
    rank_count_ = static_cast<uint>(wanted.ranks.size());
}

void Leaving::read_packed(std::vector<HaloTriangle>& packed, std::size_t count,
                          const Queue& queue) const
{
    assert(count <= packed_.size());
    packed.resize(count);
    if (count > 0)
        queue.cl().enqueueReadBuffer(packed_.cl(), CL_TRUE, 0, count * sizeof(HaloTriangle),
                                     packed.data());
}

void Leaving::compile(const Input&)
{
    const std::vector<Define> defines = {{"GROUP_SIZE", group_size_},
                                         {"KEEP_ADJACENT", 1u},
                                         {"WITH_VERTICES", with_vertices_ ? 1u : 0u}};
    kernel_ = programs().kernel("cluster/leaving.cl", "leaving", defines);
    pack_ = programs().kernel("cluster/leaving.cl", "pack", defines);
}

void Leaving::plan(Arena& arena)
{
    ids_ = arena.take<uint>(share_->ids.size(), Use::scratch);
    vertices_ = arena.take<uint>(with_vertices_ ? share_->vertices.size() : 1, Use::scratch);
    packed_ = arena.take<HaloTriangle>(pairs_.size(), Use::scratch);
}

void Leaving::fill(const cl::CommandQueue& queue)
{
    ids_.upload(queue, share_->ids);
    if (with_vertices_)
        vertices_.upload(queue, share_->vertices);
}

std::int64_t Leaving::reads_at_least() const
{
    return static_cast<std::int64_t>(std::size_t{triangles_} * (sizeof(Face) + sizeof(Point)));
}

void Leaving::enqueue(const Input& input, Queue& queue)
{
    const uint room = static_cast<uint>(pairs_.size());
    set_arguments(kernel_, input.device_points, input.device_faces, triangles_, boxes_, ranks_,
                  rank_count_, pairs_, room, counters_);
    launch(kernel_, triangles_, group_size_, queue);
    set_arguments(pack_, input.device_points, input.device_faces, ids_, vertices_, pairs_, room,
                  counters_, packed_);
    launch(pack_, room, group_size_, queue);
}

}  // namespace bvhbench
