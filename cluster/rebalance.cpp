// SPDX-License-Identifier: MIT
#include "cluster/rebalance.h"

#include <algorithm>

namespace bvhbench {

std::vector<uint> work_of(const Share& share, std::span<const Pair> pairs)
{
    std::vector<uint> work(share.triangle_count(), 1);
    for (const Pair& pair : pairs)
        for (const uint id : {pair.a, pair.b})
            if (const auto own = std::ranges::lower_bound(share.ids, id);
                own != share.ids.end() && *own == id)
                ++work[static_cast<std::size_t>(own - share.ids.begin())];
    return work;
}

Rebalanced rebalanced(const Share& share, std::span<const uint> work, Ranks& ranks)
{
    const std::vector<Point> centres = box_centres(share);
    const std::vector<uint> to =
        partitioned({centres, share.ids, work}, PartitionBy::rcb, ranks.count(), ranks);
    Rebalanced result;
    result.left = static_cast<std::uint64_t>(
        std::ranges::count_if(to, [&](uint rank) { return rank != ranks.rank(); }));
    result.share = moved(share, to, ranks);
    return result;
}

}  // namespace bvhbench
