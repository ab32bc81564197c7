// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "collide/object_filter.h"
#include "collide/pairs.h"

namespace bvhbench {

/// Tells which pairs of triangles are wanted. By default all are.
class WantedPairs {
public:
    WantedPairs() = default;

    /// Pairs that `among` and `filter` accept; without `keep_adjacent`, only without a common vertex. Without `objects`, all faces are
    /// of one.
    WantedPairs(std::span<const Face> faces, bool keep_adjacent, std::span<const FaceRange> objects,
                Among among, ObjectFilter filter = {})
        : faces_(faces)
        , drops_adjacent_(!keep_adjacent)
        , drops_objects_(among != Among::all)
        , between_(among == Among::between_objects)
        , filter_(std::move(filter))
    {
        if (!drops_objects_ && filter_.is_empty())
            return;
        owners_.assign(faces.size(), 0);
        for (uint k = 0; k < objects.size(); ++k)
            for (uint face = 0; face < objects[k].count; ++face)
                owners_[objects[k].first + face] = k;
    }

    bool operator()(uint a, uint b) const
    {
        return !(drops_adjacent_ && share_a_vertex(faces_[a], faces_[b])) &&
               (!drops_objects_ || (owners_[a] != owners_[b]) == between_) &&
               (filter_.is_empty() || filter_.allows(owners_[a], owners_[b]));
    }

private:
    std::span<const Face> faces_;
    bool drops_adjacent_ = false, drops_objects_ = false, between_ = false;
    ObjectFilter filter_ = {};
    std::vector<uint> owners_;  ///< object of each face, if pairs are chosen by objects
};

}  // namespace bvhbench
