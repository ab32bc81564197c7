// SPDX-License-Identifier: MIT

#include "helpers.h"
#include "scenes/generate/generators.h"
#include "scenes/motion.h"

namespace bvhbench {
namespace {

TEST(Worlds, AreObjectsOfABoxForEachBody)
{
    for (const uint worlds : {1u, 2u, 5u})
        for (const uint bodies : {1u, 2u, 3u, 4u, 60u, 333u}) {
            const std::string name =
                "worlds:" + std::to_string(worlds) + ":" + std::to_string(bodies);
            const Scene scene = load_scene(name, {});
            EXPECT_EQ(triangles_in_name(name), worlds * bodies);
            ASSERT_EQ(scene.objects.size(), worlds);
            EXPECT_EQ(scene.triangle_count(), worlds * bodies);
            EXPECT_EQ(scene.frames.size(), 1u);
            EXPECT_TRUE(scene.has_meshes);
            for (const SceneObject& object : scene.objects)
                EXPECT_EQ(object.face_count, bodies);
            for (const Face& face : scene.faces) {
                const Point low = scene.frames[0][face.a], high = scene.frames[0][face.b];
                EXPECT_EQ(face.b, face.c);
                EXPECT_TRUE(low.x < high.x && low.y < high.y && low.z < high.z);
            }
        }
}

TEST(Worlds, StandApart) { EXPECT_EQ(overlapping_objects(load_scene("worlds:6:200", {}), 0), 0u); }

TEST(Worlds, HaveAFloorBelowARobotAndPiles)
{
    const Scene scene = load_scene("worlds:3:500", {});
    for (std::size_t world = 0; world < 3; ++world) {
        const std::vector<Aabb> boxes =
            face_boxes(scene.frames[0], std::span(scene.faces).subspan(500 * world, 500));
        std::size_t pairs = 0;
        for (std::size_t k = 1; k < boxes.size(); ++k) {
            EXPECT_LE(boxes[0].min_x, boxes[k].min_x);
            EXPECT_GE(boxes[0].max_x, boxes[k].max_x);
            EXPECT_LT(boxes[0].min_y, boxes[k].min_y);
            EXPECT_TRUE(boxes[k].min_y < 0 || overlap(boxes[k], boxes[k - 1]))
                << k;  // rests on the floor or on a box, or is a link
            for (std::size_t other = 0; other < k; ++other)
                pairs += overlap(boxes[k], boxes[other]) ? 1 : 0;
        }
        EXPECT_GT(pairs, boxes.size());
        EXPECT_LT(pairs, 4 * boxes.size());
    }
}

TEST(Worlds, MoveSomeBodiesOfTheirFrames)
{
    const Scene scene = load_scene("worlds:2:400:4", {}), two = load_scene("worlds:2:400:2", {});
    ASSERT_EQ(scene.frames.size(), 4u);
    for (const std::size_t frame : {0, 1})
        EXPECT_TRUE(same_points(two.frames[frame], scene.frames[2 * frame + 1]));
    std::size_t moved = 0;
    for (std::size_t k = 0; k < scene.frames[0].size(); ++k)
        moved += scene.frames[0][k].x != scene.frames[3][k].x ? 1 : 0;
    EXPECT_GT(moved, scene.frames[0].size() / 20);
    EXPECT_LT(moved, scene.frames[0].size() / 3);
    EXPECT_NE(scene.content_hash, load_scene("worlds:2:401:4", {}).content_hash);
}

TEST(Bodies, TouchTheirNeighboursAndATenthMoves)
{
    const Scene scene = load_scene("bodies:64:20:4", {});
    ASSERT_EQ(scene.objects.size(), 64u);
    ASSERT_EQ(scene.triangle_count(), 64u * 20u);
    ASSERT_EQ(scene.frames.size(), 4u);
    const auto whole = [&](std::size_t body) { return object_box(scene, 0, body); };
    for (const std::size_t neighbour : {22, 25, 37})  // one step, one row and one layer further
        EXPECT_TRUE(overlap(whole(21), whole(neighbour)));
    EXPECT_FALSE(overlap(whole(21), whole(23)));
    const std::vector<Motion> motions = object_motions(scene, 2, 3);
    for (std::size_t body = 0; body < 64; ++body)
        EXPECT_EQ(motions[body] == Motion::unchanged, body % 10 != 0) << body;
}

TEST(Worlds, AreNamedByTwoCounts)
{
    EXPECT_EQ(load_scene("worlds:2:1e2", {}).name, "worlds:2:100");
    for (const std::string bad : {"", "x:3", "0:3", "-1:3"})
        EXPECT_TRUE(refuses("worlds:" + bad, "where a number of objects from 1 to"));
    for (const std::string bad : {"3", "3:", "3:x", "3:0"})
        EXPECT_TRUE(refuses("worlds:" + bad, "where a number of triangles an object"));
    for (const std::string bad : {"", "0", "1001", "4:4"})
        EXPECT_TRUE(refuses("worlds:2:3:" + bad, "where a number of frames from 1 to"));
    EXPECT_TRUE(refuses("worlds:65536:65536", "has more than 268435456 triangles"));
}

}  // namespace
}  // namespace bvhbench
