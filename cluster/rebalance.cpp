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

double imbalance_of(std::uint64_t own, Ranks& ranks)
{
    const std::vector<std::uint64_t> all =
        gathered<std::uint64_t>(ranks, std::span<const std::uint64_t>(&own, 1));
    double sum = 0;
    for (const std::uint64_t work : all)
        sum += static_cast<double>(work);
    return static_cast<double>(std::ranges::max(all)) * static_cast<double>(all.size()) / sum;
}

Cut cut(Share share, PartitionBy by, std::span<const uint> work, Ranks& ranks)
{
    std::vector<Point> centres = box_centres(share);
    const std::vector<uint> to = partitioned({centres, share.ids, work}, by, ranks.count(), ranks);
    centres = {};  // frees memory before more is taken
    Cut result;
    result.left = static_cast<std::uint64_t>(
        std::ranges::count_if(to, [&](uint rank) { return rank != ranks.rank(); }));
    result.share = moved(std::move(share), to, ranks);
    return result;
}

}  // namespace bvhbench
