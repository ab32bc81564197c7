// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>

#include "helpers.h"

namespace bvhbench {
namespace {

bool same(Point a, Point b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

TEST(Outlier, MovesOneTriangleAlongItsNormalAndNothingElse)
{
    const Scene before = load_scene("grid:50", {});
    const Scene after = load_scene("outlier:grid:50:7:2.5", {});
    Aabb box = empty_box();
    for (const Face& face : before.faces)
        box = merged(box, face_box(before.frames[0], face));
    const double diagonal = std::hypot(box.max_x - box.min_x, box.max_y - box.min_y);
    ASSERT_EQ(after.triangle_count(), 50u);
    for (uint k = 0; k < 50; ++k) {
        const uint old_ids[] = {before.faces[k].a, before.faces[k].b, before.faces[k].c};
        const uint new_ids[] = {after.faces[k].a, after.faces[k].b, after.faces[k].c};
        for (int corner = 0; corner < 3; ++corner) {
            const Point was = before.frames[0][old_ids[corner]];
            const Point is = after.frames[0][new_ids[corner]];
            if (k != 7) {
                EXPECT_TRUE(same(is, was)) << "triangle " << k;
                continue;
            }
            EXPECT_EQ(is.x, was.x);  // a grid is flat: its normal is z
            EXPECT_EQ(is.y, was.y);
            EXPECT_NEAR(std::fabs(is.z), 2.5 * diagonal, 1e-6);
        }
    }
    EXPECT_EQ(after.outlier.of, "grid:50");
    EXPECT_EQ(after.outlier.triangle, 7u);
    EXPECT_EQ(after.outlier.diameters, 2.5);
    EXPECT_TRUE(before.outlier.of.empty());
}

TEST(Outlier, AtNoDistanceChangesNoTriangle)
{
    const Scene before = load_scene("soup:20", {});
    const Scene after = load_scene("outlier:soup:20:0:0", {});
    for (uint k = 0; k < 20; ++k) {
        const Aabb was = face_box(before.frames[0], before.faces[k]);
        const Aabb is = face_box(after.frames[0], after.faces[k]);
        EXPECT_EQ(std::memcmp(&was, &is, sizeof was), 0);
    }
}

TEST(Outlier, RefusesWhatIsNoTriangleOrDistance)
{
    for (const char* text : {"outlier:", "outlier:grid:5", "outlier:grid:5:x:1",
                             "outlier:grid:5:0:", "outlier:grid:5:-1:1", "outlier:grid:5:0:nan",
                             "outlier::0:1", "outlier:grid:5:0:1e30", "outlier:0:1"})
        EXPECT_TRUE(refusal(text).starts_with("BadUsage: ")) << text << ": " << refusal(text);
    EXPECT_TRUE(contains(refusal("outlier:grid:5:5:1"), "has no triangle 5 to move, but 5"));
}

}  // namespace
}  // namespace bvhbench
