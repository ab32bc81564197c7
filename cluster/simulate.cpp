// SPDX-License-Identifier: MIT
#include "cluster/simulate.h"

#include <algorithm>
#include <cmath>

#include "cluster/halo.h"
#include "cluster/halo_query.h"
#include "cluster/lone_rank.h"
#include "cluster/top_boxes.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr double waits_a_frame = 5, ns_a_wait = 20'000, bytes_a_ns = 5;  // of the model

/// Returns the boxes that a rank with this share tells the others.
std::vector<Aabb> tops_of(const Share& share, uint boxes, Programs& programs, Queue& queue,
                          Builder& builder)
{
    std::vector<Aabb> tops(boxes, empty_box());
    if (share.triangle_count() < 2) {
        if (share.triangle_count() == 1)
            tops[0] = face_box(share.points, share.faces[0]);
        return tops;
    }
    const Input input = upload(programs.device(), queue, share.points, share.faces);
    builder.reserve(share.triangle_count());
    const auto* tree = dynamic_cast<const DeviceTree*>(&builder.build(input, queue));
    if (tree == nullptr)
        throw BadUsage("builder " + std::string(builder.card().name) +
                       " leaves its tree in host memory, which ranks do not");
    TopBoxes reader(programs, boxes);
    reader.reserve(*tree);
    tops = reader.read(*tree, queue);
    queue.finish();
    return tops;
}

}  // namespace

std::vector<Share> shares_of(const Share& whole, PartitionBy by, uint parts)
{
    LoneRank lone;
    const std::vector<Point> centres = box_centres(whole);
    const std::vector<uint> to = partitioned({centres, whole.ids}, by, parts, lone);
    std::vector<std::vector<CarriedTriangle>> carried(parts);
    for (std::size_t k = 0; k < to.size(); ++k)
        carried[to[k]].push_back(carried_triangle(whole, k));
    std::vector<Share> shares;
    for (std::vector<CarriedTriangle>& of_part : carried)
        shares.push_back(share_of({std::exchange(of_part, {})}));
    return shares;
}

std::vector<SimulatedRank> simulated(std::span<const Share> shares, uint boxes, Programs& programs,
                                     Queue& queue, Builder& builder)
{
    const auto parts = static_cast<uint>(shares.size());
    std::vector<Aabb> tops;
    for (const Share& share : shares)
        for (const Aabb& top : tops_of(share, boxes, programs, queue, builder))
            tops.push_back(top);
    std::vector<SimulatedRank> ranks(parts);
    for (uint rank = 0; rank < parts; ++rank) {
        const Share& share = shares[rank];
        ranks[rank].triangles = share.triangle_count();
        std::vector<std::uint64_t> sent(parts);
        for (const Pair& one :
             leaving(face_boxes(share.points, share.faces), wanted_from(rank, tops, parts)))
            ++sent[one.b];
        for (uint to = 0; to < parts; ++to) {
            ranks[rank].halo_sent += sent[to];
            ranks[rank].targets += sent[to] > 0 ? 1 : 0;
            ranks[to].halo_received += sent[to];
            ranks[to].sources += sent[to] > 0 ? 1 : 0;
        }
    }
    return ranks;
}

std::int64_t exchange_ns(std::span<const SimulatedRank> ranks, uint boxes)
{
    if (ranks.size() < 2)
        return 0;
    const std::uint64_t halo = std::ranges::max(ranks, {}, &SimulatedRank::halo_sent).halo_sent;
    const std::uint64_t bytes =
        halo * sizeof(HaloTriangle) + (ranks.size() - 1) * boxes * sizeof(Aabb);
    return std::llround(waits_a_frame * ns_a_wait + static_cast<double>(bytes) / bytes_a_ns);
}

}  // namespace bvhbench
