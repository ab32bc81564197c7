// SPDX-License-Identifier: MIT
#include "collide/object_filter.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "geometry/error.h"
#include "geometry/hash.h"

namespace bvhbench {
namespace {

constexpr uint all_bits = ~0u;

/// Returns the rule of an object, without its list.
FilterRule rule_of(const ObjectFilter& filter, std::size_t object)
{
    return {filter.groups.empty() ? all_bits : filter.groups[object],
            filter.masks.empty() ? all_bits : filter.masks[object], 0, 0};
}

}  // namespace

bool ObjectFilter::allows(uint a, uint b) const
{
    if (a != b && !masks_meet(rule_of(*this, a), rule_of(*this, b)))
        return false;
    return !std::ranges::binary_search(excluded, Pair{std::min(a, b), std::max(a, b)});
}

void ObjectFilter::check(std::size_t objects) const
{
    const std::string there_are = ", and there are " + std::to_string(objects) + " objects";
    for (const auto& [words, name] : {std::pair{&groups, "groups"}, std::pair{&masks, "masks"}})
        if (!words->empty() && words->size() != objects)
            throw BadUsage("a filter has " + std::to_string(words->size()) + ' ' + name +
                           there_are);
    for (const Pair pair : excluded)
        if (pair.b >= objects)
            throw BadUsage("a filter excludes object " + std::to_string(pair.b) + there_are);
}

std::uint64_t ObjectFilter::hash() const
{
    if (is_empty())
        return 0;
    Hash hash;
    for (const std::vector<uint>* words : {&groups, &masks}) {
        hash.value(words->size());
        hash.values(std::span(*words));
    }
    hash.values(std::span(excluded));
    return hash.get();
}

std::vector<Pair> excluded_pairs(std::vector<Pair> pairs)
{
    for (Pair& pair : pairs)
        if (pair.a > pair.b)
            std::swap(pair.a, pair.b);
    std::ranges::sort(pairs);
    const auto doubled = std::ranges::unique(pairs);
    pairs.erase(doubled.begin(), doubled.end());
    return pairs;
}

FilterTables tables_of(const ObjectFilter& filter, std::size_t objects)
{
    std::vector<std::vector<uint>> lists(objects);
    for (const Pair pair : filter.excluded) {  // ascending, so each list ascends as well
        lists[pair.b].push_back(pair.a);
        if (pair.a != pair.b)
            lists[pair.a].push_back(pair.b);
    }
    FilterTables tables;
    for (std::size_t k = 0; k < objects; ++k) {
        FilterRule rule = rule_of(filter, k);
        rule.first = static_cast<uint>(tables.excluded.size());
        rule.count = static_cast<uint>(lists[k].size());
        tables.rules.push_back(rule);
        tables.excluded.insert(tables.excluded.end(), lists[k].begin(), lists[k].end());
    }
    return tables;
}

}  // namespace bvhbench
