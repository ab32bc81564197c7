// SPDX-License-Identifier: MIT
#include <algorithm>

#include "collide/collider.h"
#include "collide/counters.h"
#include "geometry/error.h"
#include "library/tree.h"

namespace bvhbench::oibvh {
namespace {

constexpr std::pair<std::string_view, MakeCollider> collider_names[] = {
    {"leaf", make_leaf}, {"group", make_group}, {"block", make_block}, {"bvtt", make_bvtt}};

bvhbench::Among internal(Among among)
{
    switch (among) {
        case Among::all:
            return bvhbench::Among::all;
        case Among::between_objects:
            return bvhbench::Among::between_objects;
        case Among::within_objects:
            return bvhbench::Among::within_objects;
    }
    throw BadUsage("a query is among all, between_objects or within_objects, not " +
                   std::to_string(static_cast<int>(among)));
}

}  // namespace

/// What was fastest wherever it was measured (docs/collisions.md): eight boxes at a time on a CPU, a warp's 32 on NVIDIA's
/// GPUs. On others nothing was; leaves that walk by themselves want neither warps nor much local memory.
std::string_view collider_for(const bvhbench::Device& device, std::string_view asked)
{
    if (asked.empty())
        return device.is_cpu() ? "group" : device.lets_groups_wait() ? "block" : "leaf";
    for (const auto& [name, make] : collider_names)
        if (name == asked)
            return name;
    throw BadUsage("no collider of the library is called '" + std::string(asked) +
                   "'; there are: leaf, group, block, bvtt");
}

std::unique_ptr<Collider> make_collider(Programs& programs, std::string_view name,
                                        const ColliderOptions& options)
{
    for (const auto& [known, make] : collider_names)
        if (known == name)
            return make(programs, options);
    return nullptr;
}

Pairs Tree::Impl::find_pairs(Among among)
{
    const ImplicitTree& over = standing("a query");
    const bvhbench::Among wanted = internal(among);
    begin();
    last_query = nullptr;
    Query& query = queries[static_cast<std::size_t>(among)];
    if (query.collider == nullptr)
        query.collider = make_collider(device->programs, collider_name,
                                       {.among = wanted, .keep_adjacent = options.adjacent_pairs});
    if (!std::exchange(query.is_ready, false))  // until all has gone well
        query.collider->reserve(&over, taker.taken());
    bvhbench::find_pairs(*query.collider, &over, taker.taken(), device->queue);
    query.is_ready = true;
    return found_by(*query.collider);
}

Pairs Tree::Impl::find_pairs(const Impl& other)
{
    const ImplicitTree& a = standing("a query");
    if (other.device != device)
        throw BadUsage("a query between trees wants both of one Device");
    const ImplicitTree& b = other.standing("a query between trees");
    begin();
    last_query = nullptr;
    return found_by(joined.find_pairs(a, b, collider_name));
}

Pairs Tree::Impl::found_by(Collider& collider)
{
    last_query = &collider;
    const DevicePairs found = collider.device_pairs(device->queue);
    static_assert(PAIRS_COUNT == 0);
    return {.pairs = found.pairs.cl()(),
            .device_count = found.counters.cl()(),
            .count = collider.counts(device->queue).pairs};
}

std::vector<Pair> Tree::Impl::read_pairs() const
{
    static_assert(sizeof(Pair) == sizeof(bvhbench::Pair));
    if (last_query == nullptr)
        throw BadUsage("there are no pairs to read: nothing was queried since the last build");
    device->queue.join();
    const std::vector<bvhbench::Pair> found = last_query->pairs(device->queue);
    std::vector<Pair> pairs(found.size());
    std::transform(found.begin(), found.end(), pairs.begin(), [](bvhbench::Pair pair) {
        return Pair{pair.a, pair.b};
    });
    return pairs;
}

Pairs Tree::find_pairs(Among among)
{
    return as_call(*impl_->device, [&] { return impl_->find_pairs(among); });
}

Pairs Tree::find_pairs(const Tree& other)
{
    return as_call(*impl_->device, [&] { return impl_->find_pairs(*other.impl_); });
}

std::vector<Pair> Tree::read_pairs() const
{
    return as_call(*impl_->device, [&] { return impl_->read_pairs(); });
}

}  // namespace bvhbench::oibvh
