// SPDX-License-Identifier: MIT
//
// The library's pairs within a distance are those of the host's exact test, each triangle with each other, which
// tests/collide/within_distance_test.cpp compares with CGAL.
#include "collide/within/within.h"

#include "tests/library/testing.h"

namespace bvhbench {
namespace {

PairList each_within(const LibraryMesh& mesh, double distance, bool adjacent = true)
{
    const Mesh own = mesh.mesh();
    std::vector<Pair> pairs;
    for (uint b = 0; b < own.faces.size(); ++b)
        for (uint a = 0; a < b; ++a)
            if (are_within(own.points, own.faces, {a, b},
                           {.distance = distance, .keep_adjacent = adjacent}))
                pairs.push_back({a, b});
    return PairList(std::move(pairs));
}

class LibraryWithin : public OfACaller {
protected:
    PairList found(oibvh::Tree& tree, double distance, oibvh::Among among = oibvh::Among::all,
                   const oibvh::Filter& filter = {}) const
    {
        return listed(tree, caller, tree.find_within(distance, among, filter));
    }
};

TEST_F(LibraryWithin, ADistanceAreThoseOfEachWithEach)
{
    for (const char* collider : {"leaf", "group", "block", "bvtt"})
        for (const bool adjacent : {false, true}) {
            oibvh::Tree tree(
                device,
                {.sorted_leaves = adjacent, .collider = collider, .adjacent_pairs = adjacent});
            for (const LibraryMesh& mesh : {soup_mesh(1), soup_mesh(2), soup_mesh(300),
                                            scene_mesh("torus:300"), soup_mesh(300, 2)}) {
                tree.build(mesh.on_device(caller));
                const PairList touching = found_pairs(tree, caller);
                for (const double distance : {0.0, 0.02, 1e-30, 0.1}) {
                    EXPECT_EQ(found(tree, distance), each_within(mesh, distance, adjacent))
                        << collider << distance;
                    tree.first_contact();
                    EXPECT_EQ(tree.read_pairs().size(),
                              each_within(mesh, distance, adjacent).size());
                }
                EXPECT_EQ(found_pairs(tree, caller), touching) << "of the tree that stands";
            }
        }
}

/// All 499,500 pairs are within the distance, while lists hold 8,000 at first.
TEST_F(LibraryWithin, GetRoomAndKeepIt)
{
    const LibraryMesh mesh = soup_mesh(1000);
    oibvh::Tree tree(device);
    tree.build(mesh.on_host());
    const std::size_t before = tree.memory();
    EXPECT_EQ(found(tree, 10).size(), 499500u);
    const std::size_t taken = tree.memory();
    EXPECT_GT(taken, before + 2 * 499500 * sizeof(Pair)) << "candidates, and those within";
    EXPECT_EQ(found(tree, 10).size(), 499500u);
    EXPECT_EQ(found(tree, 0.01), each_within(mesh, 0.01));
    EXPECT_EQ(tree.memory(), taken);
    tree.build(soup_mesh(999).on_host());
    EXPECT_LT(tree.memory(), taken) << "of other sizes: nothing is kept";
}

TEST_F(LibraryWithin, ObjectsAreToldApartAndFiltered)
{
    const ThreeObjects objects;
    const std::vector<oibvh::Excluded> excluded = {{2, 1}, {0, 0}};
    oibvh::Tree tree(device);
    tree.build(objects.mesh.on_host(), objects.sizes);
    const PairList all = each_within(objects.mesh, 0.1);
    for (const auto& [asked, among] : amongs) {
        const PairList wanted = among_objects(all, objects.ranges(), among);
        EXPECT_EQ(found(tree, 0.1, asked), wanted);
        const PairList less =
            chosen(wanted, [](Pair pair) { return pair.a < 1 || pair.a >= 301 || pair.b < 301; });
        EXPECT_EQ(less.size() < wanted.size(), among != Among::within_objects);
        EXPECT_EQ(found(tree, 0.1, asked, {.excluded = excluded}), less);
    }
}

TEST_F(LibraryWithin, FollowTrianglesThatMove)
{
    ThreeObjects objects;
    oibvh::Tree tree(device);
    tree.build(objects.mesh.on_host(), objects.sizes);
    EXPECT_EQ(found(tree, 0.05), each_within(objects.mesh, 0.05));
    objects.move(1, 0.02f);
    tree.refit(objects.mesh.on_device(caller));
    EXPECT_EQ(found(tree, 0.05), each_within(objects.mesh, 0.05));
    objects.move(2, 0.03f);
    const oibvh::Update updates[] = {oibvh::Update::keep, oibvh::Update::keep,
                                     oibvh::Update::refit};
    tree.update(objects.mesh.on_host(), updates);
    EXPECT_EQ(found(tree, 0.05), each_within(objects.mesh, 0.05));
    objects.mesh.points.insert(objects.mesh.points.begin(), 1000, {0, 0, 0});  // named by none
    for (oibvh::Face& face : objects.mesh.faces)
        face = {face.a + 1000, face.b + 1000, face.c + 1000};
    tree.build(objects.mesh.on_host(), objects.sizes);
    EXPECT_EQ(found(tree, 0.05), each_within(objects.mesh, 0.05));
}

TEST_F(LibraryWithin, KeepNoBufferOfAnEarlierInput)
{
    const LibraryMesh mesh = soup_mesh(90);
    const oibvh::DeviceTriangles triangles = mesh.on_device(caller);
    const auto references = [&] {
        cl_uint count = 0;
        clGetMemObjectInfo(triangles.faces, CL_MEM_REFERENCE_COUNT, sizeof count, &count, nullptr);
        return count;
    };
    oibvh::Tree tree(device);
    tree.build(triangles);
    EXPECT_EQ(found(tree, 0.1), each_within(mesh, 0.1));
    EXPECT_GT(references(), 1u);
    tree.build(mesh.on_host());
    EXPECT_EQ(found(tree, 0.1), each_within(mesh, 0.1));
    clFinish(caller.queue);
    for (int look = 0; look < 200 && references() > 1; ++look)  // PoCL releases a little later
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(references(), 1u);
}

/// Distances that are in doubt in doubles, so that the host decides; it has only the device's points.
TEST_F(LibraryWithin, AreDecidedByTheHostWhereDoublesAreInDoubt)
{
    LibraryMesh points;
    for (std::uint32_t k = 0; k < 40; ++k) {
        const float x = 100 * static_cast<float>(k);
        points.points.insert(points.points.end(), {{x, 0, 0}, {x + 3, 4, k == 7 ? 0 : 0x1p-30f}});
        points.faces.insert(points.faces.end(),
                            {{2 * k, 2 * k, 2 * k}, {2 * k + 1, 2 * k + 1, 2 * k + 1}});
    }
    oibvh::Tree tree(device);
    tree.build(points.on_device(caller));
    EXPECT_EQ(found(tree, 5), PairList({{14, 15}}));
}

TEST_F(LibraryWithin, AreRefusedInOneSentence)
{
    oibvh::Tree tree(device);
    EXPECT_EQ(refusal_of<oibvh::BadInput>([&] { tree.find_within(1); }),
              "a query needs a tree, and none was built, or its build failed");
    const LibraryMesh mesh = soup_mesh(90);
    tree.build(mesh.on_host());
    const PairList before = found_pairs(tree, caller);
    for (const double wrong : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_EQ(refusal_of<oibvh::BadInput>([&] { tree.find_within(wrong); }),
                  "a distance is a finite number that is not negative");
    EXPECT_THROW(tree.find_within(1, static_cast<oibvh::Among>(7)), oibvh::BadInput);
    EXPECT_EQ(pair_list(tree.read_pairs()), before) << "as they were";
    EXPECT_EQ(found(tree, 0.1), each_within(mesh, 0.1));
    const std::vector<oibvh::Box> boxes = mesh.boxes();
    tree.build(oibvh::HostBoxes{boxes});
    EXPECT_EQ(refusal_of<oibvh::BadInput>([&] { tree.find_within(1); }),
              "boxes have overlaps but no distances: those are of triangles");
}

}  // namespace
}  // namespace bvhbench
