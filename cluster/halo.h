// SPDX-License-Identifier: MIT
//
// Which triangles leave a rank to be tested against another rank's tree, and on which of two ranks a pair is found.
//
// Each rank tells all others the same number of boxes, which together contain all its triangles. A triangle that overlaps one of another
// rank overlaps one of that rank's boxes, so those that overlap none of them can stay. Of two ranks one tests the other's
// triangles, by a rule that needs no message. So every pair between two ranks is found, on one rank, and there once.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "collide/pairs.h"
#include "geometry/aabb.h"

namespace bvhbench {

/// Usual number of boxes that a rank tells the others: the nodes of a level of its tree. Any tree with 2, 4 or 8 children a node has
/// a level of as many.
inline constexpr uint usual_top_boxes = 64;

/// True if triangles of rank `from` are tested against the tree of rank `to`. Of two different ranks it is the first if the sum of
/// their numbers is even, so each rank tests those of about half of the others.
constexpr bool sends_to(uint from, uint to)
{
    const bool to_first = (from + to) % 2 == 0;
    return from != to && to == (to_first ? std::min(from, to) : std::max(from, to));
}

/// The boxes of other ranks that a rank's triangles are tested against.
struct WantedBoxes {
    struct OfRank {
        uint rank, end;  ///< `end`: where its boxes end
    };
    std::vector<Aabb> boxes;    ///< of each rank the box around its boxes, then these
    std::vector<OfRank> ranks;  ///< ascending

    /// Adds the boxes of one more rank, unless there are none.
    void add(uint rank, std::span<const Aabb> of_rank);
};

/// Returns the boxes, among `tops`, equally many of each of `ranks` ranks one after the other, of the ranks that `own` sends to.
/// Leaves out those that overlap none of its own, and empty ones, and cuts the others to what its own triangles can meet.
WantedBoxes wanted_from(uint own, std::span<const Aabb> tops, uint ranks);

/// Returns the triangles that leave, with the rank that each goes to, by triangle; a triangle may leave to several ranks. The slow
/// form on the host: `boxes` are those of this rank's triangles.
std::vector<Pair> leaving(std::span<const Aabb> boxes, const WantedBoxes& wanted);

}  // namespace bvhbench
