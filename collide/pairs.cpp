// SPDX-License-Identifier: MIT
#include "collide/pairs.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "geometry/hash.h"

namespace bvhbench {

// The hash reads the bytes of the list directly.
static_assert(std::endian::native == std::endian::little && sizeof(Pair) == 8);

PairList::PairList(std::vector<Pair> found) : pairs_(std::move(found))
{
    const std::size_t found_count = pairs_.size();
    std::erase_if(pairs_, [](Pair pair) { return pair.a == pair.b; });
    for (Pair& pair : pairs_)
        if (pair.b < pair.a)
            std::swap(pair.a, pair.b);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    surplus_ = found_count - pairs_.size();
}

std::uint64_t PairList::hash() const
{
    Hash hash;
    hash.values(pairs());
    return hash.get();
}

Relation relation_of(Pair pair, const Family& family)
{
    if (!family.objects.empty() && family.objects[pair.a] != family.objects[pair.b])
        return Relation::between_objects;
    return share_a_vertex(family.faces[pair.a], family.faces[pair.b]) ? Relation::adjacent
                                                                      : Relation::apart;
}

bool is_among(Pair pair, std::span<const FaceRange> objects, Among among)
{
    if (among == Among::all)
        return true;
    const auto object_of = [&](uint face) {
        return std::upper_bound(
            objects.begin(), objects.end(), face,
            [](uint value, const FaceRange& range) { return value < range.first; });
    };
    return (object_of(pair.a) != object_of(pair.b)) == (among == Among::between_objects);
}

PairList among_objects(const PairList& pairs, std::span<const FaceRange> objects, Among among)
{
    std::vector<Pair> chosen;
    std::copy_if(pairs.pairs().begin(), pairs.pairs().end(), std::back_inserter(chosen),
                 [&](Pair pair) { return is_among(pair, objects, among); });
    return PairList(std::move(chosen));
}

PairList selected(const PairList& pairs, const Family& family, Relation relation)
{
    std::vector<Pair> chosen;
    std::copy_if(pairs.pairs().begin(), pairs.pairs().end(), std::back_inserter(chosen),
                 [&](Pair pair) { return relation_of(pair, family) == relation; });
    return PairList(std::move(chosen));
}

}  // namespace bvhbench
