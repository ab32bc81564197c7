// SPDX-License-Identifier: MIT
#include "builders/orders.h"

#include <vector>

#include "tests/refusal.h"

namespace bvhbench {
namespace {

Aabb point_box(float x, float y, float z) { return {x, y, z, x, y, z}; }

/// Returns the bounds of a box that is a point: the scene is the box of the centres.
Bounds bounds_of(Aabb box) { return {box, box}; }

std::vector<OrderEntry> orders_with_codes()
{
    std::vector<OrderEntry> orders;
    for (const OrderEntry& order : order_catalog())
        if (order.code_bits > 0)
            orders.push_back(order);
    return orders;
}

TEST(Morton, CutsTheLongestSideIntoCellsAndGivesTheOthersTheSame)
{
    const Bounds bounds = bounds_of({0, 0, 0, 1024, 512, 0});
    const auto code = [](Aabb box, Bounds over) { return find_order("morton30").code(box, over); };
    EXPECT_EQ(code(point_box(0, 0, 0), bounds), 0u);
    EXPECT_EQ(code(point_box(1, 0, 0), bounds), 4u);
    EXPECT_EQ(code(point_box(0, 1, 0), bounds), 2u);
    EXPECT_EQ(code(point_box(3, 1.5f, 0), bounds), 0b100110u);
    EXPECT_EQ(code(point_box(1024, 512, 0), bounds), code(point_box(1023, 512, 0), bounds));
    EXPECT_EQ(code(point_box(512, 0, 0), bounds), ulong{1} << 29);
    EXPECT_EQ(find_order("morton48").code(point_box(512, 0, 0), bounds), ulong{1} << 47);
    EXPECT_EQ(find_order("morton63").code(point_box(512, 0, 0), bounds), ulong{1} << 62);
}

TEST(Orders, TellApartAtBothEndsOfTheFloats)
{
    for (const OrderEntry& order : orders_with_codes())
        for (const float side : {6e-45f, 1e-41f, 1e-30f, 1.0f, 1.7e38f, 3.4e38f}) {
            SCOPED_TRACE(std::string(order.name) + " " + std::to_string(side));
            const Bounds bounds = bounds_of({-side, 0, 0, side, 0, 0});
            EXPECT_EQ(order.code(point_box(-side, 0, 0), bounds), 0u);
            EXPECT_LT(order.code(point_box(-side, 0, 0), bounds),
                      order.code(point_box(0, 0, 0), bounds));
            EXPECT_LT(order.code(point_box(0, 0, 0), bounds),
                      order.code(point_box(side, 0, 0), bounds));
        }
}

/// Cells with more bits lie within cells with fewer bits, including the last cell, which also holds points on the upper end.
TEST(Orders, OfMoreBitsGoOnWhereThoseOfFewerEnd)
{
    const Bounds bounds = {{-1, -2, -3, 9, 8, 7}, {0, 0, 0, 8, 7, 6}};
    for (const std::string suffix : {"", "-axis"})
        for (const Aabb box : {point_box(0, 0, 0), point_box(3.3f, 6.1f, 0.7f),
                               point_box(7.99f, 0.01f, 5.5f), point_box(8, 7, 6)}) {
            const auto code = [&](const char* name) {
                return find_order(name + suffix).code(box, bounds);
            };
            EXPECT_EQ(code("morton48") >> 18, code("morton30"));
            EXPECT_EQ(code("morton63") >> 15, code("morton48"));
            EXPECT_LT(code("hilbert48"), ulong{1} << 48);
            EXPECT_EQ(find_order("hilbert30").code(box, bounds) >> 6,
                      find_order("hilbert24").code(box, bounds));
        }
}

TEST(Orders, AreZeroWhereAllCentresCoincide)
{
    for (const OrderEntry& order : orders_with_codes())
        EXPECT_EQ(order.code(point_box(3, 4, 5), bounds_of(point_box(3, 4, 5))), 0u);
}

TEST(Orders, OnTheStretchedGridCutEveryAxisOfTheSceneAlike)
{
    const auto code = [](Aabb box, Bounds over) {
        return find_order("morton30-axis").code(box, over);
    };
    const Bounds bounds = {{0, 0, 0, 1024, 512, 0}, {500, 250, 0, 501, 251, 0}};
    EXPECT_EQ(code(point_box(1, 0, 0), bounds), 4u);
    EXPECT_EQ(code(point_box(0, 0.5f, 0), bounds), 2u);
    EXPECT_EQ(code(point_box(512, 256, 0), bounds), 3u << 28);
    EXPECT_EQ(code(point_box(1024, 512, 0), bounds), code(point_box(1023, 511.5f, 0), bounds));
}

TEST(Orders, NamesThoseThereAreWhenAskedForAnother)
{
    std::string expected = "no order is called 'spiral'; there are:";
    for (const OrderEntry& order : order_catalog())
        expected += (&order == &order_catalog().front() ? " " : ", ") + std::string(order.name);
    EXPECT_EQ(refusal_of<BadUsage>([] { find_order("spiral"); }), expected);
}

}  // namespace
}  // namespace bvhbench
