// SPDX-License-Identifier: MIT
//
// A scene's pairs and contacts are those of one array with all points where the scene has them.
#include "collide/narrow/narrow.h"
#include "tests/library/testing.h"

namespace bvhbench {
namespace {

PairList contacts_of(const LibraryMesh& mesh, bool adjacent = true)
{
    const Mesh own = mesh.mesh();
    return chosen(swept_pairs(mesh, adjacent),
                  [&](Pair pair) { return triangles_meet(own.points, own.faces, pair, adjacent); });
}

class LibraryScene : public OfACaller {
protected:
    LibraryScene()
    {
        for (std::uint32_t k = 0; k < parts.size(); ++k)
            EXPECT_EQ(scene.add(parts[k].on_host()), k);
    }

    /// Expects pairs and contacts to be those of `objects`, between objects and in all.
    void expect_right()
    {
        oibvh::Tree& tree = scene.tree();
        EXPECT_EQ(found_pairs(tree, caller), swept_pairs(objects.mesh));
        EXPECT_EQ(found_pairs(tree, caller, oibvh::Among::between_objects),
                  objects.right(Among::between_objects));
        EXPECT_EQ(listed(tree, caller, tree.find_contacts()), contacts_of(objects.mesh));
    }

    /// Puts an object of `objects` into a pose, as the kernel does.
    void place_by_hand(std::size_t object, const oibvh::Pose& pose)
    {
        const FaceRange range = objects.ranges()[object];
        const auto along = [](const float(&row)[4], oibvh::Point at) {
            return row[0] * at.x + row[1] * at.y + row[2] * at.z + row[3];
        };
        for (std::size_t k = 0; k < parts[object].points.size(); ++k) {
            const oibvh::Point at = parts[object].points[k];
            objects.mesh.points[3 * range.first + k] = {along(pose.x, at), along(pose.y, at),
                                                        along(pose.z, at)};
        }
    }

    static constexpr oibvh::Pose turned = {
        {0.6f, -0.8f, 0, 0.3f}, {0.8f, 0.6f, 0, -0.1f}, {0, 0, 1, 0.125f}};
    ThreeObjects objects;
    std::vector<LibraryMesh> parts = objects.parts;
    oibvh::Scene scene{device};
};

TEST_F(LibraryScene, FollowsPosesAndPoints)
{
    scene.place(2, turned);  // before there is a tree
    place_by_hand(2, turned);
    expect_right();
    scene.place(1, turned);
    place_by_hand(1, turned);
    scene.place(2, {});
    place_by_hand(2, {});
    expect_right();
    for (oibvh::Point& point : parts[1].points)
        point.y *= 1.5f;
    scene.move(1, parts[1].points);
    place_by_hand(1, turned);
    expect_right();
    expect_right();  // nothing has moved
    scene.move(1, parts[1].points);
    scene.place(1, {});
    place_by_hand(1, {});
    expect_right();
    EXPECT_EQ(scene.add(parts[0].on_host()), 3u);
    for (const oibvh::Point point : parts[0].points)
        objects.mesh.points.push_back(point);
    const auto all = static_cast<std::uint32_t>(objects.mesh.points.size());
    objects.mesh.faces.push_back({all - 3, all - 2, all - 1});
    EXPECT_EQ(found_pairs(scene.tree(), caller), swept_pairs(objects.mesh));
    EXPECT_GT(scene.memory(), scene.tree().memory());
}

/// A call orders what it copies and launches behind the caller's commands and those of earlier calls, also where the queue does not.
TEST_F(LibraryScene, IsRightOnAQueueOutOfOrder)
{
    const Caller other(CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE | CL_QUEUE_PROFILING_ENABLE);
    oibvh::Device device(other.queue);
    oibvh::Scene unordered(device);
    for (const LibraryMesh& part : parts)
        unordered.add(part.on_host());
    unordered.tree();
    for (int k = 0; k < 20; ++k) {
        unordered.move(1, parts[1].points);
        unordered.place(1, k % 2 == 0 ? turned : oibvh::Pose{});
        unordered.place(2, turned);
    }
    EXPECT_LE(device.times().size(), 1u) << "of the last call alone";
    place_by_hand(2, turned);
    EXPECT_EQ(found_pairs(unordered.tree(), other), swept_pairs(objects.mesh));
}

TEST_F(LibraryScene, TellsTheObjectOfATriangle)
{
    for (const auto& [triangle, object, own] : {std::tuple(0u, 0u, 0u),
                                                {1u, 1u, 0u},
                                                {300u, 1u, 299u},
                                                {301u, 2u, 0u},
                                                {377u, 2u, 76u}}) {
        EXPECT_EQ(scene.origin(triangle).object, object);
        EXPECT_EQ(scene.origin(triangle).triangle, own);
    }
}

TEST_F(LibraryScene, RefusesWhatItCannotDoAndStaysAsItWas)
{
    using oibvh::BadInput;
    const std::vector<oibvh::Point> few(2), bad(3 * 300, {0, NAN, 0});
    LibraryMesh wrong = parts[0];
    wrong.faces[0].b = 3;
    expect_right();
    EXPECT_EQ(refusal_of<BadInput>([&] { oibvh::Scene(device).tree(); }),
              "there are no triangles, and a tree has a leaf at least");
    EXPECT_EQ(refusal_of<BadInput>([&] { scene.add(wrong.on_host()); }),
              "triangle 0 names point 3, and there are 3");
    EXPECT_EQ(refusal_of<BadInput>([&] { scene.add({}); }),
              "there are no triangles, and a tree has a leaf at least");
    EXPECT_EQ(refusal_of<BadInput>([&] { scene.move(1, few); }),
              "object 1 has 900 points, and 2 are given");
    EXPECT_EQ(refusal_of<BadInput>([&] { scene.move(1, bad); }),
              "point 0 is not finite: (0.000000, nan, 0.000000)");
    EXPECT_EQ(refusal_of<BadInput>([&] { scene.place(3, {}); }),
              "there is no object 3, and there are 3");
    for (const float value : {NAN, INFINITY, 3e38f})
        EXPECT_EQ(refusal_of<BadInput>([&] {
                      scene.place(1, {.y = {0, value, 0, value}});
                  }),
                  "a pose puts points where floats are not finite");
    EXPECT_EQ(refusal_of<BadInput>([&] { scene.origin(378); }),
              "there is no triangle 378, and there are 378");
    expect_right();
}

TEST_F(LibraryScene, HasTheContactsOfEveryColliderWithAndWithoutNeighbours)
{
    LibraryMesh repeated = soup_mesh(300);
    repeated.faces[7] = repeated.faces[3];  // meets itself in more than what it shares
    for (const char* collider : {"leaf", "group", "block", "bvtt"})
        for (const bool adjacent : {false, true}) {
            oibvh::Tree tree(device, {.collider = collider, .adjacent_pairs = adjacent});
            for (const LibraryMesh& mesh :
                 {soup_mesh(1), repeated, scene_mesh("torus:300"), soup_mesh(300, 2)}) {
                tree.build(mesh.on_device(caller));
                EXPECT_EQ(listed(tree, caller, tree.find_contacts()), contacts_of(mesh, adjacent))
                    << collider << adjacent;
            }
        }
    oibvh::Tree tree(device);
    tree.build(oibvh::HostBoxes{objects.mesh.boxes()});
    EXPECT_EQ(refusal_of<oibvh::BadInput>([&] { tree.find_contacts(); }),
              "boxes have overlaps but no contacts: those are of triangles");
}

}  // namespace
}  // namespace bvhbench
