// SPDX-License-Identifier: MIT
#include "builders/orders.h"

#include <gtest/gtest.h>

#include <string>

#include "geometry/error.h"

namespace bvhbench {
namespace {

Aabb point_box(float x, float y, float z) { return {x, y, z, x, y, z}; }

TEST(Morton, CutsTheLongestSideIntoCellsAndGivesTheOthersTheSame)
{
    const auto code = find_order("morton30").code;
    const Aabb centres = {0, 0, 0, 1024, 512, 0};
    EXPECT_EQ(code(point_box(0, 0, 0), centres), 0u);
    EXPECT_EQ(code(point_box(1, 0, 0), centres), 4u);
    EXPECT_EQ(code(point_box(0, 1, 0), centres), 2u);
    EXPECT_EQ(code(point_box(3, 1.5f, 0), centres), 0b100110u);
    EXPECT_EQ(code(point_box(1024, 512, 0), centres), code(point_box(1023, 512, 0), centres));
    EXPECT_EQ(code(point_box(512, 0, 0), centres), ulong{1} << 29);
    EXPECT_EQ(find_order("morton63").code(point_box(512, 0, 0), centres), ulong{1} << 62);
}

TEST(Morton, TellsApartAtBothEndsOfTheFloats)
{
    for (const OrderEntry& order : order_catalog())
        for (const float side : {6e-45f, 1e-41f, 1e-30f, 1.0f, 1.7e38f, 3.4e38f}) {
            SCOPED_TRACE(std::string(order.name) + " " + std::to_string(side));
            const Aabb centres = {-side, 0, 0, side, 0, 0};
            EXPECT_EQ(order.code(point_box(-side, 0, 0), centres), 0u);
            EXPECT_LT(order.code(point_box(-side, 0, 0), centres),
                      order.code(point_box(0, 0, 0), centres));
            EXPECT_LT(order.code(point_box(0, 0, 0), centres),
                      order.code(point_box(side, 0, 0), centres));
        }
}

TEST(Morton, IsZeroWhereAllCentresCoincide)
{
    for (const OrderEntry& order : order_catalog())
        EXPECT_EQ(order.code(point_box(3, 4, 5), point_box(3, 4, 5)), 0u);
}

TEST(Orders, NamesThoseThereAreWhenAskedForAnother)
{
    try {
        find_order("spiral");
        FAIL();
    } catch (const BadUsage& error) {
        EXPECT_STREQ(error.what(), "no order is called 'spiral'; there are: morton30, morton63");
    }
}

}  // namespace
}  // namespace bvhbench
