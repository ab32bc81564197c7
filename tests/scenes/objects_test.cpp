// SPDX-License-Identifier: MIT
#include "scenes/face_order.h"

#include "helpers.h"

namespace bvhbench {
namespace {

using SplitBy = InFolder;

// Two squares whose triangles alternate in the file, and another triangle of the first square at the end.
constexpr const char* interleaved =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 6 1 0\nv 5 1 0\nv 9 9 9\n"
    "f 1 2 3\nf 5 6 7\nf 1 3 4\nf 5 7 8\nf 4 3 9\n";

TEST_F(SplitBy, ComponentsGathersWhatTakesTurnsAndTellsWhereItCameFrom)
{
    const Scene before = loaded("a.obj", interleaved);
    ASSERT_EQ(before.objects.size(), 1u);
    EXPECT_TRUE(before.file_faces.empty());
    const Scene scene = with_objects(before, ObjectsBy::components);
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].face_count, 3u);
    EXPECT_EQ(scene.objects[1].first_face, 3u);
    EXPECT_EQ(scene.file_faces, (std::vector<uint>{0, 2, 4, 1, 3}));
    for (uint k = 0; k < 5; ++k) {
        EXPECT_EQ(scene.faces[k].a, before.faces[scene.file_faces[k]].a);
        EXPECT_EQ(scene.faces[k].c, before.faces[scene.file_faces[k]].c);
    }
    EXPECT_NE(scene.content_hash, before.content_hash);
    const Scene again = with_objects(scene, ObjectsBy::components);
    EXPECT_EQ(again.file_faces, scene.file_faces);
    EXPECT_EQ(again.content_hash, scene.content_hash);
}

TEST_F(SplitBy, ComponentsKeepsTheNumbersOfTheFileWhereTheOrderWasAnotherAlready)
{
    Scene before = loaded("a.obj", interleaved);
    before.file_faces = {10, 11, 12, 13, 14};
    EXPECT_EQ(with_objects(before, ObjectsBy::components).file_faces,
              (std::vector<uint>{10, 12, 14, 11, 13}));
}

TEST_F(SplitBy, ComponentsLeavesTheOrderWhereItCan)
{
    const Scene scene = with_objects(load_scene("n-body:3000:1", {}), ObjectsBy::components);
    EXPECT_EQ(scene.objects.size(), 305u);
    EXPECT_TRUE(scene.file_faces.empty());
    const Scene soup = with_objects(load_scene("soup:40", {}), ObjectsBy::components);
    EXPECT_EQ(soup.objects.size(), 40u);
}

TEST_F(SplitBy, OneMakesOneAndTheHashCoversIt)
{
    const Scene before = load_scene("n-body:1000:1", {});
    const Scene one = with_objects(before, ObjectsBy::one);
    ASSERT_EQ(one.objects.size(), 1u);
    EXPECT_EQ(one.objects[0].face_count, 1000u);
    EXPECT_NE(one.content_hash, before.content_hash);
    EXPECT_EQ(with_objects(one, ObjectsBy::components).content_hash, before.content_hash);
}

TEST_F(SplitBy, MeshNeedsMeshesThatAreNamed)
{
    const Scene named =
        loaded("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no left\nf 1 2 3\no right\nf 1 3 2\n");
    EXPECT_EQ(with_objects(named, ObjectsBy::mesh).objects.size(), 2u);
    EXPECT_EQ(with_objects(named, ObjectsBy::automatic).content_hash, named.content_hash);
    EXPECT_EQ(with_objects(named, ObjectsBy::components).objects.size(), 1u);
    const Scene nameless = loaded("a.obj", interleaved);
    EXPECT_EQ(with_objects(nameless, ObjectsBy::automatic).objects.size(), 1u);
    EXPECT_THROW(with_objects(nameless, ObjectsBy::mesh), BadUsage);
    EXPECT_THROW(with_objects(load_scene("torus:8", {}), ObjectsBy::mesh), BadUsage);
    EXPECT_THROW(with_objects(with_objects(named, ObjectsBy::one), ObjectsBy::mesh), BadUsage);
}

TEST_F(SplitBy, IsChosenByName)
{
    EXPECT_EQ(objects_by_called("auto"), ObjectsBy::automatic);
    EXPECT_EQ(objects_by_called("one"), ObjectsBy::one);
    EXPECT_EQ(objects_by_called("mesh"), ObjectsBy::mesh);
    EXPECT_EQ(objects_by_called("components"), ObjectsBy::components);
    EXPECT_THROW(objects_by_called("parts"), BadUsage);
}

TEST_F(SplitBy, GroupsAreThoseThatTheFileNames)
{
    const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    const std::string file = folder.file(
        "a.obj", points + "f 1 2 3\ng left wing\nf 1 2 3\ng body\nf 1 3 2\ng left wing\nf 3 2 1\n");
    const Scene scene = with_objects(load_scene(file, {}), ObjectsBy::groups);
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.objects[0].name, "default");
    EXPECT_EQ(scene.objects[1].name, "left wing");
    EXPECT_EQ(scene.objects[1].face_count, 2u);
    EXPECT_EQ(scene.file_faces, (std::vector<uint>{0, 1, 3, 2}));
    EXPECT_EQ(load_scene(file, {}).objects.size(), 1u);
    EXPECT_THROW(with_objects(loaded("b.obj", points + "f 1 2 3\n"), ObjectsBy::groups), BadUsage);
}

using Weld = InFolder;

TEST_F(Weld, JoinsVerticesThatAreInOnePlaceInEveryFrame)
{
    // Two triangles that share an edge in space; the corner behind is in one place in the first frame only.
    const auto frame = [](const char* last) {
        return std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv -0 1 0\nv 1 1 0\nv ") + last +
               "\nv 3 0 0\nv 3 1 0\nf 1 2 3\nf 4 6 5\nf 7 8 9\n";
    };
    folder.file("a1.obj", frame("1 1 0"));
    folder.file("a2.obj", frame("2 1 0"));
    SceneLibrary library;
    EXPECT_EQ(load_scene(folder.path().string(), library).objects.size(), 3u);
    library.weld = true;
    const Scene scene = load_scene(folder.path().string(), library);
    EXPECT_EQ(scene.objects.size(), 2u);  // connected parts, found again
    EXPECT_EQ(scene.reading.joined_vertices, 2u);
    EXPECT_EQ(scene.frames[1].size(), 7u);
    EXPECT_EQ(scene.frames[1][4].x, 2.0f);
    EXPECT_EQ(scene.facts->shared_edges, 1u);
    EXPECT_EQ(scene.facts->weldable_vertices, 0u);
}

}  // namespace
}  // namespace bvhbench
