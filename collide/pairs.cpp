// SPDX-License-Identifier: MIT
#include "collide/pairs.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

#include "geometry/cores.h"
#include "geometry/hash.h"

namespace bvhbench {

// The hash reads the bytes of the list directly.
static_assert(std::endian::native == std::endian::little && sizeof(Pair) == 8);

namespace {

/// Sorts parts on all host cores, then merges neighbours until one part is left.
void sort_on_all_cores(std::vector<Pair>& pairs)
{
    constexpr std::size_t least_part = 1 << 16;
    const std::size_t parts =
        std::bit_floor(std::clamp<std::size_t>(pairs.size() / least_part, 1, 2 * core_count() - 1));
    const auto at = [&](std::size_t part) {
        return pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() * part / parts);
    };
    on_all_cores(parts, [&](std::size_t k) { std::sort(at(k), at(k + 1)); });
    for (std::size_t width = 1; width < parts; width *= 2)
        on_all_cores(parts / (2 * width), [&](std::size_t k) {
            const std::size_t first = 2 * width * k;
            std::inplace_merge(at(first), at(first + width), at(first + 2 * width));
        });
}

}  // namespace

PairList::PairList(std::vector<Pair> found) : pairs_(std::move(found))
{
    const std::size_t found_count = pairs_.size();
    std::erase_if(pairs_, [](Pair pair) { return pair.a == pair.b; });
    for (Pair& pair : pairs_)
        if (pair.b < pair.a)
            std::swap(pair.a, pair.b);
    if (!std::is_sorted(pairs_.begin(), pairs_.end()))
        sort_on_all_cores(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    surplus_ = found_count - pairs_.size();
}

std::uint64_t PairList::hash() const
{
    Hash hash;
    hash.values(pairs());
    return hash.get();
}

PairFacts facts_of(std::span<const Pair> pairs)
{
    constexpr std::size_t part_size = 1 << 18;
    std::vector<SetHash> parts((pairs.size() + part_size - 1) / part_size, SetHash{0, 0});
    on_all_cores(parts.size(), [&](std::size_t k) {
        const std::size_t first = k * part_size;
        for (const Pair pair : pairs.subspan(first, std::min(part_size, pairs.size() - first)))
            parts[k] = with_pair(parts[k], pair.a, pair.b);
    });
    const SetHash all = std::accumulate(parts.begin(), parts.end(), SetHash{0, 0}, both_sets);
    return {pairs.size(), all.low, all.high};
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
