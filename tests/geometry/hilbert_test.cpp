// SPDX-License-Identifier: MIT
#include "geometry/hilbert.h"

#include <gtest/gtest.h>

#include <vector>

namespace bvhbench {
namespace {

/// Steps between two cells along the axes.
uint distance(Cell a, Cell b)
{
    const auto apart = [](uint p, uint q) { return p < q ? q - p : p - q; };
    return apart(a.x, b.x) + apart(a.y, b.y) + apart(a.z, b.z);
}

/// The cells of a cube of 2^bits cells a side by their code; which cells were met twice is counted.
struct Curve {
    std::vector<Cell> cells;
    uint met_twice = 0;
};

Curve whole_curve(uint bits)
{
    const uint side = 1u << bits;
    Curve curve{std::vector<Cell>(std::size_t{side} * side * side), 0};
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

/// A cell that no test of 2^30 cells can reach, for the wide codes: eight cells that share all larger bits
/// are eight neighbours on the curve.
TEST(Hilbert, VisitsEveryOctantBeforeItLeavesIt)
{
    const Cell corner = {0x12344, 0x1edcba, 0x0f0f0e};
    const ulong first = hilbert_63(corner) / 8;
    for (uint octant = 0; octant < 8; ++octant)
        EXPECT_EQ(
            hilbert_63({corner.x + octant / 4, corner.y + octant / 2 % 2, corner.z + octant % 2}) /
                8,
            first);
    const Cell small = {0x1234, 0xfcba, 0x0f0e};
    for (uint octant = 0; octant < 8; ++octant)
        EXPECT_EQ(
            hilbert_48({small.x + octant / 4, small.y + octant / 2 % 2, small.z + octant % 2}) / 8,
            hilbert_48(small) / 8);
}

}  // namespace
}  // namespace bvhbench
