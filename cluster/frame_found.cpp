// SPDX-License-Identifier: MIT
//
// What the last frame found, by numbers of the scene: pairs, contacts, their hash, and those of a sample of triangles.
#include <algorithm>

#include "cluster/frame.h"
#include "collide/device_lists.h"

namespace bvhbench {

std::vector<Pair> DistributedFrame::contacts() const
{
    if (!contacts_)
        return pairs();
    std::vector<Pair> all = contacts_->contacts(queue_);
    for (Pair& pair : all)
        pair = scene_pair(pair);
    return all;
}

std::vector<Pair> DistributedFrame::pairs() const
{
    std::vector<Pair> all = pairs_of_one_;
    if (has_tree()) {
        all = collider_.pairs(queue_);
        const std::vector<Pair> halo =
            halo_.empty() ? std::vector<Pair>() : halo_query_.pairs(queue_);
        all.insert(all.end(), halo.begin(), halo.end());
    }
    for (Pair& pair : all)
        pair = scene_pair(pair);
    return all;
}

/// Returns the scene's number of triangle k, of this rank or, after those, of the halo.
uint DistributedFrame::scene_id(uint k) const
{
    const uint own = share_.triangle_count();
    return k < own ? share_.ids[k] : halo_[k - own].id;
}

Pair DistributedFrame::scene_pair(Pair pair) const
{
    const uint a = scene_id(pair.a), b = scene_id(pair.b);
    return {std::min(a, b), std::max(a, b)};
}

/// Calls work(pairs, count, names) for the pairs of the rank's own triangles, and for those with the halo if there are any.
template <class OnDevice>
void DistributedFrame::on_named_pairs(const OnDevice& work)
{
    std::vector<uint> names = share_.ids;
    for (const HaloTriangle& one : halo_)
        names.push_back(one.id);
    std::optional<Arena> arena;
    Buffer<uint> on_device;
    take_memory(arena, programs_.device(),
                [&](Arena& memory) { on_device = memory.take<uint>(names.size(), Use::scratch); });
    on_device.upload(queue_.cl(), names);
    work(collider_.device_pairs(queue_), collider_.counts(queue_).pairs, on_device);
    if (!halo_.empty())
        work(halo_query_.device_pairs(queue_), halo_query_.counts(queue_).pairs, on_device);
}

PairFacts DistributedFrame::facts()
{
    if (!has_tree())
        return facts_of(pairs());
    PairFacts all;
    on_named_pairs([&](const DevicePairs& pairs, std::uint64_t count, const Buffer<uint>& names) {
        const PairFacts facts = facts_on_device(programs_, pairs, count, queue_, &names);
        all = {all.count + facts.count, all.low + facts.low, all.high + facts.high};
    });
    return all;
}

std::vector<Pair> DistributedFrame::pairs_of(const TriangleSample& sample)
{
    std::vector<Pair> all;
    if (!has_tree()) {
        all = pairs();
        std::erase_if(all, [&](Pair pair) { return !sample.has(pair.a) && !sample.has(pair.b); });
        return all;
    }
    on_named_pairs([&](const DevicePairs& pairs, std::uint64_t count, const Buffer<uint>& names) {
        const std::vector<Pair> some = sample.of_device(programs_, pairs, count, queue_, &names);
        all.insert(all.end(), some.begin(), some.end());
    });
    return all;
}

std::vector<Pair> DistributedFrame::right_pairs_of(const TriangleSample& sample)
{
    std::vector<HaloTriangle> own;
    for (const uint id : sample.ids()) {
        const auto found = std::ranges::lower_bound(share_.ids, id);
        if (found == share_.ids.end() || *found != id)
            continue;
        const std::size_t k = static_cast<std::size_t>(found - share_.ids.begin());
        own.push_back({own_box(k), id, share_.scene_face(k)});
    }
    std::vector<HaloTriangle> all;
    for (const auto& from : exchanged(ranks_, std::vector(ranks_.count(), own)))
        all.insert(all.end(), from.begin(), from.end());
    WantedBoxes wanted;
    for (const HaloTriangle& one : all)
        wanted.add(static_cast<uint>(wanted.ranks.size()), {&one.box, 1});
    std::vector<Pair> pairs;
    start_selecting(std::move(wanted));
    for (const auto& [k, place] : selected()) {
        const HaloTriangle& other = all[place];
        const uint id = share_.ids[k];
        if (id == other.id || (sample.has(id) && id < other.id) || !overlap(own_box(k), other.box))
            continue;
        if (keep_adjacent_ || !share_a_vertex(share_.scene_face(k), other.vertices))
            pairs.push_back({std::min(id, other.id), std::max(id, other.id)});
    }
    return pairs;
}

}  // namespace bvhbench
