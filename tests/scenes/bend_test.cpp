// SPDX-License-Identifier: MIT
#include <cmath>

#include "helpers.h"

namespace bvhbench {
namespace {

TEST(Bend, AddsAFrameInWhichEveryPointIsWhereTheFormulaSays)
{
    const Scene before = load_scene("soup:50", {});
    const Scene after = load_scene("bend:soup:50", {});
    ASSERT_EQ(after.frames.size(), 2u);
    Aabb box = empty_box();
    for (const Point& point : before.frames[0])
        box = merged(box, {point.x, point.y, point.z, point.x, point.y, point.z});
    const double sides[] = {box.max_x - box.min_x, box.max_y - box.min_y, box.max_z - box.min_z};
    const double reach = std::max({sides[0], sides[1], sides[2]}) / 32;
    const auto b = [](double t) { return 4 * t * (1 - t); };
    for (std::size_t k = 0; k < before.frames[0].size(); ++k) {
        const Point was = before.frames[0][k];
        const Point is = after.frames[1][k];
        EXPECT_EQ(after.frames[0][k].x, was.x);
        EXPECT_NEAR(is.x - was.x, reach * b((was.y - box.min_y) / sides[1]), 1e-6);
        EXPECT_NEAR(is.y - was.y, reach * b((was.z - box.min_z) / sides[2]), 1e-6);
        EXPECT_NEAR(is.z - was.z, reach * b((was.x - box.min_x) / sides[0]), 1e-6);
    }
    EXPECT_EQ(after.bend_of, "soup:50");
    EXPECT_TRUE(before.bend_of.empty());
}

TEST(Bend, LeavesAFlatSheetsEdgesInPlaceAndLiftsItsMiddle)
{
    const Scene sheet = load_scene("bend:grid:800", {});
    float highest = 0;
    for (std::size_t k = 0; k < sheet.frames[0].size(); ++k) {
        const Point was = sheet.frames[0][k];
        const Point is = sheet.frames[1][k];
        EXPECT_EQ(is.y, was.y);  // it is flat in z, so nothing moves along y
        if (was.x == 0 || was.x == 1) {
            EXPECT_EQ(is.z, was.z);
        }
        highest = std::max(highest, is.z);
    }
    EXPECT_NEAR(highest, 1.0 / 32, 1e-3);
}

TEST(Bend, IsTheSameEachTimeAndAnotherSceneThanTheOneItBends)
{
    EXPECT_EQ(load_scene("bend:soup:50", {}).content_hash,
              load_scene("bend:soup:50", {}).content_hash);
    EXPECT_NE(load_scene("bend:soup:50", {}).content_hash, load_scene("soup:50", {}).content_hash);
}

TEST(Bend, RefusesWhatMovesAlready)
{
    EXPECT_EQ(refusal("bend:bend:soup:5"),
              "BadUsage: scene 'bend:soup:5' has 2 frames and needs no other");
    EXPECT_TRUE(refusal("bend:").starts_with("BadUsage: "));
}

}  // namespace
}  // namespace bvhbench
