// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "geometry/aabb.h"
#include "geometry/bits.h"
#include "geometry/hash.h"
#include "geometry/mesh.h"

namespace bvhbench {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(Bits, LogarithmsAreExactWhereFloatsAreNot)
{
    for (uint power = 0; power < 32; ++power) {
        EXPECT_EQ(floor_log2(1u << power), power);
        EXPECT_EQ(ceil_log2(1u << power), power);
        if (power > 1) {
            EXPECT_EQ(floor_log2((1u << power) - 1), power - 1);
            EXPECT_EQ(ceil_log2((1u << power) - 1), power);
            EXPECT_EQ(ceil_log2((1u << (power - 1)) + 1), power);
        }
    }
}

TEST(Bits, DividingUpDoesNotOverflow)
{
    EXPECT_EQ(divided_up(0, 4), 0u);
    EXPECT_EQ(divided_up(1, 4), 1u);
    EXPECT_EQ(divided_up(8, 4), 2u);
    EXPECT_EQ(divided_up(0xffffffffu, 2), 0x80000000u);
}

TEST(Aabb, MinimumAndMaximumPreferNumbersToNaN)
{
    EXPECT_EQ(bvhbench::fmin(nan, 1.0f), 1.0f);
    EXPECT_EQ(bvhbench::fmin(1.0f, nan), 1.0f);
    EXPECT_EQ(bvhbench::fmax(nan, 1.0f), 1.0f);
    EXPECT_EQ(bvhbench::fmax(1.0f, nan), 1.0f);
}

TEST(Aabb, TheEmptyBoxChangesNoBitOfAUnion)
{
    const float largest = std::numeric_limits<float>::max();
    const float tiny = std::numeric_limits<float>::denorm_min();
    for (const Aabb box : {Aabb{0, 0, 0, 0, 0, 0}, Aabb{-largest, -tiny, 1, largest, tiny, 2},
                           Aabb{largest, largest, largest, largest, largest, largest}}) {
        const Aabb left = merged(empty_box(), box), right = merged(box, empty_box());
        EXPECT_EQ(std::memcmp(&left, &box, sizeof box), 0);
        EXPECT_EQ(std::memcmp(&right, &box, sizeof box), 0);
    }
}

TEST(Aabb, TouchingBoxesOverlapAndOnesAnUlpApartDoNot)
{
    const Aabb a = {0, 0, 0, 1, 1, 1};
    EXPECT_TRUE(overlap(a, {1, 1, 1, 2, 2, 2}));
    EXPECT_FALSE(overlap(a, {std::nextafter(1.0f, 2.0f), 0, 0, 2, 2, 2}));
    EXPECT_FALSE(overlap({0, 0, std::nextafter(1.0f, 2.0f), 2, 2, 2}, a));
}

TEST(Triangle, BoxHasNoNegativeZero)
{
    const Aabb box = triangle_box({-0.0f, -0.0f, 1}, {0.0f, -0.0f, -0.0f}, {-0.0f, -1, 0.0f});
    for (const float value : {box.min_x, box.max_x, box.max_y, box.min_z})
        EXPECT_FALSE(std::signbit(value)) << value;
    EXPECT_EQ(box.min_y, -1.0f);
    EXPECT_EQ(box.max_z, 1.0f);
}

TEST(Hash, IsFnv1a)
{
    Hash hash;
    EXPECT_EQ(hash.get(), 1469598103934665603u);
    hash.bytes("a", 1);
    EXPECT_EQ(hash.get(), (1469598103934665603u ^ 'a') * 1099511628211u);
    Hash in_two;
    in_two.bytes("bv", 2);
    in_two.bytes("h", 1);
    Hash at_once;
    at_once.bytes("bvh", 3);
    EXPECT_EQ(in_two.get(), at_once.get());
}

TEST(Hash, IsWrittenAsSixteenDigits)
{
    EXPECT_EQ(hex(0), "0000000000000000");
    EXPECT_EQ(hex(0x00ab54a98ceb1f0aull), "00ab54a98ceb1f0a");
}

}  // namespace
}  // namespace bvhbench
