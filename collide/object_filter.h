// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "collide/filter.h"
#include "collide/pairs.h"

namespace bvhbench {

/// Which pairs of objects a query is about. Pairs of triangles of two objects that are filtered out are not in the answer, and neither
/// oracles nor colliders look for them.
struct ObjectFilter {
    /// By object: bits of what it is, and of what it is tested against. Two objects are tested if each is in a group of the other's
    /// mask; pairs within an object do not depend on them. Empty: all bits are set.
    std::vector<uint> groups, masks;
    /// Pairs of objects that are not tested, smaller one first, ascending, each once. An object with itself: pairs within it.
    std::vector<Pair> excluded;

    /// True if every pair is tested.
    bool is_empty() const { return groups.empty() && masks.empty() && excluded.empty(); }

    /// True if pairs of triangles of both objects are wanted; a == b asks for pairs within an object.
    bool allows(uint a, uint b) const;

    /// Throws BadUsage if there are groups or masks but not one for each of `objects` objects, or if an excluded object is none of these.
    void check(std::size_t objects) const;

    /// Identifies the question; 0 for an empty filter.
    std::uint64_t hash() const;

    bool operator==(const ObjectFilter&) const = default;
};

/// Returns the pairs as ObjectFilter::excluded has them. They may be in any order, with either object first, and more than once.
std::vector<Pair> excluded_pairs(std::vector<Pair> pairs);

/// A filter as the device reads it: a rule for each object, and the lists of what they exclude. A pair is in the lists of both objects.
struct FilterTables {
    std::vector<FilterRule> rules;
    std::vector<uint> excluded;
};
FilterTables tables_of(const ObjectFilter& filter, std::size_t objects);

}  // namespace bvhbench
