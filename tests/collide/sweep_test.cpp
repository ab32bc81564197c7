// SPDX-License-Identifier: MIT
#include "collide/oracles/sweep.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "collide/oracles/axes.h"
#include "collide/oracles/box_pairs.h"
#include "tests/brute_pairs.h"

namespace bvhbench {
namespace {

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

using Oracle = PairList (*)(std::span<const Aabb>, const WantedPairs&);

class OraclesOfPairs : public testing::TestWithParam<Oracle> {
protected:
    static PairList oracle(std::span<const Aabb> boxes, const WantedPairs& wanted = {})
    {
        return GetParam()(boxes, wanted);
    }
};

TEST(Axes, BeginWithTheOneAlongWhichFewestBoxesOverlap)
{
    std::vector<Aabb> rows;  // of 16 rows along x, all boxes of a row at one y
    for (int k = 0; k < 1 << 15; ++k) {
        const auto x = static_cast<float>(k % 2048), y = static_cast<float>(k / 2048);
        rows.push_back({x, y, 0, x + 1, y, 2});
    }
    const std::array<Axis, 3> axes = axes_of(rows);
    EXPECT_LT(axes[1].share, axes[0].share);  // a box has no extent along y, and yet
    EXPECT_TRUE(axes[0].min == &Aabb::min_x && axes[1].min == &Aabb::min_y);
}

TEST_P(OraclesOfPairs, AreThoseOfBruteForceWhicheverAxisIsLongest)
{
    for (unsigned seed = 0; seed < 30; ++seed)
        for (const std::vector<Aabb>& boxes :
             {lattice_boxes(200, 1, 1, 1, seed), lattice_boxes(200, 10, 1, 1, seed),
              lattice_boxes(200, 1, 10, 1, seed), lattice_boxes(200, 1, 1, 10, seed),
              lattice_boxes(200, 1, 1, 0, seed), lattice_boxes(200, 1, 0, 0, seed),
              lattice_boxes(seed, 1, 1, 1, seed)}) {
            const PairList pairs = oracle(boxes);
            ASSERT_EQ(pairs, PairList(brute_pairs(boxes))) << seed;
            ASSERT_EQ(pairs.surplus(), 0u);
        }
}

TEST_P(OraclesOfPairs, TouchingBoxesOverlapAndTheNextNumberDoesNot)
{
    const Aabb unit = {0, 0, 0, 1, 1, 1};
    const float beyond = std::nextafter(1.0f, 2.0f);
    EXPECT_EQ(oracle(std::vector{unit, Aabb{1, 0, 0, 2, 1, 1}}).size(), 1u);  // face
    EXPECT_EQ(oracle(std::vector{unit, Aabb{1, 1, 0, 2, 2, 1}}).size(), 1u);  // edge
    EXPECT_EQ(oracle(std::vector{unit, Aabb{1, 1, 1, 2, 2, 2}}).size(), 1u);  // corner
    EXPECT_EQ(oracle(std::vector{unit, Aabb{beyond, 0, 0, 2, 1, 1}}).size(), 0u);
    EXPECT_EQ(oracle(std::vector{unit, Aabb{0, beyond, 0, 1, 2, 1}}).size(), 0u);
    EXPECT_EQ(oracle(std::vector{unit, Aabb{0, 0, beyond, 1, 1, 2}}).size(), 0u);
}

TEST_P(OraclesOfPairs, OfIdenticalBoxesAreAllPairs)
{
    for (const Aabb& box : {Aabb{0, 0, 0, 1, 1, 1}, Aabb{5, 5, 5, 5, 5, 5}}) {
        const PairList pairs = oracle(std::vector<Aabb>(100, box));
        EXPECT_EQ(pairs.size(), 100u * 99u / 2u);
        EXPECT_EQ(pairs.surplus(), 0u);
    }
}

TEST_P(OraclesOfPairs, OfNoneOrOneBoxAreNone)
{
    EXPECT_EQ(oracle({}).size(), 0u);
    EXPECT_EQ(oracle(std::vector<Aabb>(1, {0, 0, 0, 1, 1, 1})).size(), 0u);
}

TEST_P(OraclesOfPairs, SurviveTheWholeRangeOfFloats)
{
    const float big = std::numeric_limits<float>::max();
    const std::vector<Aabb> boxes = {{-big, -big, -big, big, big, big},
                                     {-big, -big, -big, -big, -big, -big},
                                     {big, big, big, big, big, big},
                                     {0, 0, 0, 0, 0, 0}};
    EXPECT_EQ(oracle(boxes), PairList({{0, 1}, {0, 2}, {0, 3}}));
}

TEST_P(OraclesOfPairs, TakeInfinitiesForNumbersAndBothZerosForOne)
{
    const float endless = std::numeric_limits<float>::infinity();
    const float big = std::numeric_limits<float>::max();
    const std::vector<Aabb> boxes = {{-endless, -endless, -endless, endless, endless, endless},
                                     {big, big, big, endless, endless, endless},
                                     {endless, 0, 0, endless, endless, endless},
                                     {-endless, -1, -1, -big, -0.0f, 0},
                                     {-big, 0.0f, -0.0f, 1, 1, 1},
                                     {-1, -1, -1, 1, 1, -0.0f}};
    EXPECT_EQ(oracle(boxes), PairList(brute_pairs(boxes)));
    std::vector<Aabb> many = boxes;  // enough for CGAL to make trees of them
    while (many.size() < 1000)
        many.insert(many.end(), boxes.begin(), boxes.end());
    EXPECT_EQ(oracle(many), PairList(brute_pairs(many)));
}

TEST_P(OraclesOfPairs, HaveNoneOfABoxWithANan)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Aabb> boxes = {{0, 0, 0, 1, 1, 1}, {0, nan, 0, 1, nan, 1}, {1, 1, 1, 2, 2, 2}};
    EXPECT_EQ(oracle(boxes), PairList({{0, 2}}));
    boxes.assign(5, {nan, nan, nan, nan, nan, nan});
    EXPECT_EQ(oracle(boxes).size(), 0u);
}

TEST_P(OraclesOfPairs, OfSeveralSlabsAreThoseOfBruteForce)
{
    // Points, long and flat boxes, and copies: some overlap nearly all others.
    std::mt19937 random(5);
    std::vector<Aabb> boxes = lattice_boxes(10'000, 1, 1, 1, 1);
    for (std::size_t k = 0; k < boxes.size(); k += 1000)
        boxes[k] = {-20, -20, -20, 20, 20, 20};
    for (std::size_t k = 0; k < boxes.size(); k += 3)
        boxes[k].max_x = boxes[k].min_x + 1e-3f * static_cast<float>(random() % 100);
    const PairList pairs = oracle(boxes);
    EXPECT_EQ(pairs, PairList(brute_pairs(boxes)));
    EXPECT_EQ(pairs.surplus(), 0u);
    const std::vector<Aabb> equal(9000, {0, 0, 0, 1, 0, 0});
    EXPECT_EQ(oracle(equal).size(), 9000u * 8999u / 2);
}

TEST_P(OraclesOfPairs, DropPairsByVerticesAndByObjects)
{
    const std::vector<Aabb> boxes(4, {0, 0, 0, 1, 1, 1});
    const std::vector<Face> faces = {{0, 1, 2}, {2, 3, 4}, {5, 6, 7}, {7, 8, 0}};
    const std::vector<FaceRange> objects = {{0, 2}, {2, 2}};
    const auto wanted = [&](bool keep_adjacent, Among among) {
        return oracle(boxes, WantedPairs(faces, keep_adjacent, objects, among));
    };
    EXPECT_EQ(wanted(true, Among::all).size(), 6u);
    EXPECT_EQ(wanted(false, Among::all), PairList({{0, 2}, {1, 2}, {1, 3}}));
    EXPECT_EQ(wanted(true, Among::within_objects), PairList({{0, 1}, {2, 3}}));
    EXPECT_EQ(wanted(false, Among::between_objects), PairList({{0, 2}, {1, 2}, {1, 3}}));
    EXPECT_EQ(wanted(true, Among::between_objects).size(), 4u);
}

INSTANTIATE_TEST_SUITE_P(Of, OraclesOfPairs, testing::Values(swept_pairs, overlapping_pairs),
                         [](const auto& one) { return one.index == 0 ? "Sweep" : "Frames"; });

}  // namespace
}  // namespace bvhbench
