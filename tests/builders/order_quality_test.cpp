// SPDX-License-Identifier: MIT
//
// What orders are for: the same tree without pointers, over leaves in another order, costs less.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "builders/ordered/leaf_order.h"

namespace bvhbench {
namespace {

/// A torus of 2 * around * across triangles.
Mesh torus(uint around, uint across)
{
    Mesh mesh;
    const auto at = [&](uint u, uint v) { return u % around * across + v % across; };
    for (uint u = 0; u < around; ++u)
        for (uint v = 0; v < across; ++v) {
            const double a = 2 * std::numbers::pi * u / around;
            const double b = 2 * std::numbers::pi * v / across;
            const double r = 1 + 0.3 * std::cos(b);
            mesh.points.push_back({static_cast<float>(r * std::cos(a)),
                                   static_cast<float>(r * std::sin(a)),
                                   static_cast<float>(0.3 * std::sin(b))});
            mesh.faces.push_back({at(u, v), at(u + 1, v), at(u, v + 1)});
            mesh.faces.push_back({at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)});
        }
    return mesh;
}

double area(Aabb box)
{
    const double x = double{box.max_x} - box.min_x;
    const double y = double{box.max_y} - box.min_y;
    const double z = double{box.max_z} - box.min_z;
    return 2 * (x * y + y * z + z * x);
}

/// Eq. 1 of [Aila2013] for the tree over leaves in this order: 1.2 an inner node, 1 a triangle.
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

TEST(OrderQuality, HilbertBeatsMortonAndMediansBeatBoth)
{
    const Mesh mesh = torus(300, 100);
    const auto of_order = [&](const char* name) {
        const HostLeafOrder order = host_leaf_order(face_boxes(mesh.points, mesh.faces), name);
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
