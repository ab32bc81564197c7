// SPDX-License-Identifier: MIT
#include "collide/best_pipeline.h"
#include "collide/collider.h"
#include "collide/counters.h"
#include "collide/device_lists.h"
#include "collide/narrow/narrow_words.h"
#include "geometry/error.h"
#include "library/tree.h"

namespace bvhbench::oibvh {
namespace {

constexpr Named<MakeCollider> colliders[] = {
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

ObjectFilter internal(const Filter& filter)
{
    std::vector<bvhbench::Pair> excluded;
    for (const Excluded& pair : filter.excluded)
        excluded.push_back({pair.a, pair.b});
    return {.groups = {filter.groups.begin(), filter.groups.end()},
            .masks = {filter.masks.begin(), filter.masks.end()},
            .excluded = excluded_pairs(std::move(excluded))};
}

}  // namespace

const Named<MakeCollider>& collider_for(const bvhbench::Device& device, std::string_view asked)
{
    if (asked.empty())
        asked = best_pipeline(device).collider;
    return find_called(colliders, asked, "collider of the library");
}

Pairs Tree::Impl::found(DevicePairs pairs, std::uint64_t count)
{
    static_assert(PAIRS_COUNT == 0 && CONTACTS_COUNT == 0);
    const auto& [found, number] = last_pairs.emplace(std::move(pairs), count);
    return {.pairs = found.pairs.cl()(), .device_count = found.counters.cl()(), .count = number};
}

Pairs Tree::Impl::found_by(Collider& from)
{
    return found(from.device_pairs(device->queue), from.counts(device->queue).pairs);
}

void Tree::Impl::require_triangles(const char* answers) const
{
    if (taker.are_boxes())
        throw BadUsage(std::string("boxes have overlaps but no ") + answers +
                       ": those are of triangles");
}

Collider& Tree::Impl::queried(Among among, ObjectFilter filter, bool first,
                              std::optional<double> distance,
                              const std::function<void(Collider&)>& then)
{
    const ImplicitTree& own = standing("a query");
    const bvhbench::Among wanted = internal(among);
    filter.check(own.objects.size());
    if (first)
        require_triangles("contacts");
    if (distance)
        require_triangles("distances");
    begin();
    std::optional<bvhbench::Input> wide;
    if (distance)
        wide = padded.build(*distance, taker.taken(), sizes);
    if (!first)
        last_pairs.reset();
    const ImplicitTree& over = distance ? padded.tree() : own;
    const bvhbench::Input& input = distance ? *wide : taker.taken();
    Query& query = queries[static_cast<std::size_t>(among) + (first ? queries.size() / 2 : 0)];
    if (query.filter != filter)
        query = {};
    query.filter = std::move(filter);
    if (query.collider == nullptr)
        query.collider = (first ? make_leaf : collider.make)(
            device->programs, {.among = wanted,
                               .keep_adjacent = options.adjacent_pairs,
                               .filter = query.filter,
                               .first = first});
    if (!std::exchange(query.is_ready, false))  // set again on success
        query.collider->reserve(&over, input);
    do {
        query.collider->query(&over, input, device->queue);
        if (then)
            then(*query.collider);
    } while (!query.collider->complete(device->queue));
    query.is_ready = true;
    return *query.collider;
}

Pairs Tree::find_pairs(Among among) { return find_pairs(among, Filter{}); }

Pairs Tree::find_pairs(Among among, const Filter& filter)
{
    return as_call(*impl_->device, [among, &filter, &own = *impl_] {
        return own.found_by(own.queried(among, internal(filter), false));
    });
}

std::optional<Pair> Tree::first_contact(Among among, const Filter& filter)
{
    return as_call(*impl_->device, [among, &filter, &own = *impl_]() -> std::optional<Pair> {
        const Collider& asked = own.queried(among, internal(filter), true);
        const std::vector<bvhbench::Pair> found = asked.pairs(own.device->queue);
        return found.empty() ? std::nullopt
                             : std::optional<Pair>({found.front().a, found.front().b});
    });
}

Pairs Tree::find_contacts(Among among, const Filter& filter)
{
    return as_call(*impl_->device, [=, &filter, &own = *impl_] {
        own.standing("a query");
        own.require_triangles("contacts");
        Queue& queue = own.device->queue;
        if (!own.narrow)
            own.narrow.emplace(own.device->programs,
                               NarrowOptions{.keep_adjacent = own.options.adjacent_pairs});
        if (own.narrow->reserved().total() == 0)
            own.narrow->reserve(own.taker.taken().triangle_count());
        const auto decide = [&](Collider& from) {
            const DevicePairs candidates = from.device_pairs(queue);
            own.narrow->query(own.taker.taken(), candidates.pairs, candidates.counters, queue);
        };
        Collider& asked = own.queried(among, internal(filter), false, {}, decide);
        while (!own.narrow->complete(queue))
            decide(asked);
        return own.found(own.narrow->device_contacts(), own.narrow->counts(queue).contacts);
    });
}

Pairs Tree::find_within(double distance, Among among, const Filter& filter)
{
    return as_call(*impl_->device, [=, &filter, &own = *impl_] {
        Collider& asked = own.queried(among, internal(filter), false, distance);
        auto [pairs, count] =
            own.padded.decide(own.taker.taken(), asked.device_pairs(own.device->queue));
        return own.found(std::move(pairs), count);
    });
}

Pairs Tree::find_pairs(const Tree& other)
{
    return as_call(*impl_->device, [&own = *impl_, &theirs = *other.impl_] {
        const ImplicitTree& a = own.standing("a query");
        if (theirs.device != own.device)
            throw BadUsage("a query between trees wants both of one Device");
        const ImplicitTree& b = theirs.standing("a query between trees");
        own.begin();
        own.last_pairs.reset();
        return own.found_by(own.joined.find_pairs(a, b));
    });
}

std::vector<Pair> Tree::read_pairs() const
{
    static_assert(sizeof(Pair) == sizeof(bvhbench::Pair));
    return as_call(*impl_->device, [&own = *impl_] {
        if (!own.last_pairs)
            throw BadUsage("there are no pairs to read: nothing was queried since the last build");
        own.device->queue.join();
        const auto& [found, count] = *own.last_pairs;
        return first_entries(found.pairs.as<Pair>(), count, own.device->queue, "the pairs");
    });
}

}  // namespace bvhbench::oibvh
