// SPDX-License-Identifier: MIT
#include "builders/orders.h"

#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <vector>

#include "builders/ordered/leaf_order.h"
#include "geometry/error.h"
#include "scenes/catalog.h"

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
    try {
        find_order("spiral");
        FAIL();
    } catch (const BadUsage& error) {
        std::string expected = "no order is called 'spiral'; there are:";
        for (const OrderEntry& order : order_catalog())
            expected += (&order == &order_catalog().front() ? " " : ", ") + std::string(order.name);
        EXPECT_EQ(error.what(), expected);
    }
}

double area(Aabb box)
{
    const double x = double{box.max_x} - box.min_x;
    const double y = double{box.max_y} - box.min_y;
    const double z = double{box.max_z} - box.min_z;
    return 2 * (x * y + y * z + z * x);
}

/// Returns Eq. 1 of [Aila2013] for the tree over leaves in this order: cost 1.2 per inner node, 1 per triangle.
double sah(const std::vector<Aabb>& boxes, const std::vector<uint>& ids)
{
    std::vector<Aabb> level;
    for (const uint id : ids)
        level.push_back(boxes[id]);
    double sum = 0;
    for (const Aabb& box : level)
        sum += area(box);
    while (level.size() > 1) {
        std::vector<Aabb> above;
        for (std::size_t k = 0; k < level.size(); k += 2)
            above.push_back(k + 1 < level.size() ? merged(level[k], level[k + 1]) : level[k]);
        for (const Aabb& box : above)
            sum += 1.2 * area(box);
        level = std::move(above);
    }
    return sum / area(level.front());
}

/// Purpose of the orders: the same tree without pointers has a lower cost over leaves in a better order.
TEST(OrderQuality, HilbertBeatsMortonAndMediansBeatBoth)
{
    const Scene scene = load_scene("torus:60000", {});
    const auto of_order = [&](const char* name) {
        const HostLeafOrder order = host_leaf_order(face_boxes(scene.frames[0], scene.faces), name);
        return sah(order.boxes, order.ids);
    };
    const double morton = of_order("morton30");
    const double hilbert = of_order("hilbert30");
    const double blocks = of_order("hilbert30+kd1024");
    const double medians = of_order("kd");
    std::cout << "SAH: morton30 " << morton << ", hilbert30 " << hilbert << ", hilbert30+kd1024 "
              << blocks << ", medians everywhere " << medians << '\n';
    EXPECT_LT(hilbert, morton);
    EXPECT_LT(blocks, hilbert);
    EXPECT_LT(medians, blocks);
}

}  // namespace
}  // namespace bvhbench
