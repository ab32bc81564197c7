// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "scenes/generate/vector.h"

namespace bvhbench {

/// Finds pairs of points that are near each other, by a hashed grid. Keeps its memory between calls.
class NearPairs {
public:
    /// All (i, j), i < j, of points nearer than `distance`, each once; in an order that depends on nothing but
    /// the points. Holds until the next call.
    const std::vector<std::pair<uint, uint>>& find(const std::vector<Vector>& points,
                                                   double distance);

private:
    using Cell = std::array<std::int64_t, 3>;
    std::size_t bucket(const Cell& cell) const;
    void sort(const std::vector<Vector>& points, double distance);

    std::vector<Cell> cells_;    ///< of the points
    std::vector<uint> begin_;    ///< of each bucket in `members_`, and the end of the last
    std::vector<uint> members_;  ///< points by bucket, ascending in each
    std::vector<std::pair<uint, uint>> pairs_;
};

}  // namespace bvhbench
