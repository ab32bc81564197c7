// SPDX-License-Identifier: MIT
//
// Scenes derived from another scene: refine, outlier, bend.
#include <cmath>
#include <map>

#include "helpers.h"
#include "scenes/facts.h"

namespace bvhbench {
namespace {

double area(const Scene& scene, const SceneObject& object, std::size_t frame = 0)
{
    double sum = 0;
    for (uint k = object.first_face; k < object.first_face + object.face_count; ++k) {
        const auto& points = scene.frames[frame];
        const Point a = points[scene.faces[k].a], b = points[scene.faces[k].b],
                    c = points[scene.faces[k].c];
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
        sum += 0.5 * std::hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
    }
    return sum;
}

/// Returns the number of triangle sides without a triangle on the other side.
std::size_t open_sides(const std::string& name)
{
    return mesh_facts(load_scene(name, {}), 1).open_edges;
}

using Refine = InFolder;

TEST_F(Refine, GivesExactlyTheTrianglesAskedFor)
{
    for (const std::string base : {"sphere:20", "torus:7", "soup:3", "grid:1"}) {
        const uint least = load_scene(base, {}).triangle_count();
        for (uint count = least; count < least + 100; ++count)
            EXPECT_EQ(
                load_scene("refine:" + base + ":" + std::to_string(count), {}).triangle_count(),
                count);
    }
}

TEST_F(Refine, CutsLongestEdgesFirst)
{
    const auto longest = [](const char* name) {
        return mesh_facts(load_scene(name, {}), 1).longest_edge;
    };
    EXPECT_LT(longest("refine:soup:100:3000"), longest("soup:100") / 3);
}

TEST_F(Refine, LeavesAClosedSurfaceClosedOrOneVertexOnASide)
{
    for (const uint count : {102u, 1000u, 5000u})
        EXPECT_EQ(open_sides("refine:sphere:100:" + std::to_string(count)), 0u);
    EXPECT_EQ(open_sides("refine:sphere:100:1001"), 3u);  // a long side, two halves
}

TEST_F(Refine, CutsTrianglesOfTheSameCornersAlike)
{
    // Two tetrahedra in the same place, with shared vertices: every edge has four triangles.
    const std::string twice =
        folder.file("twice.obj",
                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"
                    "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
    EXPECT_EQ(open_sides("refine:" + twice + ":1000"), 0u);
    std::map<std::set<uint>, int> uses;
    for (const Face& face : load_scene("refine:" + twice + ":1000", {}).faces)
        ++uses[{face.a, face.b, face.c}];
    for (const auto& [corners, count] : uses)
        ASSERT_EQ(count, 2);
}

TEST_F(Refine, EndsOnTrianglesWithoutLength)
{
    const std::string point =
        folder.file("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\nf 1 1 1\nf 1 2 1\n");
    EXPECT_EQ(load_scene("refine:" + point + ":64", {}).triangle_count(), 64u);
    const std::string needle = folder.file("needle.obj", "v 0 0 0\nv 3e38 0 0\nf 1 2 1\nf 1 2 2\n");
    EXPECT_EQ(load_scene("refine:" + needle + ":64", {}).triangle_count(), 64u);
}

TEST_F(Refine, KeepsObjectsTogether)
{
    const std::string two = folder.file("two.obj",
                                        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 9 0 0\nv 5 4 0\n"
                                        "o small\nf 1 2 3\no large\nf 4 5 6\n");
    const Scene fine = load_scene("refine:" + two + ":100", {});
    ASSERT_EQ(fine.objects.size(), 2u);
    EXPECT_EQ(fine.objects[0].name, "small");
    EXPECT_NEAR(area(fine, fine.objects[0]), 0.5, 1e-6);
    EXPECT_NEAR(area(fine, fine.objects[1]), 8.0, 1e-6);
    EXPECT_GT(fine.objects[1].face_count, fine.objects[0].face_count);
}

TEST_F(Refine, CutsAllFramesAlike)
{
    folder.file("fall/f1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.file("fall/f2.obj", "v 0 0 5\nv 2 0 5\nv 0 1 5\nf 1 2 3\n");
    const Scene fine = load_scene("refine:" + (folder.path() / "fall").string() + ":50", {});
    ASSERT_EQ(fine.frames.size(), 2u);
    EXPECT_NEAR(area(fine, fine.objects[0], 0), 0.5, 1e-6);
    EXPECT_NEAR(area(fine, fine.objects[0], 1), 1.0, 1e-6);
}

TEST_F(Refine, TakesNoTrianglesAway)
{
    EXPECT_TRUE(refuses("refine:torus:100:99", "BadUsage: 'torus:100' has 100 triangles already"));
    EXPECT_TRUE(refuses("refine:100", "BadUsage: scene 'refine:100' is not of the form"));
    EXPECT_TRUE(refuses("refine:torus:0:99", "BadUsage: scene 'torus:0' ends in '0'"));
}

bool same(Point a, Point b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

TEST(Outlier, MovesOneTriangleAlongItsNormalAndNothingElse)
{
    const Scene before = load_scene("grid:50", {});
    const Scene after = load_scene("outlier:grid:50:7:2.5", {});
    const Aabb box = box_around(before.frames[0], before.faces);
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
            EXPECT_EQ(is.x, was.x);  // the grid is flat, with normal z
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
    EXPECT_TRUE(refuses("outlier:grid:5:5:1", "has no triangle 5 to move, but 5"));
}

TEST(Bend, AddsAFrameInWhichEveryPointIsWhereTheFormulaSays)
{
    for (const std::string name : {"soup:50", "grid:800"}) {  // the grid is flat in z
        const Scene before = load_scene(name, {});
        const Scene after = load_scene("bend:" + name, {});
        ASSERT_EQ(after.frames.size(), 2u);
        const Aabb box = box_around(before.frames[0], before.faces);
        const double sides[] = {box.max_x - box.min_x, box.max_y - box.min_y,
                                box.max_z - box.min_z};
        const double reach = std::max({sides[0], sides[1], sides[2]}) / 32;
        const auto b = [](double along, double side) {
            const double t = side > 0 ? along / side : 0;
            return 4 * t * (1 - t);
        };
        for (std::size_t k = 0; k < before.frames[0].size(); ++k) {
            const Point was = before.frames[0][k];
            const Point is = after.frames[1][k];
            EXPECT_EQ(after.frames[0][k].x, was.x);
            EXPECT_NEAR(is.x - was.x, reach * b(was.y - box.min_y, sides[1]), 1e-6);
            EXPECT_NEAR(is.y - was.y, reach * b(was.z - box.min_z, sides[2]), 1e-6);
            EXPECT_NEAR(is.z - was.z, reach * b(was.x - box.min_x, sides[0]), 1e-6);
        }
        EXPECT_EQ(after.bend_of, name);
        EXPECT_TRUE(before.bend_of.empty());
    }
}

TEST(Bend, RefusesWhatMovesAlready)
{
    EXPECT_EQ(refusal("bend:bend:soup:5"),
              "BadUsage: scene 'bend:soup:5' has 2 frames and needs no other");
    EXPECT_TRUE(refusal("bend:").starts_with("BadUsage: "));
}

}  // namespace
}  // namespace bvhbench
