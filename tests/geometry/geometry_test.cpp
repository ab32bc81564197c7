// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "geometry/aabb.h"
#include "geometry/bits.h"
#include "geometry/hash.h"
#include "geometry/hilbert.h"
#include "geometry/hilbert_steps.h"
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

/// Returns the Manhattan distance of two cells.
uint distance(GridCell a, GridCell b)
{
    const auto apart = [](uint p, uint q) { return p < q ? q - p : p - q; };
    return apart(a.x, b.x) + apart(a.y, b.y) + apart(a.z, b.z);
}

/// The cells of a cube with 2^bits cells per side, indexed by their code, and the number of codes that occur twice.
struct Curve {
    std::vector<GridCell> cells;
    uint met_twice = 0;
};

Curve whole_curve(uint bits)
{
    const uint side = 1u << bits;
    Curve curve{std::vector<GridCell>(std::size_t{side} * side * side), 0};
    std::vector<bool> met(curve.cells.size());
    for (uint x = 0; x < side; ++x)
        for (uint y = 0; y < side; ++y)
            for (uint z = 0; z < side; ++z) {
                const uint code = morton_30(hilbert_cell({x, y, z}, bits));
                curve.met_twice += met.at(code) ? 1 : 0;
                met[code] = true;
                curve.cells[code] = {x, y, z};
            }
    return curve;
}

TEST(Hilbert, NumbersEveryCellOnceAndNeighboursOneAfterTheOther)
{
    for (uint bits = 1; bits <= 6; ++bits) {
        const Curve curve = whole_curve(bits);
        EXPECT_EQ(curve.met_twice, 0u) << bits;
        for (std::size_t k = 1; k < curve.cells.size(); ++k)
            ASSERT_EQ(distance(curve.cells[k - 1], curve.cells[k]), 1u) << bits << " bits, " << k;
    }
}

TEST(Hilbert, StartsInOneCornerAndEndsAlongX)
{
    for (uint bits = 1; bits <= 6; ++bits) {
        const Curve curve = whole_curve(bits);
        EXPECT_EQ(distance(curve.cells.front(), {0, 0, 0}), 0u);
        EXPECT_EQ(distance(curve.cells.back(), {(1u << bits) - 1, 0, 0}), 0u);
    }
}

/// Returns the code as builders/stages/code_by_table.clh computes it.
ulong code_by_steps(GridCell cell, uint bits)
{
    const ulong octants = morton_63(cell);
    ulong code = 0;
    uint steps = hilbert_first_state(bits) << 6;
    for (uint pair = divided_up(bits, 2u); pair > 0; --pair) {
        steps = hilbert_two_steps(steps >> 6, octants >> 6 * (pair - 1) & 63);
        code = code << 6 | (steps & 63);
    }
    return code;
}

TEST(Hilbert, StepsGiveTheSameCodesAsTurns)
{
    std::mt19937 random(1);
    for (uint bits = 1; bits <= 21; ++bits) {
        const uint last = (1u << bits) - 1;
        for (int k = 0; k < 20'000; ++k) {
            const auto x = static_cast<uint>(random()), y = static_cast<uint>(random());
            const GridCell cell = {x & last, y & last, static_cast<uint>(random()) & last};
            ASSERT_EQ(code_by_steps(cell, bits), morton_63(hilbert_cell(cell, bits))) << bits;
        }
    }
}

/// Tests the wide codes at a cell beyond the range of 30-bit tests: eight cells that share all higher bits are eight
/// consecutive cells of the curve.
TEST(Hilbert, VisitsEveryOctantBeforeItLeavesIt)
{
    const GridCell corner = {0x12344, 0x1edcba, 0x0f0f0e};
    const ulong first = hilbert_63(corner) / 8;
    for (uint octant = 0; octant < 8; ++octant)
        EXPECT_EQ(
            hilbert_63({corner.x + octant / 4, corner.y + octant / 2 % 2, corner.z + octant % 2}) /
                8,
            first);
    const GridCell small = {0x1234, 0xfcba, 0x0f0e};
    for (uint octant = 0; octant < 8; ++octant)
        EXPECT_EQ(
            hilbert_48({small.x + octant / 4, small.y + octant / 2 % 2, small.z + octant % 2}) / 8,
            hilbert_48(small) / 8);
}

}  // namespace
}  // namespace bvhbench
