// SPDX-License-Identifier: MIT
//
// The colliders for many small worlds, all-pairs and sort-sweep, over one object and many. collider_test has the hard meshes.
#include <tuple>

#include "collide/worlds/tile.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

using Case = std::tuple<ColliderEntry, KernelForm>;

class WithinObjects : public testing::TestWithParam<Case> {
protected:
    std::unique_ptr<Collider> made(ColliderOptions options = {}) const
    {
        options.form = std::get<1>(GetParam());
        return bvhbench::made(std::get<0>(GetParam()).name, options);
    }
    bool is_all_pairs() const { return std::get<0>(GetParam()).name == "all-pairs"; }
};

/// Objects of these sizes in one place.
ManyObjects objects_of(std::initializer_list<uint> sizes)
{
    ManyObjects many({});
    for (const uint size : sizes)
        many.add(mesh_of_many_sizes(size));
    return many;
}

TEST_P(WithinObjects, TellsObjectsApart)
{
    const ManyObjects many = objects_of({1, 70, 3, 1, 200, 8, 128, 5, 129});
    expect_pairs_of_objects(many, [&](const ColliderOptions& options) { return made(options); });
}

TEST_P(WithinObjects, TakesScenes)
{
    for (const char* name :
         {"worlds:70:60", "worlds:5:300", "worlds:9:2", "worlds:1:1", "cloth-ball:1000:1"}) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(name, {});
        std::vector<FaceRange> ranges;
        for (const SceneObject& object : scene.objects)
            ranges.push_back({object.first_face, object.face_count});
        const Standing standing({scene.frames[0], scene.faces}, nullptr, {}, ranges);
        for (const bool keeps : {true, false})
            expect_oracles_pairs(*made({.among = Among::within_objects, .keep_adjacent = keeps}),
                                 standing, keeps, Among::within_objects);
    }
}

TEST_P(WithinObjects, KeepsUpWithPointsThatMove)
{
    const ManyObjects many = objects_of({300, 2, 41, 41});
    Standing standing(many.mesh, nullptr, {}, many.objects);
    const auto collider = made({.among = Among::within_objects});
    collider->reserve(nullptr, standing.input);
    std::vector<Point> points = standing.mesh.points;
    for (const float factor : {1.0f, 30.0f, 0.0f, -1e30f}) {
        for (std::size_t k = 0; k < points.size(); k += 3)
            points[k].y *= factor;  // another axis becomes the longest
        standing.place(points);
        expect_pairs(
            *collider, standing,
            touching_pairs(points, standing.mesh.faces, true, many.objects, Among::within_objects));
    }
}

// The object's number and a box's place in it need more than 32 bits.
TEST_P(WithinObjects, TakesManyObjectsAndALargeOne)
{
    if (is_all_pairs())
        return;
    ManyObjects many({});
    many.add(scene_mesh("grid:66000"));
    for (uint k = 0; k < 70000; ++k) {
        many.objects.push_back({66000 + k, 1});
        many.mesh.faces.push_back(many.mesh.faces[k % 66000]);
    }
    expect_oracles_pairs(*made({.among = Among::within_objects}),
                         Standing(many.mesh, nullptr, {}, many.objects), true,
                         Among::within_objects);
}

TEST_P(WithinObjects, TestsEachPairOfAnObjectOnceAtMost)
{
    const ManyObjects many = objects_of({1, 2, 7, 8, 9, 64, 65, 127, 128, 129, 1000});
    const auto collider = made({.among = Among::within_objects});
    const Standing standing(many.mesh, nullptr, {}, many.objects);
    expect_oracles_pairs(*collider, standing, true, Among::within_objects);
    std::uint64_t most = 0;
    for (const FaceRange& object : many.objects)
        most += std::uint64_t{object.count} * (object.count - 1) / 2;
    const std::uint64_t tests = *collider->counts(session().queue()).box_tests;
    if (is_all_pairs())
        EXPECT_EQ(tests, most);
    else
        EXPECT_LT(tests, most / 2);
}

INSTANTIATE_TEST_SUITE_P(Catalog, WithinObjects,
                         testing::Combine(testing::Values(find_collider("all-pairs"),
                                                          find_collider("sort-sweep")),
                                          both_forms),
                         CaseName());

TEST(Tiles, MeetEachOtherOnceInARing)
{
    for (uint count = 1; count < 40; ++count) {
        std::set<std::pair<uint, uint>> met;
        for (uint k = 0; k < count; ++k) {
            EXPECT_LE(met_behind(count, k), count / 2);
            for (uint step = 1; step <= met_behind(count, k); ++step) {
                const uint other = (k + step) % count;
                EXPECT_TRUE(met.insert({std::min(k, other), std::max(k, other)}).second);
            }
        }
        EXPECT_EQ(met.size(), count * (count - 1) / 2);
    }
}

}  // namespace
}  // namespace bvhbench
