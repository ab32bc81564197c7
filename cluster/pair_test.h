// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "collide/narrow/narrow.h"
#include "collide/within/within.h"

namespace bvhbench {

/// Which pairs of boxes a narrow phase keeps.
struct PairTest {
    std::string_view narrow = "none";  ///< a name of collide/narrow/narrow_methods.h, or "none"
    /// If given, those at most so far apart, in the unit of the points: by `narrow`, a method for distances, or exactly if that is "none".
    std::optional<double> distance = std::nullopt;
    bool keep_adjacent = true;

    bool decides() const { return distance || narrow != "none"; }
};

/// The narrow phase of a PairTest that decides: contacts, or pairs within a distance.
class PairDecider {
public:
    /// Throws what the narrow phases throw.
    PairDecider(Programs& programs, const PairTest& test);

    /// Reserves memory: for the pairs of `triangles`, and if there is a distance to pad `points`. Never timed. Throws Unavailable.
    void reserve(std::size_t points, std::size_t triangles);

    /// Returns the input with room for the distance, whose boxes are tested, if there is a distance; else nothing. Does not block.
    std::optional<Input> padded(const Input& input, Queue& queue);

    /// Decides the candidates, which are complete. Blocks.
    void decide(const Input& input, const DevicePairs& candidates, Queue& queue);

    /// Pairs that the last call kept, and their number. Both functions block.
    std::vector<Pair> pairs(const Queue& queue) const;
    std::uint64_t count(const Queue& queue) const;

private:
    std::optional<NarrowPhase> meet_;
    std::optional<WithinPhase> within_;
};

}  // namespace bvhbench
