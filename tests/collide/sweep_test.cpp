// SPDX-License-Identifier: MIT
#include "collide/oracles/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace bvhbench {
namespace {

/// Returns the overlapping pairs by testing all pairs.
PairList brute_force(std::span<const Aabb> boxes)
{
    std::vector<Pair> found;
    for (uint a = 0; a < boxes.size(); ++a)
        for (uint b = a + 1; b < boxes.size(); ++b)
            if (boxes[a].min_x <= boxes[b].max_x && boxes[b].min_x <= boxes[a].max_x &&
                boxes[a].min_y <= boxes[b].max_y && boxes[b].min_y <= boxes[a].max_y &&
                boxes[a].min_z <= boxes[b].max_z && boxes[b].min_z <= boxes[a].max_z)
                found.push_back({a, b});
    return PairList(std::move(found));
}

/// Returns boxes around (0, 0, 0) at small integer multiples of `x`, `y`, `z`, so that many touch or begin at the same place.
std::vector<Aabb> lattice_boxes(std::size_t count, float x, float y, float z, unsigned seed)
{
    std::mt19937 random(seed);
    const auto from_to = [&](int low, int high) {
        return static_cast<float>(low + static_cast<int>(random() % unsigned(high - low + 1)));
    };
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const float min_x = from_to(-20, 20), min_y = from_to(-20, 20), min_z = from_to(-20, 20);
        boxes.push_back({min_x * x, min_y * y, min_z * z, (min_x + from_to(0, 9)) * x,
                         (min_y + from_to(0, 9)) * y, (min_z + from_to(0, 9)) * z});
    }
    return boxes;
}

TEST(OverlappingPairs, AreThoseOfBruteForceWhicheverAxisIsLongest)
{
    for (unsigned seed = 0; seed < 30; ++seed)
        for (const std::vector<Aabb>& boxes :
             {lattice_boxes(200, 1, 1, 1, seed), lattice_boxes(200, 10, 1, 1, seed),
              lattice_boxes(200, 1, 10, 1, seed), lattice_boxes(200, 1, 1, 10, seed),
              lattice_boxes(200, 1, 1, 0, seed), lattice_boxes(200, 1, 0, 0, seed),
              lattice_boxes(seed, 1, 1, 1, seed)}) {
            const PairList pairs = overlapping_pairs(boxes);
            ASSERT_EQ(pairs, brute_force(boxes)) << seed;
            ASSERT_EQ(pairs.surplus(), 0u);
        }
}

TEST(OverlappingPairs, TouchingBoxesOverlapAndTheNextNumberDoesNot)
{
    const Aabb unit = {0, 0, 0, 1, 1, 1};
    const float beyond = std::nextafter(1.0f, 2.0f);
    EXPECT_EQ(overlapping_pairs(std::vector{unit, Aabb{1, 0, 0, 2, 1, 1}}).size(), 1u);  // face
    EXPECT_EQ(overlapping_pairs(std::vector{unit, Aabb{1, 1, 0, 2, 2, 1}}).size(), 1u);  // edge
    EXPECT_EQ(overlapping_pairs(std::vector{unit, Aabb{1, 1, 1, 2, 2, 2}}).size(), 1u);  // corner
    EXPECT_EQ(overlapping_pairs(std::vector{unit, Aabb{beyond, 0, 0, 2, 1, 1}}).size(), 0u);
    EXPECT_EQ(overlapping_pairs(std::vector{unit, Aabb{0, beyond, 0, 1, 2, 1}}).size(), 0u);
    EXPECT_EQ(overlapping_pairs(std::vector{unit, Aabb{0, 0, beyond, 1, 1, 2}}).size(), 0u);
}

TEST(OverlappingPairs, OfIdenticalBoxesAreAllPairs)
{
    for (const Aabb& box : {Aabb{0, 0, 0, 1, 1, 1}, Aabb{5, 5, 5, 5, 5, 5}}) {
        const PairList pairs = overlapping_pairs(std::vector<Aabb>(100, box));
        EXPECT_EQ(pairs.size(), 100u * 99u / 2u);
        EXPECT_EQ(pairs.surplus(), 0u);
    }
}

TEST(OverlappingPairs, OfNoneOrOneBoxAreNone)
{
    EXPECT_EQ(overlapping_pairs({}).size(), 0u);
    EXPECT_EQ(overlapping_pairs(std::vector<Aabb>(1, {0, 0, 0, 1, 1, 1})).size(), 0u);
}

TEST(OverlappingPairs, SurviveTheWholeRangeOfFloats)
{
    const float big = std::numeric_limits<float>::max();
    const std::vector<Aabb> boxes = {{-big, -big, -big, big, big, big},
                                     {-big, -big, -big, -big, -big, -big},
                                     {big, big, big, big, big, big},
                                     {0, 0, 0, 0, 0, 0}};
    EXPECT_EQ(overlapping_pairs(boxes), PairList({{0, 1}, {0, 2}, {0, 3}}));
}

}  // namespace
}  // namespace bvhbench
