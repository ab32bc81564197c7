// SPDX-License-Identifier: MIT
#include "cluster/halo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cluster/partition.h"
#include "geometry/scene_bounds.h"
#include "tests/brute_pairs.h"
#include "tests/cluster/thread_ranks.h"

namespace bvhbench {
namespace {

/// Returns boxes with corners on a grid, so that some only touch.
std::vector<Aabb> random_boxes(uint count, float side, unsigned seed)
{
    std::mt19937 random(seed);
    const auto drawn = [&](float low, float high) {
        return std::round(256 * std::uniform_real_distribution<float>(low, high)(random)) / 256;
    };
    std::vector<Aabb> boxes;
    for (uint k = 0; k < count; ++k) {
        const float x = drawn(-1, 1), y = drawn(-1, 1), z = drawn(-1, 1);
        boxes.push_back({x, y, z, x + drawn(0, side), y + drawn(0, side), z + drawn(0, side)});
    }
    return boxes;
}

/// Returns boxes around runs of `boxes`, as many as a rank tells; the others are empty.
std::vector<Aabb> tops_of(std::span<const Aabb> boxes)
{
    std::vector<Aabb> tops(usual_top_boxes, empty_box());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        Aabb& top = tops[k * usual_top_boxes / boxes.size()];
        top = merged(top, boxes[k]);
    }
    return tops;
}

/// Boxes by the rank that owns them, box k by rank part[k].
struct OfRanks {
    std::vector<std::vector<uint>> ids;
    std::vector<std::vector<Aabb>> own;
    std::vector<Aabb> tops;

    OfRanks(std::span<const Aabb> boxes, std::span<const uint> part, uint ranks)
        : ids(ranks), own(ranks)
    {
        for (uint k = 0; k < boxes.size(); ++k) {
            ids[part[k]].push_back(k);
            own[part[k]].push_back(boxes[k]);
        }
        for (const std::vector<Aabb>& of_rank : own)
            std::ranges::copy(tops_of(of_rank), std::back_inserter(tops));
    }

    /// Returns which boxes a rank sends to which others.
    std::vector<Pair> leaving_from(uint rank) const
    {
        return leaving(own[rank], wanted_from(rank, tops, static_cast<uint>(own.size())));
    }
};

/// Returns the pairs that ranks find among `boxes`, rank after rank, if rank part[k] owns box k.
std::vector<Pair> pairs_of_ranks(std::span<const Aabb> boxes, std::span<const uint> part,
                                 uint ranks)
{
    const OfRanks all(boxes, part, ranks);
    std::vector<Pair> found;
    for (uint rank = 0; rank < ranks; ++rank) {
        const std::vector<uint>& ids = all.ids[rank];
        for (const Pair pair : brute_pairs(all.own[rank]))
            found.push_back({ids[pair.a], ids[pair.b]});
        for (const Pair& one : all.leaving_from(rank))
            for (const uint other : all.ids[one.b])
                if (overlap(all.own[rank][one.a], boxes[other]))
                    found.push_back({ids[one.a], other});
    }
    return found;
}

TEST(Halo, GoesFromOneOfTwoRanksToTheOther)
{
    for (uint a = 0; a < 9; ++a) {
        EXPECT_FALSE(sends_to(a, a));
        uint receives = 0;
        for (uint b = 0; b < 9; ++b) {
            EXPECT_EQ(sends_to(a, b) != sends_to(b, a), a != b) << a << ", " << b;
            receives += sends_to(b, a) ? 1u : 0u;
        }
        EXPECT_EQ(receives, 4u) << "of 9 ranks, each tests those of as many";
    }
}

TEST(Halo, OfAnyPartsGivesEveryPairOnce)
{
    for (const float side : {0.0f, 0.05f, 0.6f})
        for (const uint ranks : {1u, 2u, 3u, 5u, 8u}) {
            const std::vector<Aabb> boxes = random_boxes(400, side, ranks);
            std::mt19937 random(ranks);
            std::vector<uint> part;
            for (std::size_t k = 0; k < boxes.size(); ++k)
                part.push_back(static_cast<uint>(random()) % ranks);
            const PairList found(pairs_of_ranks(boxes, part, ranks));
            EXPECT_EQ(found.surplus(), 0u);
            EXPECT_EQ(found, PairList(brute_pairs(boxes)));
        }
}

TEST(Halo, OfARankInsideAnotherIsComplete)
{
    std::vector<Aabb> boxes = random_boxes(300, 0.3f, 7);
    std::vector<uint> part;
    for (Aabb& box :
         boxes) {  // rank 1 has the middle of what rank 0 has around it, rank 2 has nothing
        const Point centre = box_centre(box);
        part.push_back(std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)}) <
                       0.6f);
    }
    EXPECT_EQ(PairList(pairs_of_ranks(boxes, part, 3)), PairList(brute_pairs(boxes)));
}

TEST(Halo, IsSmallIfPartsAreBoxes)
{
    const std::vector<Aabb> boxes = random_boxes(20000, 0.01f, 3);
    std::vector<Point> centres;
    std::vector<uint> ids;
    for (uint k = 0; k < boxes.size(); ++k) {
        centres.push_back(box_centre(boxes[k]));
        ids.push_back(k);
    }
    std::vector<uint> part;
    on_ranks(1, [&](Ranks& ranks) {
        part = partitioned({centres, ids}, PartitionBy::rcb, 8, ranks);
    });
    const OfRanks all(boxes, part, 8);
    std::size_t left = 0;
    for (uint rank = 0; rank < 8; ++rank)
        left += all.leaving_from(rank).size();
    EXPECT_GT(left, 0u);
    EXPECT_LT(left, boxes.size() / 20);
}

}  // namespace
}  // namespace bvhbench
