// SPDX-License-Identifier: MIT
#include "collide/pairs.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
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

bool has_exactly(const PairList& list, std::span<const Pair> found)
{
    const std::span<const Pair> all = list.pairs();
    if (found.size() != all.size() || all.empty())
        return found.size() == all.size();
    std::vector<std::size_t> begins(all.back().a + std::size_t{2}, 0);  // of the pairs of each a
    for (const Pair pair : all)
        ++begins[pair.a + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<char> is_there(all.size(), 0);
    return std::ranges::all_of(found, [&](Pair pair) {
        if (pair.b < pair.a)
            std::swap(pair.a, pair.b);
        if (pair.a > all.back().a)
            return false;
        const auto end = all.begin() + static_cast<std::ptrdiff_t>(begins[pair.a + 1]);
        const auto at =
            std::lower_bound(all.begin() + static_cast<std::ptrdiff_t>(begins[pair.a]), end, pair);
        if (at == end || *at != pair)
            return false;
        return std::exchange(is_there[static_cast<std::size_t>(at - all.begin())], 1) == 0;
    });
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

PairList chosen(const PairList& pairs, const std::function<bool(Pair)>& is_wanted)
{
    std::vector<Pair> wanted;
    std::ranges::copy_if(pairs.pairs(), std::back_inserter(wanted), is_wanted);
    return PairList(std::move(wanted));
}

PairList among_objects(const PairList& pairs, std::span<const FaceRange> objects, Among among)
{
    return chosen(pairs, [&](Pair pair) { return is_among(pair, objects, among); });
}

PairList selected(const PairList& pairs, const Family& family, Relation relation)
{
    return chosen(pairs, [&](Pair pair) { return relation_of(pair, family) == relation; });
}

PairList renumbered(PairList pairs, std::span<const uint> numbers)
{
    if (numbers.empty())
        return pairs;
    std::vector<Pair> numbered;
    numbered.reserve(pairs.size());
    for (const Pair pair : pairs.pairs())
        numbered.push_back({numbers[pair.a], numbers[pair.b]});
    return PairList(std::move(numbered));
}

}  // namespace bvhbench
